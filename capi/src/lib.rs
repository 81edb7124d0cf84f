//! C API of vair, which draws fur and cloth into a host program's own Vulkan frame. The header, `include/vair.h`, is made
//! from this crate by cbindgen, and a test keeps it so; it is where a C programmer reads. What the calls mean is said in full
//! by the library (`vair::render::frame`).
//!
//! | file | is |
//! |---|---|
//! | `result` | codes, messages, and the border that no panic crosses |
//! | `pointer` | what a host's pointers become, checked |
//! | `features` | the features that a host's device has enabled |
//! | `renderer` | renderers, their devices, and tokens of frames |
//! | `mesh` | scenes made from memory |
//! | `scene` | scenes and their edits |
//! | `image` | images of the host's |
//! | `environment` | light from all around |
//! | `light`, `view` | lights; cameras and targets |
//! | `frame` | a frame being recorded |

mod environment;
mod features;
mod frame;
mod image;
mod light;
mod mesh;
mod pointer;
mod renderer;
mod result;
mod scene;
mod view;

pub use environment::*;
pub use features::*;
pub use frame::*;
pub use image::*;
pub use light::*;
pub use mesh::*;
pub use renderer::*;
pub use result::*;
pub use scene::*;
pub use view::*;

use std::ffi::c_char;

/// Version of the interface that this header describes. A program and a library fit where theirs are equal.
pub const VAIR_INTERFACE_VERSION: u32 = 1;

/// No index: an option that is left out.
pub const VAIR_NONE: u32 = u32::MAX;

/// VAIR_INTERFACE_VERSION of the library that is linked.
#[unsafe(no_mangle)]
pub extern "C" fn vair_interface_version() -> u32 {
    VAIR_INTERFACE_VERSION
}

/// Version of the library, for example "0.1.0".
#[unsafe(no_mangle)]
pub extern "C" fn vair_version() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}

/// An index, or none.
fn index_or_none(index: u32) -> Option<usize> {
    (index != VAIR_NONE).then_some(index as usize)
}
