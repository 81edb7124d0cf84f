//! vair renders what people wear: fur and cloth, on Vulkan.
//!
//! Rooms, each seeing only those before it:
//! [`math`] <- [`gpu`], [`asset`], [`shader`] <- [`material`] <- [`scene`] <- [`render`].

#[allow(unsafe_code)]
pub mod gpu;

pub mod asset;
pub mod material;
pub mod math;
pub mod render;
pub mod scene;
pub mod shader;
