//! Recording, submitting and waiting.

use super::attachment::{HostPass, RenderPassDesc, color_attachment, depth_attachment, target_formats};
use super::barrier::{self, ImageUse, PassKind, PassKinds};
use super::buffer::Buffer;
use super::device::{Gpu, lock};
use super::error::GpuError;
use super::format;
use super::host::{FrameToken, HostRendering};
use super::image::{Image, ImageInner};
use super::pass::{ComputePass, RenderPass};
use super::query::{FrameTimes, PassRecord, Recording};
use super::retire::Kept;
use super::transient::TransientSlice;
use ash::vk;
use std::ffi::CString;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::Instant;

/// A command buffer being recorded.
pub struct Encoder {
    gpu: Gpu,
    name: String,
    recording: Option<Recording>,
    pub(crate) command_buffer: vk::CommandBuffer,
    is_on_host: bool,
    passes: Vec<PassRecord>,
    kinds: PassKinds,
    kept: Kept,
    /// Never 0: that is nobody's.
    number: u64,
    /// Images with the use that they had before; restored when nothing is submitted.
    claimed: Vec<(Arc<ImageInner>, ImageUse)>,
    problem: Option<GpuError>,
    started: Instant,
}

impl Encoder {
    pub(crate) fn new(gpu: &Gpu, name: &str) -> Result<Self, GpuError> {
        gpu.context().retire()?;
        let recording = Recording::begin(gpu.context(), name)?;
        let command_buffer = recording.command_buffer;
        Ok(Self::start(gpu, name, Some(recording), command_buffer))
    }

    pub(crate) fn on_host(gpu: &Gpu, name: &str, command_buffer: vk::CommandBuffer) -> Self {
        Self::start(gpu, name, None, command_buffer)
    }

    fn start(gpu: &Gpu, name: &str, recording: Option<Recording>, command_buffer: vk::CommandBuffer) -> Self {
        let (kept, claimed) = lock(&gpu.context().spare).take();
        let encoder = Self {
            gpu: gpu.clone(),
            name: name.to_owned(),
            is_on_host: recording.is_none(),
            recording,
            command_buffer,
            passes: Vec::new(),
            kinds: PassKinds::default(),
            kept,
            number: gpu.context().encoders.fetch_add(1, Ordering::Relaxed) + 1,
            claimed,
            problem: None,
            started: Instant::now(),
        };
        encoder.barriers(&[barrier::at_start().memory_barrier()], &[]);
        encoder
    }

