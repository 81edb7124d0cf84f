//! Pure mathematics of space: frames, projections, bounds. Knows nothing of files or devices.

mod bounds;
mod hull;
mod space;

pub use bounds::{Aabb, Sphere};
pub use hull::Hull;
pub use space::{normal_matrix, orthographic, orthonormal_frame, perspective, perspective_infinite};
