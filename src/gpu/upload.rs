//! Bytes from the host into device buffers and images, through staging memory.

use super::barrier::{ImageUse, PassKind};
use super::buffer::Buffer;
use super::device::Gpu;
use super::encoder::Encoder;
use super::error::GpuError;
use super::format::{format_bytes, level_size};
use super::image::{Image, ImageInner};
use super::memory::Memory;
use ash::vk;
use std::sync::Arc;

/// Smallest staging buffer, bytes; larger things get a buffer of their own size.
const STAGING_BYTES: u64 = 8 << 20;
/// What waits in staging memory before it is submitted, bytes.
const PENDING_BYTES: u64 = 128 << 20;
/// A multiple of every texel block and of 4, as copies to images want offsets.
const OFFSET_ALIGNMENT: u64 = 16;
/// An upload moves at most `PENDING_BYTES` and one thing more; a minute is far beyond any bus.
const TIMEOUT_MS: u64 = 60_000;

enum Copy {
    Buffer { staging: usize, staging_offset: u64, target: Buffer, target_offset: u64, bytes: u64 },
    Image { staging: usize, staging_offset: u64, target: Arc<ImageInner>, level: u32 },
}

/// Collects uploads; [`Upload::finish`] makes them happen. Ranges of one upload do not overlap.
pub struct Upload {
    gpu: Gpu,
    staging: Vec<Buffer>,
    /// Bytes in use of the last staging buffer.
    used: u64,
    pending_bytes: u64,
    copies: Vec<Copy>,
    problem: Option<GpuError>,
}

impl Gpu {
    /// Starts an upload.
    pub fn upload(&self) -> Upload {
        let gpu = self.clone();
        Upload { gpu, staging: Vec::new(), used: 0, pending_bytes: 0, copies: Vec::new(), problem: None }
    }
}

impl Upload {
    /// Takes a copy of `bytes` for `target`, from `byte_offset` on. An error waits for [`Upload::finish`].
    pub fn buffer(&mut self, target: &Buffer, byte_offset: u64, bytes: &[u8]) {
        let count = bytes.len() as u64;
        if count == 0 {
            return;
        }
        if byte_offset.checked_add(count).is_none_or(|end| end > target.bytes()) {
            let problem = format!("{count} bytes at {byte_offset} do not fit in {}", target.bytes());
            return self.fail(target.0.range(problem));
        }
        let target = Buffer(target.0.clone());
        self.stage(bytes, |staging, staging_offset| Copy::Buffer {
            staging,
            staging_offset,
            target,
            target_offset: byte_offset,
            bytes: count,
        });
    }

    /// Takes a copy of the first mip levels of `target`, each tightly packed from the top row, the faces of a cube
    /// one after another. Afterwards the image can
    /// be sampled. An error waits for [`Upload::finish`].
    pub fn image(&mut self, target: &Image, levels: &[&[u8]]) {
        let inner = &target.0;
        if levels.len() > inner.mip_levels as usize || inner.samples != 1 {
            let problem =
                format!("{} levels given for {} of {} samples", levels.len(), inner.mip_levels, inner.samples);
            return self.fail(inner.range(problem));
        }
        for (level, bytes) in (0_u32..).zip(levels) {
            let size = level_size(inner.size, level);
            let expected = format_bytes(inner.format, size).map(|bytes| bytes * u64::from(inner.layers));
            if expected != Some(bytes.len() as u64) {
                let expected = expected.map_or("an unknown number".to_owned(), |count| count.to_string());
                let what = format!("{} bytes given for level {level} of {size:?} {:?}", bytes.len(), inner.format);
                return self.fail(inner.range(format!("{what}, which has {expected}")));
            }
            let target = inner.clone();
            self.stage(bytes, |staging, staging_offset| Copy::Image { staging, staging_offset, target, level });
        }
    }

