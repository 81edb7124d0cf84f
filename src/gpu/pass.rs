//! What can be recorded inside a pass.
//!
//! State is bound lazily: pipeline, groups and push constants may come in any order before a draw, and stay bound when
//! the pipeline changes to one with the same sets.

use super::buffer::Buffer;
use super::descriptor::{BindGroup, GroupInner};
use super::device::lock;
use super::encoder::Encoder;
use super::error::GpuError;
use super::interface::SET_COUNT;
use super::pipeline::{Pipeline, PipelineInner, TargetFormats};
use ash::vk;
use std::sync::Arc;

/// Tail padding that a push-constant block may have beyond the values given, bytes.
const PUSH_PADDING: usize = 15;

/// What is bound, and what of it the command buffer does not know yet.
#[derive(Default)]
struct Bound {
    pipeline: Option<Arc<PipelineInner>>,
    groups: [Option<Arc<GroupInner>>; SET_COUNT],
    is_group_stale: [bool; SET_COUNT],
    push: Vec<u8>,
    is_push_stale: bool,
}

impl Bound {
    fn pipeline(&mut self, encoder: &mut Encoder, pipeline: &Pipeline, bind_point: vk::PipelineBindPoint) -> bool {
        let inner = &pipeline.0;
        if self.pipeline.as_ref().is_some_and(|bound| Arc::ptr_eq(bound, inner)) {
            return true;
        }
        if inner.bind_point != bind_point {
            self.pipeline = None;
            encoder.fail(problem(inner, format!("is a {:?} pipeline in a {bind_point:?} pass", inner.bind_point)));
            return false;
        }
        encoder.keep(inner);
        let device = &encoder.gpu().context().device;
        // SAFETY: the pipeline is kept alive and of the pass's kind.
        unsafe { device.cmd_bind_pipeline(encoder.command_buffer, bind_point, inner.raw) };
        self.is_group_stale = [true; SET_COUNT];
        self.is_push_stale = true;
        self.pipeline = Some(inner.clone());
        true
    }

    fn bind(&mut self, encoder: &mut Encoder, set: u32, group: &BindGroup) {
        let index = set as usize;
        match (self.groups.get_mut(index), self.is_group_stale.get_mut(index)) {
            (Some(bound), Some(is_stale)) => {
                *bound = Some(group.0.clone());
                *is_stale = true;
            }
            _ => {
                let problem = format!("set {set} does not exist, sets are 0 to {}", SET_COUNT - 1);
                encoder.fail(GpuError::Interface { pipeline: group.name().to_owned(), problem });
            }
        }
    }

    fn push<T: bytemuck::NoUninit>(&mut self, values: &T) {
        self.push.clear();
        self.push.extend_from_slice(bytemuck::bytes_of(values));
        self.is_push_stale = true;
    }

    /// Records what is stale. On a problem nothing may be drawn.
    fn flush(&mut self, encoder: &mut Encoder) -> Result<Arc<PipelineInner>, GpuError> {
        let Some(pipeline) = self.pipeline.clone() else {
            let problem = "a draw or dispatch without a pipeline".to_owned();
            return Err(GpuError::Interface { pipeline: "none".to_owned(), problem });
        };
        for (set, slots) in pipeline.interface.sets.iter().enumerate() {
            if slots.is_empty() {
                continue;
            }
            let Some(group) = &self.groups[set] else {
                return Err(problem(&pipeline, format!("set {set} is not bound")));
            };
            if group.layout != pipeline.set_layouts[set] {
                return Err(problem(&pipeline, format!("group '{}' is not one for set {set}", group.name)));
            }
            if !self.is_group_stale[set] {
                continue;
            }
            prepare_images(encoder, &pipeline, group)?;
            encoder.keep(group);
            let device = &encoder.gpu().context().device;
            let (point, layout, sets) = (pipeline.bind_point, pipeline.layout, [group.raw]);
            // SAFETY: the set has the layout that the pipeline has at this number, and is kept alive.
            unsafe { device.cmd_bind_descriptor_sets(encoder.command_buffer, point, layout, set as u32, &sets, &[]) };
            self.is_group_stale[set] = false;
        }
        let push_bytes = pipeline.interface.push_bytes as usize;
        if push_bytes > 0 && self.is_push_stale {
            let given = self.push.len();
            if given == 0 || given > push_bytes || push_bytes - given > PUSH_PADDING || !given.is_multiple_of(4) {
                return Err(problem(&pipeline, format!("{given} push-constant bytes given, {push_bytes} expected")));
            }
            let device = &encoder.gpu().context().device;
            let (layout, stages) = (pipeline.layout, pipeline.interface.push_stages);
            // SAFETY: the bytes are within the layout's one range, whose stages these are.
            unsafe { device.cmd_push_constants(encoder.command_buffer, layout, stages, 0, &self.push) };
            self.is_push_stale = false;
        }
        Ok(pipeline)
    }
}

