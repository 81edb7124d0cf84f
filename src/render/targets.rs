//! The images that a frame draws into.

use super::options::FrameOptions;
use super::pipeline::DEPTH_FORMAT;
use crate::gpu::{Gpu, GpuError, Image, ImageDesc, format_bytes};
use ash::vk;

/// An image that a frame draws into, as the plan lists it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Attachment {
    /// Name on the device and in reports.
    pub name: &'static str,
    /// Format.
    pub format: vk::Format,
    /// Samples a pixel.
    pub samples: u32,
    usage: vk::ImageUsageFlags,
}

impl Attachment {
    /// Linear HDR colour at the samples asked for.
    fn color(options: &FrameOptions, lists: bool) -> Self {
        let drawn = vk::ImageUsageFlags::COLOR_ATTACHMENT;
        let usage = if options.msaa > 1 && !lists { drawn } else { drawn | vk::ImageUsageFlags::SAMPLED };
        Self { name: "hdr color", format: options.hdr_format.vulkan(), samples: options.msaa, usage }
    }

    /// Linear HDR colour at one sample, and with all that blends; `None` where the colour is that already.
    fn resolved(options: &FrameOptions, lists: bool) -> Option<Self> {
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
        let resolved = Self { name: "hdr color resolved", samples: 1, usage, ..Self::color(options, lists) };
        (options.msaa > 1 || lists).then_some(resolved)
    }

    /// Reversed depth.
    fn depth(options: &FrameOptions, lists: bool) -> Self {
        let drawn = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT;
        // Lists ask it, sample by sample, what is hidden.
        let usage = if options.msaa > 1 && lists { drawn | vk::ImageUsageFlags::SAMPLED } else { drawn };
        Self { name: "depth", format: DEPTH_FORMAT, samples: options.msaa, usage }
    }

    /// All that a frame with these options draws into, but for the picture, which may be the host's; `lists` where what
    /// blends is listed.
    pub fn all(options: &FrameOptions, lists: bool) -> Vec<Self> {
        [Some(Self::color(options, lists)), Self::resolved(options, lists), Some(Self::depth(options, lists))]
            .into_iter()
            .flatten()
            .collect()
    }

    /// Bytes of all samples at a picture of `size` pixels, without what the device adds.
    pub fn bytes(&self, size: [u32; 2]) -> u64 {
        format_bytes(self.format, size).unwrap_or(0) * u64::from(self.samples)
    }

    fn create(self, gpu: &Gpu, size: [u32; 2]) -> Result<Image, GpuError> {
        let Self { name, format, samples, usage } = self;
        gpu.image(&ImageDesc { name, size, format, mip_levels: 1, samples, usage, is_cube: false })
    }
}

/// The images that a frame draws into; kept while size, samples and format stay.
pub struct Targets {
    key: ([u32; 2], Vec<Attachment>),
    /// Linear HDR colour at the samples asked for.
    pub color: Image,
    /// Linear HDR colour at one sample, and with all that blends; `None` where `color` is that already.
    pub resolved: Option<Image>,
    /// Reversed depth.
    pub depth: Image,
}

impl Targets {
    /// Makes them.
    ///
    /// # Errors
    /// When the device is out of memory or the size is beyond its limits.
    pub fn new(gpu: &Gpu, options: &FrameOptions, lists: bool) -> Result<Self, GpuError> {
        let size = options.size;
        let resolved = Attachment::resolved(options, lists);
        Ok(Self {
            key: (size, Attachment::all(options, lists)),
            color: Attachment::color(options, lists).create(gpu, size)?,
            resolved: resolved.map(|resolved| resolved.create(gpu, size)).transpose()?,
            depth: Attachment::depth(options, lists).create(gpu, size)?,
        })
    }

    /// Whether they serve these options, too.
    pub fn fit(&self, options: &FrameOptions, lists: bool) -> bool {
        self.key == (options.size, Attachment::all(options, lists))
    }

    /// The one-sample HDR image that later passes read.
    pub fn hdr(&self) -> &Image {
        self.resolved.as_ref().unwrap_or(&self.color)
    }
}