    /// Copies everything, waits, and reports the first error of the whole upload.
    ///
    /// # Errors
    /// [`GpuError::Range`] for what did not fit, [`GpuError::OutOfMemory`], [`GpuError::DeviceLost`],
    /// [`GpuError::Timeout`]. What was before the error may have been copied.
    pub fn finish(mut self) -> Result<(), GpuError> {
        self.flush();
        self.problem.take().map_or(Ok(()), Err)
    }

    /// Copies everything at the start of what `encoder` records from now on, without a wait: staging memory lives until
    /// that has finished. Only what waits beyond 128 MiB has been copied by a submission of its own.
    ///
    /// # Errors
    /// Those of [`Self::finish`]. Then what was to be copied is not to be used.
    pub fn record_into(mut self, encoder: &mut Encoder) -> Result<(), GpuError> {
        if self.problem.is_none() && !self.copies.is_empty() {
            self.record_all(encoder)?;
        }
        self.problem.take().map_or(Ok(()), Err)
    }

    fn fail(&mut self, problem: GpuError) {
        self.problem.get_or_insert(problem);
    }

    fn stage(&mut self, bytes: &[u8], copy: impl FnOnce(usize, u64) -> Copy) {
        if self.problem.is_some() {
            return;
        }
        let count = bytes.len() as u64;
        if self.pending_bytes > 0 && self.pending_bytes + count > PENDING_BYTES {
            self.flush();
        }
        let start = self.used.next_multiple_of(OFFSET_ALIGNMENT);
        let has_room = self.staging.last().is_some_and(|staging| start + count <= staging.bytes());
        let offset = if has_room { start } else { 0 };
        if !has_room {
            let size = count.max(STAGING_BYTES);
            match self.gpu.buffer("staging", size, vk::BufferUsageFlags::TRANSFER_SRC, Memory::Upload) {
                Ok(staging) => self.staging.push(staging),
                Err(problem) => return self.fail(problem),
            }
        }
        let index = self.staging.len().saturating_sub(1);
        let Some(staging) = self.staging.last() else { return };
        if let Err(problem) = staging.write(offset, bytes) {
            return self.fail(problem);
        }
        self.used = offset + count;
        self.pending_bytes += count;
        self.copies.push(copy(index, offset));
    }

    fn flush(&mut self) {
        if let Err(problem) = self.try_flush() {
            self.fail(problem);
        }
        self.copies.clear();
        self.staging.clear();
        (self.used, self.pending_bytes) = (0, 0);
    }

    fn try_flush(&self) -> Result<(), GpuError> {
        if self.copies.is_empty() {
            return Ok(());
        }
        let mut encoder = self.gpu.encoder("upload")?;
        self.record_all(&mut encoder)?;
        encoder.submit()?.wait(TIMEOUT_MS)?;
        Ok(())
    }

    fn record_all(&self, encoder: &mut Encoder) -> Result<(), GpuError> {
        let mut images: Vec<&Arc<ImageInner>> = Vec::new();
        for copy in &self.copies {
            if let Copy::Image { target, .. } = copy
                && !images.iter().any(|image| Arc::ptr_eq(image, target))
            {
                images.push(target);
            }
        }
        let with = |image_use| images.iter().map(|image| (*image, image_use)).collect::<Vec<_>>();
        if encoder.begin_pass("upload", PassKind::Copy, &with(ImageUse::CopyTarget)) {
            for copy in &self.copies {
                self.record(encoder, copy);
            }
            encoder.end_pass(PassKind::Copy);
            encoder.transition_all(&with(ImageUse::Sampled))?;
        }
        Ok(())
    }

    fn record(&self, encoder: &mut Encoder, copy: &Copy) {
        match copy {
            Copy::Buffer { staging, staging_offset, target, target_offset, bytes } => {
                let Some(staging) = self.staging.get(*staging) else { return };
                encoder.copy_to_buffer(staging, *staging_offset, target, *target_offset, *bytes);
            }
            Copy::Image { staging, staging_offset, target, level } => {
                let Some(staging) = self.staging.get(*staging) else { return };
                encoder.copy_to_image(staging, *staging_offset, target, *level);
            }
        }
    }
}