/// Images come into their layouts in a compute pass; in a render pass it is too late, so they must be in it already.
fn prepare_images(encoder: &mut Encoder, pipeline: &PipelineInner, group: &GroupInner) -> Result<(), GpuError> {
    if pipeline.bind_point == vk::PipelineBindPoint::COMPUTE {
        let uses: Vec<_> = group.images.iter().map(|(image, image_use)| (image, *image_use)).collect();
        encoder.transition_all(&uses);
        return Ok(());
    }
    for (image, expected) in &group.images {
        let actual = *lock(&image.last_use);
        if actual != *expected {
            let what = format!("image '{}' of group '{}' is in use as {actual:?}", image.name, group.name);
            return Err(problem(pipeline, format!("{what}, not {expected:?}: list it in the pass's `sampled`")));
        }
    }
    Ok(())
}

fn problem(pipeline: &PipelineInner, problem: String) -> GpuError {
    GpuError::Interface { pipeline: pipeline.name.clone(), problem }
}

/// A pass that draws. Starts without culling, counter-clockwise triangles in front, the whole area as viewport.
pub struct RenderPass<'e> {
    encoder: &'e mut Encoder,
    bound: Bound,
    targets: TargetFormats,
    /// One bit for each location with a stream.
    streams: u32,
    has_indices: bool,
}

impl<'e> RenderPass<'e> {
    pub(crate) fn new(encoder: &'e mut Encoder, targets: TargetFormats, size: [u32; 2]) -> Self {
        let mut pass = Self { encoder, bound: Bound::default(), targets, streams: 0, has_indices: false };
        pass.viewport([0, 0], size);
        pass.cull(vk::CullModeFlags::NONE, vk::FrontFace::COUNTER_CLOCKWISE);
        pass
    }

    /// Draws go to this rectangle, in texels from the upper left corner of the targets.
    pub fn viewport(&mut self, offset: [u32; 2], size: [u32; 2]) {
        let device = &self.encoder.gpu().context().device;
        let limit = self.encoder.gpu().info().max_image_size;
        let [x, y] = offset.map(|side| side.min(limit));
        let [width, height] = size.map(|side| side.clamp(1, limit));
        // A negative height turns clip space Y up.
        let viewport = vk::Viewport {
            x: x as f32,
            y: (y + height) as f32,
            width: width as f32,
            height: -(height as f32),
            min_depth: 0.0,
            max_depth: 1.0,
        };
        let scissor =
            vk::Rect2D { offset: vk::Offset2D { x: x as i32, y: y as i32 }, extent: vk::Extent2D { width, height } };
        // SAFETY: position and size are within the limits of every device that has such images.
        unsafe { device.cmd_set_viewport(self.encoder.command_buffer, 0, &[viewport]) };
        // SAFETY: as above.
        unsafe { device.cmd_set_scissor(self.encoder.command_buffer, 0, &[scissor]) };
    }

