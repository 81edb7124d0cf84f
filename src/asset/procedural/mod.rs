//! Meshes, images and whole scenes by formula: nothing is read, nothing is random, every run gives the same bytes.

mod drape;
mod gallery;
mod image;
mod mesh;
mod set;
mod swatch;

pub use drape::drape;
pub use gallery::{GALLERY_CAMERA, gallery, lit_quad};
pub use image::{checker, strand_image};
pub use mesh::{backdrop, capsule, cube, plane, rounded_cube, sphere, torus, torus_knot, uv_sphere};
pub use swatch::{SWATCH_CAMERA, SWATCH_MATERIAL, swatch};

use set::Set;