    /// The device that this records for.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Records a pass that draws. A target that does not fit leaves the pass out and fails the submission.
    pub fn render_pass(&mut self, desc: &RenderPassDesc<'_>, record: impl FnOnce(&mut RenderPass<'_>)) {
        let formats = match target_formats(desc) {
            Ok(formats) => formats,
            Err(problem) => return self.fail(GpuError::Interface { pipeline: desc.name.to_owned(), problem }),
        };
        let mut uses = Vec::new();
        for target in desc.color {
            uses.push((&target.image.0, ImageUse::ColorTarget));
            uses.extend(target.resolve.map(|image| (&image.0, ImageUse::ColorTarget)));
        }
        uses.extend(desc.depth.map(|target| (&target.image.0, ImageUse::DepthTarget)));
        uses.extend(desc.sampled.iter().map(|image| (&image.0, ImageUse::Sampled)));
        if !self.begin_pass(desc.name, PassKind::Render, &uses) {
            return;
        }

        let colors: Vec<_> = desc.color.iter().map(color_attachment).collect();
        let depth = desc.depth.map(depth_attachment);
        let [width, height] = desc.size;
        let area = vk::Rect2D::default().extent(vk::Extent2D { width, height });
        let mut info = vk::RenderingInfo::default().render_area(area).layer_count(1).color_attachments(&colors);
        if let Some(depth) = &depth {
            info = info.depth_attachment(depth);
        }
        // SAFETY: sizes, samples and formats of the targets were checked and they are in the layouts of their use.
        unsafe { self.gpu.context().device.cmd_begin_rendering(self.command_buffer, &info) };
        let mut pass = RenderPass::new(self, formats, [0; 2], desc.size, false);
        record(&mut pass);
        // SAFETY: begun above; passes do not nest because `record` has the only reference.
        unsafe { self.gpu.context().device.cmd_end_rendering(self.command_buffer) };
        self.end_pass(PassKind::Render);
    }

    /// Records into a pass of the host's: draws alone, on targets that the host has bound, in its command buffer. Images
    /// that are read must have been brought into that use before the host's pass began.
    pub fn host_pass(&mut self, desc: &HostPass<'_>, record: impl FnOnce(&mut RenderPass<'_>)) {
        let HostRendering { command_buffer, formats } = desc.rendering;
        let own = std::mem::replace(&mut self.command_buffer, command_buffer);
        self.passes.push(PassRecord { name: desc.name.to_owned(), ..PassRecord::default() });
        let is_labelled = self.begin_label(desc.name);
        record(&mut RenderPass::new(self, formats, desc.origin, desc.size, desc.is_y_down));
        if is_labelled {
            self.end_label();
        }
        self.command_buffer = own;
    }

    /// Records a pass that computes. Images of bound groups come into the layouts that they need by themselves;
    /// `sampled` is for images that are read otherwise.
    pub fn compute_pass(&mut self, name: &str, sampled: &[&Image], record: impl FnOnce(&mut ComputePass<'_>)) {
        let uses: Vec<_> = sampled.iter().map(|image| (&image.0, ImageUse::Sampled)).collect();
        if !self.begin_pass(name, PassKind::Compute, &uses) {
            return;
        }
        record(&mut ComputePass::new(self));
        self.end_pass(PassKind::Compute);
    }

    /// Copies level 0 of `image`, rows tightly packed from the top, to the start of `buffer`.
    pub fn copy_image_to_buffer(&mut self, image: &Image, buffer: &Buffer) {
        let inner = &image.0;
        let bytes = format::format_bytes(inner.format, inner.size).map(|bytes| bytes * u64::from(inner.layers));
        let fits = bytes.is_some_and(|bytes| bytes <= buffer.bytes());
        if !fits || inner.samples != 1 || !inner.usage.contains(vk::ImageUsageFlags::TRANSFER_SRC) {
            let what = format!("{:?} of {:?} texels, {} samples", inner.format, inner.size, inner.samples);
            let problem = format!("{what}, cannot be copied to '{}' of {} bytes", buffer.name(), buffer.bytes());
            return self.fail(inner.range(problem));
        }
        if !self.begin_pass(&format!("copy {}", inner.name), PassKind::Copy, &[(inner, ImageUse::CopySource)]) {
            return;
        }
        let region = copy_region(inner, 0, 0);
        self.kept.keep(&buffer.0);
        let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
        let (device, target) = (&self.gpu.context().device, buffer.0.raw);
        // SAFETY: the image is in the layout, the buffer holds the level, both are kept alive.
        unsafe { device.cmd_copy_image_to_buffer(self.command_buffer, inner.raw, layout, target, &[region]) };
        self.end_pass(PassKind::Copy);
    }

    /// Copies all bytes of `source` to the start of `target`.
    pub fn copy_buffer(&mut self, source: &Buffer, target: &Buffer) {
        if source.bytes() > target.bytes() || Arc::ptr_eq(&source.0, &target.0) {
            let problem = format!("does not hold the {} bytes of '{}'", source.bytes(), source.name());
            return self.fail(target.0.range(problem));
        }
        if self.begin_pass(&format!("copy {}", source.name()), PassKind::Copy, &[]) {
            self.copy_to_buffer(source, 0, target, 0, source.bytes());
            self.end_pass(PassKind::Copy);
        }
    }

    /// Writes zeros over all bytes of the buffers, of which each is a multiple of 4, in a pass of that name.
    pub fn clear_buffers(&mut self, name: &str, buffers: &[&Buffer]) {
        let is_target = |buffer: &&&Buffer| buffer.0.usage.contains(vk::BufferUsageFlags::TRANSFER_DST);
        if let Some(odd) = buffers.iter().find(|buffer| !buffer.bytes().is_multiple_of(4) || !is_target(buffer)) {
            let problem = format!("{} bytes cannot be cleared: no multiple of 4, or no TRANSFER_DST", odd.bytes());
            return self.fail(odd.0.range(problem));
        }
        if !self.begin_pass(name, PassKind::Copy, &[]) {
            return;
        }
        for buffer in buffers {
            self.kept.keep(&buffer.0);
            let device = &self.gpu.context().device;
            // SAFETY: usage and size were checked; the buffer is kept alive.
            unsafe { device.cmd_fill_buffer(self.command_buffer, buffer.0.raw, 0, vk::WHOLE_SIZE, 0) };
        }
        self.end_pass(PassKind::Copy);
    }

    /// Brings an image into the layout of a use outside of the passes, for example the host's.
    pub fn transition(&mut self, image: &Image, image_use: ImageUse) {
        if image_use == ImageUse::Undefined || image_use == ImageUse::Host(vk::ImageLayout::UNDEFINED) {
            return self.fail(image.0.range("an image cannot be made undefined".to_owned()));
        }
        if let Err(problem) = self.transition_all(&[(&image.0, image_use)]) {
            self.fail(problem);
        }
    }

    /// Submits what was recorded.
    ///
    /// # Errors
    /// The first error of recording ([`GpuError::Interface`], [`GpuError::Range`]), [`GpuError::HostSubmits`],
    /// [`GpuError::OutOfMemory`] or [`GpuError::DeviceLost`]. Then nothing was submitted.
    pub fn submit(mut self) -> Result<Submission, GpuError> {
        if let Some(problem) = self.problem.take() {
            return Err(problem);
        }
        let Some(recording) = self.recording.take() else {
            return Err(GpuError::HostSubmits { name: self.name.clone() });
        };
        self.barriers(&[barrier::at_end().memory_barrier()], &[]);
        let gpu = self.gpu.clone();
        let context = gpu.context();
        let failed = |result| GpuError::from_vk("submitting", &self.name, result);
        // SAFETY: the command buffer is recording and outside of any pass.
        unsafe { context.device.end_command_buffer(self.command_buffer) }.map_err(failed)?;

        let recording = Arc::new(recording);
        let buffers = [vk::CommandBufferSubmitInfo::default().command_buffer(self.command_buffer)];
        let mut queue = lock(&context.queue);
        let value = queue.last_submitted + 1;
        let signals = [vk::SemaphoreSubmitInfo::default()
            .semaphore(context.timeline)
            .value(value)
            .stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)];
        let submit = vk::SubmitInfo2::default().command_buffer_infos(&buffers).signal_semaphore_infos(&signals);
        // SAFETY: the lock is the queue's external synchronization; all that is referred to is kept below.
        unsafe { context.device.queue_submit2(queue.raw, &[submit], vk::Fence::null()) }.map_err(failed)?;
        queue.last_submitted = value;
        drop(queue);

        self.release();
        let mut kept = std::mem::take(&mut self.kept);
        kept.keep(&recording);
        lock(&context.retired).submitted(value, kept);
        Ok(Submission {
            name: std::mem::take(&mut self.name),
            recording,
            passes: std::mem::take(&mut self.passes),
            value,
            record_ms: self.started.elapsed().as_secs_f64() * 1e3,
            gpu: gpu.clone(),
        })
    }

    /// Ends recording into the host's command buffers, which the host ends and submits. The token stands for what was
    /// recorded, whole or not: after an error the command buffers are valid all the same, the failing draws are not in them.
    pub fn finish_on_host(mut self) -> (FrameToken, Result<(), GpuError>) {
        let token = FrameToken { frame: self.number, device: Arc::as_ptr(self.gpu.context()).addr() };
        (token, self.problem.take().map_or(Ok(()), Err))
    }

    /// Takes the first problem of recording so far, so that it fails nothing else.
    pub fn take_problem(&mut self) -> Option<GpuError> {
        self.problem.take()
    }

    /// A number that no other encoder of the device has.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Keeps the first problem of recording for `submit`.
    pub(crate) fn fail(&mut self, problem: GpuError) {
        self.problem.get_or_insert(problem);
    }

    pub(crate) fn keep<T: std::any::Any + Send + Sync>(&mut self, thing: &Arc<T>) {
        self.kept.keep(thing);
    }

    /// Keeps a slice until what is recorded has finished: groups keep buffers, and know nothing of the slices in them.
    pub fn keep_slice(&mut self, slice: &TransientSlice) {
        self.kept.keep(&slice.0);
    }

    /// Counts a draw or dispatch; vertices and triangles are those of one instance.
    pub(crate) fn count(&mut self, instances: u64, vertices: u64, triangles: u64) {
        if let Some(pass) = self.passes.last_mut() {
            pass.draws += 1;
            pass.instances += instances;
            pass.vertices += vertices * instances;
            pass.triangles += triangles * instances;
        }
    }

    /// Gives the images back to other encoders.
    fn release(&mut self) {
        for (image, _) in self.claimed.drain(..) {
            image.recorder.store(0, Ordering::Release);
        }
    }

    /// Makes what was written so far visible to draws in the host's own passes, in which no barrier can stand.
    pub(crate) fn before_host_passes(&self) {
        if let Some(dependency) = barrier::before_pass(self.kinds, PassKind::Render) {
            self.barriers(&[dependency.memory_barrier()], &[]);
        }
    }

    /// The one place where a pass begins: label, barriers, then its time and counts. False where it cannot begin: then
    /// the submission fails, and nothing of the pass may be recorded.
    pub(crate) fn begin_pass(&mut self, name: &str, kind: PassKind, uses: &[(&Arc<ImageInner>, ImageUse)]) -> bool {
        if let Err(problem) = self.transition_all(uses) {
            self.fail(problem);
            return false;
        }
        let index = self.passes.len();
        self.passes.push(PassRecord { name: name.to_owned(), ..PassRecord::default() });
        self.begin_label(name);
        if let Some(dependency) = barrier::before_pass(self.kinds, kind) {
            self.barriers(&[dependency.memory_barrier()], &[]);
        }
        self.kinds.insert(kind);
        if let Some(recording) = &mut self.recording {
            recording.begin_pass(index, kind != PassKind::Copy);
        }
        self.fence_timestamp();
        true
    }

    /// Keeps a timestamp apart from the work on either side. Tile-based devices, lavapipe among them, put work off until
    /// somebody waits for it, and a timestamp between with it: a pass's time would be booked on another one.
    fn fence_timestamp(&self) {
        if self.recording.is_some() {
            self.barriers(&[barrier::order().memory_barrier()], &[]);
        }
    }

    pub(crate) fn end_pass(&mut self, kind: PassKind) {
        let index = self.passes.len().saturating_sub(1);
        self.fence_timestamp();
        if let Some(recording) = &mut self.recording {
            recording.end_pass(index, kind != PassKind::Copy);
        }
        self.fence_timestamp();
        if self.passes.last().is_some_and(|pass| !pass.name.contains('\0')) {
            self.end_label();
        }
    }

    /// Whether a label began, which [`Self::end_label`] then ends.
    fn begin_label(&self, name: &str) -> bool {
        let (Some(debug), Ok(name)) = (&self.gpu.context().debug, CString::new(name)) else { return false };
        let label = vk::DebugUtilsLabelEXT::default().label_name(&name);
        // SAFETY: the extension is enabled; the pass ends the label.
        unsafe { debug.cmd_begin_debug_utils_label(self.command_buffer, &label) };
        true
    }

    fn end_label(&self) {
        let Some(debug) = &self.gpu.context().debug else { return };
        // SAFETY: ends the label that `begin_label` began.
        unsafe { debug.cmd_end_debug_utils_label(self.command_buffer) };
    }

    /// Takes the images for this encoder until it is submitted or dropped, or says why that cannot be. What an encoder
    /// believes of an image's layout thus never depends on another one that may be submitted later or not at all.
    pub(crate) fn claim(&mut self, uses: &[(&Arc<ImageInner>, ImageUse)]) -> Result<(), GpuError> {
        for (index, (image, image_use)) in uses.iter().enumerate() {
            let earlier = uses[..index].iter().find(|(earlier, _)| Arc::ptr_eq(earlier, image));
            if let Some((_, other)) = earlier.filter(|(_, other)| other != image_use) {
                return Err(image.range(format!("used as {other:?} and {image_use:?} at once")));
            }
        }
        for (image, _) in uses {
            match image.recorder.compare_exchange(0, self.number, Ordering::AcqRel, Ordering::Acquire) {
                Ok(_) => self.claimed.push(((*image).clone(), *lock(&image.last_use))),
                Err(holder) if holder == self.number => {}
                Err(_) => {
                    let problem = "another encoder has recorded it: submit or drop that one first".to_owned();
                    return Err(image.range(problem));
                }
            }
        }
        Ok(())
    }

    /// Brings every image into its use, in one command. On an error nothing is recorded.
    pub(crate) fn transition_all(&mut self, uses: &[(&Arc<ImageInner>, ImageUse)]) -> Result<(), GpuError> {
        self.claim(uses)?;
        let mut image_barriers = Vec::new();
        for (index, (image, after)) in uses.iter().enumerate() {
            if uses[..index].iter().any(|(earlier, _)| Arc::ptr_eq(earlier, image)) {
                continue;
            }
            self.kept.keep(image);
            let before = std::mem::replace(&mut *lock(&image.last_use), *after);
            if let Some(dependency) = barrier::between_uses(before, *after) {
                image_barriers.push(dependency.image_barrier(image.raw, format::aspects(image.format)));
            }
        }
        self.barriers(&[], &image_barriers);
        Ok(())
    }

    /// Copies between buffers inside of a copy pass; the caller has checked the ranges.
    pub(crate) fn copy_to_buffer(
        &mut self,
        source: &Buffer,
        source_offset: u64,
        target: &Buffer,
        target_offset: u64,
        bytes: u64,
    ) {
        self.kept.keep(&source.0);
        self.kept.keep(&target.0);
        let region = vk::BufferCopy { src_offset: source_offset, dst_offset: target_offset, size: bytes };
        let device = &self.gpu.context().device;
        // SAFETY: the ranges are within both buffers, which are kept alive.
        unsafe { device.cmd_copy_buffer(self.command_buffer, source.0.raw, target.0.raw, &[region]) };
    }

    /// Copies a tightly packed level inside of a copy pass that has the image as copy target.
    pub(crate) fn copy_to_image(&mut self, source: &Buffer, source_offset: u64, image: &Arc<ImageInner>, level: u32) {
        self.kept.keep(&source.0);
        let region = copy_region(image, source_offset, level);
        let layout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
        let device = &self.gpu.context().device;
        // SAFETY: the caller checked level and bytes; the image is in the layout; both are kept alive.
        unsafe { device.cmd_copy_buffer_to_image(self.command_buffer, source.0.raw, image.raw, layout, &[region]) };
    }

    fn barriers(&self, memory: &[vk::MemoryBarrier2<'_>], images: &[vk::ImageMemoryBarrier2<'_>]) {
        if memory.is_empty() && images.is_empty() {
            return;
        }
        let info = vk::DependencyInfo::default().memory_barriers(memory).image_memory_barriers(images);
        // SAFETY: recorded outside of rendering; masks come from `barrier`, layouts from the images' last use.
        unsafe { self.gpu.context().device.cmd_pipeline_barrier2(self.command_buffer, &info) };
    }
}