    /// Draws with this pipeline from now on.
    pub fn pipeline(&mut self, pipeline: &Pipeline) {
        let targets = &pipeline.0.targets;
        if *targets != self.targets {
            let what = format!("was made for {targets:?} and the pass has {:?}", self.targets);
            self.bound.pipeline = None;
            return self.encoder.fail(problem(&pipeline.0, what));
        }
        self.bound.pipeline(self.encoder, pipeline, vk::PipelineBindPoint::GRAPHICS);
    }

    /// Binds a group to a set.
    pub fn bind(&mut self, set: u32, group: &BindGroup) {
        self.bound.bind(self.encoder, set, group);
    }

    /// Binds the stream of the vertex input at `location`; `stride_bytes` 0 gives every vertex the first value.
    pub fn vertices(&mut self, location: u32, buffer: &Buffer, offset_bytes: u64, stride_bytes: u64) {
        let is_vertex_buffer = buffer.0.usage.contains(vk::BufferUsageFlags::VERTEX_BUFFER);
        if !is_vertex_buffer || offset_bytes >= buffer.bytes() || location >= 16 || stride_bytes > 2048 {
            let problem = format!("cannot be vertex input {location} at {offset_bytes}, stride {stride_bytes}");
            return self.encoder.fail(buffer.0.range(problem));
        }
        self.encoder.keep(&buffer.0);
        let device = &self.encoder.gpu().context().device;
        let (buffers, offsets, strides) = ([buffer.0.raw], [offset_bytes], [stride_bytes]);
        let command_buffer = self.encoder.command_buffer;
        // SAFETY: usage, offset, location and stride were checked; the buffer is kept alive.
        unsafe { device.cmd_bind_vertex_buffers2(command_buffer, location, &buffers, &offsets, None, Some(&strides)) };
        self.streams |= 1 << location;
    }

    /// Binds 32-bit indices that start at `offset_bytes`, a multiple of 4.
    pub fn indices(&mut self, buffer: &Buffer, offset_bytes: u64) {
        let is_index_buffer = buffer.0.usage.contains(vk::BufferUsageFlags::INDEX_BUFFER);
        if !is_index_buffer || offset_bytes >= buffer.bytes() || !offset_bytes.is_multiple_of(4) {
            return self.encoder.fail(buffer.0.range(format!("cannot be indices at {offset_bytes}")));
        }
        self.encoder.keep(&buffer.0);
        let device = &self.encoder.gpu().context().device;
        let (command_buffer, kind) = (self.encoder.command_buffer, vk::IndexType::UINT32);
        // SAFETY: usage, offset and alignment were checked; the buffer is kept alive.
        unsafe { device.cmd_bind_index_buffer(command_buffer, buffer.0.raw, offset_bytes, kind) };
        self.has_indices = true;
    }

    /// Sets the push constants; for the draws of every pipeline until the next call.
    pub fn push<T: bytemuck::NoUninit>(&mut self, values: &T) {
        self.bound.push(values);
    }

    /// Sets which faces are left out and which side is the front, as seen on the picture.
    pub fn cull(&mut self, mode: vk::CullModeFlags, front: vk::FrontFace) {
        let device = &self.encoder.gpu().context().device;
        // SAFETY: dynamic state of every pipeline of this crate.
        unsafe { device.cmd_set_cull_mode(self.encoder.command_buffer, mode) };
        // SAFETY: as above.
        unsafe { device.cmd_set_front_face(self.encoder.command_buffer, front) };
    }

    /// Draws indexed triangles, or what the pipeline's topology says.
    pub fn draw_indexed(&mut self, index_count: u32, instances: u32, first_index: u32, first_instance: u32) {
        let Some(pipeline) = self.ready(true) else { return };
        let device = &self.encoder.gpu().context().device;
        let command_buffer = self.encoder.command_buffer;
        // SAFETY: all that the pipeline needs is bound; robust access bounds indices and vertices.
        unsafe { device.cmd_draw_indexed(command_buffer, index_count, instances, first_index, 0, first_instance) };
        self.encoder.count(u64::from(instances), triangles(pipeline.topology, index_count));
    }

