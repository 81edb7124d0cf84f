//! The images that a frame draws into.

use super::options::FrameOptions;
use super::pipeline::DEPTH_FORMAT;
use crate::gpu::{Gpu, GpuError, Image, ImageDesc};
use ash::vk;

/// The images that a frame draws into; kept while size, samples and format stay.
pub struct Targets {
    key: ([u32; 2], u32, vk::Format),
    /// Linear HDR colour at the samples asked for.
    pub color: Image,
    /// Linear HDR colour at one sample; `None` where `color` is that already.
    pub resolved: Option<Image>,
    /// Reversed depth.
    pub depth: Image,
}

impl Targets {
    /// Makes them.
    ///
    /// # Errors
    /// When the device is out of memory or the size is beyond its limits.
    pub fn new(gpu: &Gpu, options: &FrameOptions) -> Result<Self, GpuError> {
        let format = options.hdr_format.vulkan();
        let image = |name, format, samples, usage| {
            gpu.image(&ImageDesc { name, size: options.size, format, mip_levels: 1, samples, usage })
        };
        let drawn = vk::ImageUsageFlags::COLOR_ATTACHMENT;
        let read = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_SRC;
        let multisampled = options.msaa > 1;
        Ok(Self {
            key: (options.size, options.msaa, format),
            color: image("hdr color", format, options.msaa, if multisampled { drawn } else { drawn | read })?,
            resolved: if multisampled { Some(image("hdr color resolved", format, 1, drawn | read)?) } else { None },
            depth: image("depth", DEPTH_FORMAT, options.msaa, vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT)?,
        })
    }

    /// Whether they serve these options, too.
    pub fn fit(&self, options: &FrameOptions) -> bool {
        self.key == (options.size, options.msaa, options.hdr_format.vulkan())
    }

    /// The one-sample HDR image that later passes read.
    pub fn hdr(&self) -> &Image {
        self.resolved.as_ref().unwrap_or(&self.color)
    }
}
