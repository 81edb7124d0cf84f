//! Images of the host's.

use crate::pointer::{exclusive, free, handle, optional_text, shared};
use crate::renderer::VairRenderer;
use crate::result::{Failure, VairResult, border, border_of_free};
use std::ffi::c_char;
use vair::Gpu;
use vair::gpu::{HostImage, Image, vk};

/// An image of the host's; vair does not destroy it.
#[repr(C)]
pub struct VairHostImage {
    /// Name in messages; NULL is none.
    pub name: *const c_char,
    /// The image.
    pub image: vk::Image,
    /// View of all its levels (and faces), which is what shaders read.
    pub view: vk::ImageView,
    /// Format; an sRGB one where it holds colours.
    pub format: vk::Format,
    /// Texels.
    pub width: u32,
    /// Texels.
    pub height: u32,
    /// Mip levels of the view.
    pub mip_levels: u32,
    /// It is a cube of six faces.
    pub is_cube: vk::Bool32,
}

/// An image of the host's that vair reads: in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL whenever it does.
pub struct VairImage(pub(crate) Image);

/// Lets vair read an image of the host's, which stays the host's.
///
/// # Safety
/// Image and view belong to the renderer's device, are as described, were made for sampling, and live until the last frame
/// that reads them has passed. They are in shader-read layout in every such frame.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_image_new_on_host(
    renderer: *mut VairRenderer,
    host: *const VairHostImage,
    image: *mut *mut VairImage,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's memory or NULL.
        let image = unsafe { handle(image, "image") }?;
        // SAFETY: the caller's handle or NULL.
        let gpu = &unsafe { exclusive(renderer, "renderer") }?.0.gpu;
        // SAFETY: this function's contract is that one's.
        let lent = unsafe { borrow(gpu, host, "host") }?;
        *image = Box::into_raw(Box::new(VairImage(lent)));
        Ok(())
    })
}

/// Frees what vair knows of an image; the host's image stays. NULL is nothing.
///
/// # Safety
/// It is not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_image_free(image: *mut VairImage) {
    // SAFETY: by this function's contract.
    border_of_free(|| unsafe { free(image) });
}

/// # Safety
/// That of [`vair_image_new_on_host`].
pub(crate) unsafe fn borrow(gpu: &Gpu, host: *const VairHostImage, name: &str) -> Result<Image, Failure> {
    // SAFETY: the caller's structure or NULL.
    let host = unsafe { shared(host, name) }?;
    if host.image == vk::Image::null() || host.view == vk::ImageView::null() {
        return Err(Failure::argument(format!("{name}: image or view is NULL")));
    }
    if host.width == 0 || host.height == 0 || host.mip_levels == 0 {
        return Err(Failure::argument(format!("{name}: an image has at least one texel and one level")));
    }
    // SAFETY: text of the caller's or NULL.
    let label = unsafe { optional_text(host.name, "name of the image") }?;
    let desc = HostImage {
        name: label.unwrap_or("host's image"),
        image: host.image,
        view: host.view,
        format: host.format,
        size: [host.width, host.height],
        mip_levels: host.mip_levels,
        samples: 1,
        is_cube: host.is_cube != vk::FALSE,
        layout: vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL,
    };
    // SAFETY: by this function's contract.
    Ok(unsafe { Image::from_host(gpu, &desc) })
}
