//! The limit that shells approach: fur ray-cast in double precision on the CPU, from the formulas, sharing no code with
//! the shaders.
//!
//! A shell of fur at height k in [0, 1] is, for every triangle of its skin, the flat triangle of the vertices' displaced
//! places. What infinitely many shells show along a ray is the first place, over all triangles and all k, that lies
//! inside a strand ([`FurGeometry`]). It is shaded as the shaders shade, with the twins of [`crate::measure::twin`].

mod bvh;
mod error;
mod fur;
mod picture;
mod ray;
mod shade;
mod stage;
mod texture;
mod walk;

pub use error::OracleError;
pub use fur::{Corner, FurGeometry, Triangle};
pub use picture::{OracleOptions, OraclePicture, render};
pub use ray::Ray;
pub use walk::Hit;
