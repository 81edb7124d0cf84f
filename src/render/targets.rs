//! The images that a frame draws into.

use super::options::FrameOptions;
use super::pipeline::{DEPTH_FORMAT, OCCLUSION_FORMAT, guide_format};
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
            .chain([Self::guide(options), Self::occlusion(options)].into_iter().flatten().flatten())
            .collect()
    }

    /// Normal, motion and depth of what is nearest.
    fn guide(options: &FrameOptions) -> Option<[Self; 2]> {
        let sampled = vk::ImageUsageFlags::SAMPLED;
        let [color, depth] = [vk::ImageUsageFlags::COLOR_ATTACHMENT, vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT];
        let format = guide_format(options.aovs.motion);
        options.has_guide().then_some([
            Self { name: "guide", format, samples: 1, usage: color | sampled },
            Self { name: "guide depth", format: DEPTH_FORMAT, samples: 1, usage: depth | sampled },
        ])
    }

    /// Screen-space occlusion before and after its blur.
    fn occlusion(options: &FrameOptions) -> Option<[Self; 2]> {
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
        let named = |name| Self { name, format: OCCLUSION_FORMAT, samples: 1, usage };
        let wanted = options.screen_occlusion.is_some() || options.everything;
        wanted.then_some(["screen occlusion slices", "screen occlusion"].map(named))
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
    /// Where layers or screen-space occlusion ask for them.
    pub guide: Option<GuideTargets>,
    /// Where there is screen-space occlusion.
    pub occlusion: Option<OcclusionTargets>,
}

/// What is nearest, one sample a pixel.
pub struct GuideTargets {
    /// xy: unit normal in world space, octahedral; zw: motion, pixels, where it is asked for.
    pub texels: Image,
    /// Reversed depth, 0 where nothing is.
    pub depth: Image,
}

/// Share of the ambient light, one sample a pixel.
pub struct OcclusionTargets {
    /// Of a pixel's own slices.
    pub slices: Image,
    /// Of those of its surroundings.
    pub visibility: Image,
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
            guide: match Attachment::guide(options) {
                Some([texels, depth]) => {
                    Some(GuideTargets { texels: texels.create(gpu, size)?, depth: depth.create(gpu, size)? })
                }
                None => None,
            },
            occlusion: match Attachment::occlusion(options) {
                Some([slices, visibility]) => Some(OcclusionTargets {
                    slices: slices.create(gpu, size)?,
                    visibility: visibility.create(gpu, size)?,
                }),
                None => None,
            },
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
