//! Pure mathematics of space: frames, projections, bounds; and of colour coding. Knows nothing of files or devices.

mod bounds;
mod color;
mod hash;
mod hull;
mod space;

pub use bounds::{Aabb, Sphere};
pub use color::{linear_from_srgb, srgb_from_linear};
pub use hash::fnv1a;
pub use hull::Hull;
pub use space::{normal_matrix, orthographic, orthonormal_frame, perspective, perspective_infinite};