impl Drop for Encoder {
    fn drop(&mut self) {
        if self.is_on_host {
            let kept = std::mem::take(&mut self.kept);
            lock(&self.gpu.context().retired).recorded_on_host(self.number, kept);
        } else {
            // Not submitted: the images are still what they were.
            for (image, before) in &self.claimed {
                *lock(&image.last_use) = *before;
            }
        }
        self.release();
        lock(&self.gpu.context().spare).claimed.push(std::mem::take(&mut self.claimed));
    }
}

/// Work that the device has been given. Dropping it neither waits nor cancels.
pub struct Submission {
    gpu: Gpu,
    name: String,
    recording: Arc<Recording>,
    passes: Vec<PassRecord>,
    value: u64,
    record_ms: f64,
}

impl Submission {
    /// Waits until the work has finished and reports its times.
    ///
    /// # Errors
    /// [`GpuError::Timeout`] (may be waited for again), [`GpuError::DeviceLost`] or [`GpuError::OutOfMemory`].
    pub fn wait(&self, timeout_ms: u64) -> Result<FrameTimes, GpuError> {
        self.gpu.context().wait(&self.name, self.value, Some(timeout_ms))?;
        Ok(self.recording.times(&self.passes, self.record_ms))
    }
}

fn copy_region(image: &ImageInner, buffer_offset: u64, mip_level: u32) -> vk::BufferImageCopy {
    let [width, height] = format::level_size(image.size, mip_level);
    vk::BufferImageCopy::default()
        .buffer_offset(buffer_offset)
        .image_subresource(vk::ImageSubresourceLayers {
            aspect_mask: format::view_aspect(image.format),
            mip_level,
            base_array_layer: 0,
            layer_count: image.layers,
        })
        .image_extent(vk::Extent3D { width, height, depth: 1 })
}