    /// Draws vertices in order.
    pub fn draw(&mut self, vertices: u32, instances: u32) {
        let Some(pipeline) = self.ready(false) else { return };
        let device = &self.encoder.gpu().context().device;
        // SAFETY: all that the pipeline needs is bound; robust access bounds vertices.
        unsafe { device.cmd_draw(self.encoder.command_buffer, vertices, instances, 0, 0) };
        self.encoder.count(u64::from(instances), triangles(pipeline.topology, vertices));
    }

    fn ready(&mut self, is_indexed: bool) -> Option<Arc<PipelineInner>> {
        match self.check_and_flush(is_indexed) {
            Ok(pipeline) => Some(pipeline),
            Err(problem) => {
                self.encoder.fail(problem);
                None
            }
        }
    }

    fn check_and_flush(&mut self, is_indexed: bool) -> Result<Arc<PipelineInner>, GpuError> {
        let pipeline = self.bound.flush(self.encoder)?;
        let inputs = pipeline.interface.inputs;
        if let Some(input) = inputs.iter().find(|input| self.streams & (1 << input.location) == 0) {
            return Err(problem(&pipeline, format!("vertex input {} '{}' is not bound", input.location, input.name)));
        }
        if is_indexed && !self.has_indices {
            return Err(problem(&pipeline, "no indices are bound".to_owned()));
        }
        Ok(pipeline)
    }
}

fn triangles(topology: vk::PrimitiveTopology, vertices: u32) -> u64 {
    u64::from(match topology {
        vk::PrimitiveTopology::TRIANGLE_LIST => vertices / 3,
        vk::PrimitiveTopology::TRIANGLE_STRIP | vk::PrimitiveTopology::TRIANGLE_FAN => vertices.saturating_sub(2),
        _ => 0,
    })
}

/// A pass that computes.
pub struct ComputePass<'e> {
    encoder: &'e mut Encoder,
    bound: Bound,
}

impl<'e> ComputePass<'e> {
    pub(crate) fn new(encoder: &'e mut Encoder) -> Self {
        Self { encoder, bound: Bound::default() }
    }

    /// Dispatches with this pipeline from now on.
    pub fn pipeline(&mut self, pipeline: &Pipeline) {
        self.bound.pipeline(self.encoder, pipeline, vk::PipelineBindPoint::COMPUTE);
    }

    /// Binds a group to a set.
    pub fn bind(&mut self, set: u32, group: &BindGroup) {
        self.bound.bind(self.encoder, set, group);
    }

    /// Sets the push constants; for the dispatches of every pipeline until the next call.
    pub fn push<T: bytemuck::NoUninit>(&mut self, values: &T) {
        self.bound.push(values);
    }

    /// Runs that many workgroups in x, y and z. Dispatches of one pass may overlap; see [`ComputePass::barrier`].
    pub fn dispatch(&mut self, workgroups: [u32; 3]) {
        let pipeline = match self.bound.flush(self.encoder) {
            Ok(pipeline) => pipeline,
            Err(problem) => return self.encoder.fail(problem),
        };
        let limit = self.encoder.gpu().info().max_workgroups;
        if workgroups.iter().zip(limit).any(|(count, most)| *count > most) {
            let what = format!("{workgroups:?} workgroups are beyond this device's {limit:?}");
            return self.encoder.fail(problem(&pipeline, what));
        }
        let [x, y, z] = workgroups;
        let device = &self.encoder.gpu().context().device;
        // SAFETY: all that the pipeline needs is bound; the counts are within the limits.
        unsafe { device.cmd_dispatch(self.encoder.command_buffer, x, y, z) };
        self.encoder.count(0, 0);
    }

    /// Later dispatches of this pass see what earlier ones wrote.
    pub fn barrier(&mut self) {
        self.encoder.compute_barrier();
    }
}
