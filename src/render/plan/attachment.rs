//! An image that a frame draws into, as a plan lists it.

use crate::gpu::{Gpu, GpuError, Image, ImageDesc, format_bytes};
use ash::vk;

/// An image that a frame draws into.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Attachment {
    /// Name on the device and in reports.
    pub name: &'static str,
    /// Format.
    pub format: vk::Format,
    /// Samples a pixel.
    pub samples: u32,
    /// What it is used as.
    pub usage: vk::ImageUsageFlags,
}

impl Attachment {
    /// A colour target of one sample that later passes read.
    pub fn sampled(name: &'static str, format: vk::Format) -> Self {
        Self { name, format, samples: 1, usage: vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::SAMPLED }
    }

    /// Bytes of all samples at a picture of `size` pixels, without what the device adds.
    pub fn bytes(&self, size: [u32; 2]) -> u64 {
        format_bytes(self.format, size).unwrap_or(0) * u64::from(self.samples)
    }

    /// Makes it.
    ///
    /// # Errors
    /// When the device is out of memory or the size is beyond its limits.
    pub fn create(self, gpu: &Gpu, size: [u32; 2]) -> Result<Image, GpuError> {
        let Self { name, format, samples, usage } = self;
        gpu.image(&ImageDesc { name, size, format, mip_levels: 1, samples, usage, is_cube: false })
    }
}
