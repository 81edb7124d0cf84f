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
    fn color(options: &FrameOptions) -> Self {
        let drawn = vk::ImageUsageFlags::COLOR_ATTACHMENT;
        let usage = if options.msaa > 1 { drawn } else { drawn | vk::ImageUsageFlags::SAMPLED };
        Self { name: "hdr color", format: options.hdr_format.vulkan(), samples: options.msaa, usage }
    }

    /// Linear HDR colour at one sample; `None` where the colour is that already.
    fn resolved(options: &FrameOptions) -> Option<Self> {
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
        (options.msaa > 1).then_some(Self { name: "hdr color resolved", samples: 1, usage, ..Self::color(options) })
    }

    /// Reversed depth.
    fn depth(options: &FrameOptions) -> Self {
        let usage = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT;
        Self { name: "depth", format: DEPTH_FORMAT, samples: options.msaa, usage }
    }

    /// All that a frame with these options draws into, but for the picture, which may be the host's.
    pub fn all(options: &FrameOptions) -> Vec<Self> {
        [Some(Self::color(options)), Self::resolved(options), Some(Self::depth(options))]
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
        let size = options.size;
        Ok(Self {
            key: (size, Attachment::all(options)),
            color: Attachment::color(options).create(gpu, size)?,
            resolved: Attachment::resolved(options).map(|resolved| resolved.create(gpu, size)).transpose()?,
            depth: Attachment::depth(options).create(gpu, size)?,
        })
    }

    /// Whether they serve these options, too.
    pub fn fit(&self, options: &FrameOptions) -> bool {
        self.key == (options.size, Attachment::all(options))
    }

    /// The one-sample HDR image that later passes read.
    pub fn hdr(&self) -> &Image {
        self.resolved.as_ref().unwrap_or(&self.color)
    }
}
