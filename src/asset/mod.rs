//! Files to plain data: glTF 2.0 (.gltf and .glb) and the pictures they use; environments (.hdr and .exr).
//!
//! [`load`] trusts nothing in a file. It works in this order, and each step sees only what the one
//! before it has checked:
//!
//! 1. `container` splits GLB from JSON; `mend` takes from it what vair reads; `document` gives that the shape of the
//!    `gltf` crate's types; `extension` refuses required extensions that would change what the file means.
//! 2. `accessor` turns buffers into numbers: every range checked, every number finite, every byte
//!    counted against [`LoadOptions::memory_limit_bytes`] before it is allocated.
//! 3. `node`, `mesh`, `skin`, `material`, `animation` and the rest fill an [`Asset`], whose doc
//!    comments are the promises that later rooms rely on.
//!
//! [`check`] asks the same of an [`Asset`] that was made in memory.
//!
//! What is wrong but has one plain reading becomes a line of [`Asset::warnings`]; what is not
//! becomes an [`AssetError`] that names file, field and remedy. No input panics.
//!
//! Source: Khronos, "glTF 2.0 Specification" (2021) and the KHR extensions named in `extension`.

mod accessor;
mod animation;
mod camera;
mod check;
mod container;
mod context;
mod document;
mod environment;
mod error;
mod extension;
mod gltf;
mod image;
mod influence;
mod light;
mod material;
mod material_extension;
mod mend;
mod mesh;
mod model;
mod morph;
mod node;
mod normal;
pub mod procedural;
mod skin;
mod tangent;
mod texture;
mod topology;
mod uri;

pub use self::gltf::{DEFAULT_MEMORY_LIMIT_BYTES, LoadOptions, load};
pub use check::check;
pub use environment::{Environment, MAX_ENVIRONMENT_SIZE, MAX_RADIANCE};
pub use error::AssetError;
pub use image::{MAX_IMAGE_SIDE_PX, decode_image};
pub use material_extension::{
    Anisotropy, Clearcoat, DiffuseTransmission, Iridescence, MaterialExtensions, Sheen, Specular, Transmission, Volume,
};
pub use model::*;
pub use tangent::{
    MAX_TRIANGLES_AROUND_CORNER, NoTangents, generate_tangents, generate_tangents_around_vertical, tangent_bytes,
};
pub use uri::{read_file, read_inside};
