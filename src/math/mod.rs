//! Pure mathematics of space: frames, projections, bounds; of coding colours and directions; quadrature and hashes. Knows
//! nothing of files or devices.

mod bounds;
mod color;
mod hash;
mod hull;
mod octahedral;
mod quadrature;
mod space;

pub use bounds::{Aabb, Sphere};
pub use color::{linear_from_srgb, linear_from_srgb_byte, srgb_from_linear};
pub use hash::{fnv1a, pcg3d};
pub use hull::Hull;
pub use octahedral::direction_from_octahedral;
pub use quadrature::gauss_legendre;
pub use space::{normal_matrix, orthographic, orthonormal_frame, perspective, perspective_infinite};
