//! Images back to the host.

use super::buffer::Buffer;
use super::device::Gpu;
use super::error::GpuError;
use super::format::format_bytes;
use super::image::Image;
use super::memory::Memory;
use ash::vk;

/// The copy waits for all earlier work of the queue; software devices take seconds for a heavy frame.
const TIMEOUT_MS: u64 = 120_000;

impl Gpu {
    /// Reads level 0 of an image: rows tightly packed from the top, faces one after another, texels in the image's format. Waits for all earlier
    /// work.
    ///
    /// # Errors
    /// [`GpuError::Unsupported`] for a format without a known layout, [`GpuError::Range`] for a multisampled image,
    /// [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`], [`GpuError::Timeout`].
    pub fn read_image(&self, image: &Image) -> Result<Vec<u8>, GpuError> {
        let bytes = format_bytes(image.format(), image.size()).ok_or_else(|| GpuError::Unsupported {
            name: image.name().to_owned(),
            problem: format!("reading back {:?}", image.format()),
        })? * u64::from(image.0.layers);
        let buffer = self.buffer("readback", bytes, vk::BufferUsageFlags::TRANSFER_DST, Memory::Readback)?;
        self.read_image_through(image, &buffer)
    }

    /// The same through a [`Memory::Readback`] buffer that is at hand, of exactly the image's bytes.
    ///
    /// # Errors
    /// Those of [`Self::read_image`].
    pub fn read_image_through(&self, image: &Image, buffer: &Buffer) -> Result<Vec<u8>, GpuError> {
        let mut encoder = self.encoder("readback")?;
        encoder.copy_image_to_buffer(image, buffer);
        encoder.submit()?.wait(TIMEOUT_MS)?;
        buffer.read()
    }
}
