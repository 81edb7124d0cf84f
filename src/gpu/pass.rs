//! What can be recorded inside a pass.
//!
//! State is bound lazily: pipeline, groups and push constants may come in any order before a draw, and stay bound when
//! the pipeline changes to one with the same sets.

use super::barrier::ImageUse;
use super::buffer::Buffer;
use super::descriptor::{BindGroup, GroupInner};
use super::device::lock;
use super::encoder::Encoder;
use super::error::GpuError;
use super::image::ImageInner;
use super::interface::SET_COUNT;
use super::pipeline::{Pipeline, PipelineInner, TargetFormats, vertex_bytes};
use ash::vk;
use std::sync::Arc;

/// Tail padding that a push-constant block may have beyond the values given, bytes.
const PUSH_PADDING: usize = 15;

/// Uniform blocks of one set, at most; four sets of them are fewer than every device has ("Vulkan 1.3", table "Required
/// Limits", maxDescriptorSetUniformBuffersDynamic: 8).
pub const MAX_OFFSETS: usize = 2;

/// A group, and where each of its uniform blocks starts.
type BoundGroup = (Arc<GroupInner>, [u32; MAX_OFFSETS]);

/// What is bound, and what of it the command buffer does not know yet.
#[derive(Default)]
struct Bound {
    pipeline: Option<Arc<PipelineInner>>,
    groups: [Option<BoundGroup>; SET_COUNT],
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

    fn bind(&mut self, encoder: &mut Encoder, set: u32, group: &BindGroup, offsets: &[u64]) {
        let failed = |problem: String| GpuError::Interface { pipeline: group.name().to_owned(), problem };
        let blocks = &group.0.last_offsets;
        let alignment = encoder.gpu().info().uniform_alignment;
        if offsets.len() > MAX_OFFSETS || blocks.len() > MAX_OFFSETS || offsets.len() > blocks.len() {
            let problem = format!("{} offsets given for {} uniform blocks", offsets.len(), blocks.len());
            return encoder.fail(failed(problem));
        }
        let is_wrong = |(offset, last): (&u64, &u64)| offset > last || !offset.is_multiple_of(alignment);
        if offsets.iter().zip(blocks).any(is_wrong) {
            let problem =
                format!("offsets {offsets:?}: multiples of {alignment} up to {blocks:?} are within the buffers");
            return encoder.fail(failed(problem));
        }
        let mut starts = [0; MAX_OFFSETS];
        for (start, offset) in starts.iter_mut().zip(offsets) {
            *start = *offset as u32;
        }
        let index = set as usize;
        let (Some(bound), Some(is_stale)) = (self.groups.get_mut(index), self.is_group_stale.get_mut(index)) else {
            return encoder.fail(failed(format!("set {set} does not exist, sets are 0 to {}", SET_COUNT - 1)));
        };
        let is_same = |(bound, at): &BoundGroup| Arc::ptr_eq(bound, &group.0) && *at == starts;
        if !bound.as_ref().is_some_and(is_same) {
            *bound = Some((group.0.clone(), starts));
            *is_stale = true;
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
            let Some((group, _)) = &self.groups[set] else {
                return Err(problem(&pipeline, format!("set {set} is not bound")));
            };
            if group.layout != pipeline.set_layouts[set] {
                return Err(problem(&pipeline, format!("group '{}' is not one for set {set}", group.name)));
            }
        }
        let is_used = |set: usize| !pipeline.interface.sets[set].is_empty();
        // A dispatch may find an image as the one before left it, so all groups count; during a render pass none moves.
        if pipeline.bind_point == vk::PipelineBindPoint::COMPUTE {
            let groups = self.groups.iter().enumerate().filter(|(set, _)| is_used(*set));
            let images = groups.flat_map(|(_, group)| group).flat_map(|(group, _)| &group.images);
            let uses: Vec<_> = images.map(|(image, image_use)| (image, *image_use)).collect();
            encoder.transition_all(&uses)?;
        } else {
            let is_stale = |set: usize| is_used(set) && self.is_group_stale[set];
            for (_, bound) in self.groups.iter().enumerate().filter(|(set, _)| is_stale(*set)) {
                for (image, image_use) in bound.iter().flat_map(|(group, _)| &group.images) {
                    check_image(encoder, &pipeline, image, *image_use)?;
                }
            }
        }
        for set in (0..SET_COUNT).filter(|set| is_used(*set)) {
            let Some((group, offsets)) = self.groups[set].as_ref().filter(|_| self.is_group_stale[set]) else {
                continue;
            };
            encoder.keep(group);
            let device = &encoder.gpu().context().device;
            let (point, layout, sets) = (pipeline.bind_point, pipeline.layout, [group.raw]);
            let (commands, offsets) = (encoder.command_buffer, &offsets[..group.last_offsets.len()]);
            // SAFETY: the set has the layout that the pipeline has at this number, and is kept alive; the offsets were
            // checked when it was bound.
            unsafe { device.cmd_bind_descriptor_sets(commands, point, layout, set as u32, &sets, offsets) };
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
fn check_image(
    encoder: &mut Encoder,
    pipeline: &PipelineInner,
    image: &Arc<ImageInner>,
    expected: ImageUse,
) -> Result<(), GpuError> {
    encoder.claim(&[(image, expected)])?;
    let actual = *lock(&image.last_use);
    if actual != expected {
        let what = format!("image '{}' is in use as {actual:?}", image.name);
        return Err(problem(pipeline, format!("{what}, not {expected:?}: list it in the pass's `sampled`")));
    }
    Ok(())
}

fn problem(pipeline: &PipelineInner, problem: String) -> GpuError {
    GpuError::Interface { pipeline: pipeline.name.clone(), problem }
}

/// Vertex inputs that every device has ("Vulkan 1.3", table "Required Limits", maxVertexInputBindings).
const STREAM_COUNT: usize = 16;
/// Largest stride that every device has (the same table, maxVertexInputBindingStride), bytes.
const MAX_STRIDE_BYTES: u64 = 2048;
/// Vertex inputs are made of such components, and aligned to them.
const COMPONENT_BYTES: u64 = 4;

/// All indices are 32-bit.
const INDEX_BYTES: u64 = 4;

/// What one vertex input reads.
#[derive(Clone, Copy)]
struct Stream {
    buffer: vk::Buffer,
    offset_bytes: u64,
    stride_bytes: u64,
    is_stale: bool,
}

/// A pass that draws into its whole area. Starts without culling, counter-clockwise triangles in front.
pub struct RenderPass<'e> {
    encoder: &'e mut Encoder,
    bound: Bound,
    targets: TargetFormats,
    /// Texels of the pass.
    size: [u32; 2],
    is_y_down: bool,
    /// By location.
    streams: [Option<Stream>; STREAM_COUNT],
    /// Indices in the bound range.
    index_count: Option<u64>,
}

impl<'e> RenderPass<'e> {
    pub(crate) fn new(
        encoder: &'e mut Encoder,
        targets: TargetFormats,
        origin: [u32; 2],
        size: [u32; 2],
        is_y_down: bool,
    ) -> Self {
        let streams = [None; STREAM_COUNT];
        let mut pass = Self { encoder, bound: Bound::default(), targets, size, is_y_down, streams, index_count: None };
        pass.draw_to(origin, size);
        pass.cull(vk::CullModeFlags::NONE, vk::FrontFace::COUNTER_CLOCKWISE);
        pass
    }

    /// Draws to a part of the targets from now on: `origin` and `size` in texels from the top left corner. A part that
    /// reaches beyond the pass fails the submission.
    pub fn viewport(&mut self, origin: [u32; 2], size: [u32; 2]) {
        let fits = (0..2).all(|axis| {
            size[axis] > 0 && u64::from(origin[axis]) + u64::from(size[axis]) <= u64::from(self.size[axis])
        });
        if !fits {
            let problem = format!("a viewport of {size:?} at {origin:?} in a pass of {:?}", self.size);
            return self.encoder.fail(GpuError::Interface { pipeline: "none".to_owned(), problem });
        }
        self.draw_to(origin, size);
    }

    fn draw_to(&mut self, origin: [u32; 2], size: [u32; 2]) {
        let device = &self.encoder.gpu().context().device;
        let [left, top] = origin;
        let [width, height] = size;
        // A negative height turns clip space Y up.
        let (y, signed_height) =
            if self.is_y_down { (top as f32, height as f32) } else { ((top + height) as f32, -(height as f32)) };
        let viewport = vk::Viewport {
            x: left as f32,
            y,
            width: width as f32,
            height: signed_height,
            min_depth: 0.0,
            max_depth: 1.0,
        };
        let offset = vk::Offset2D { x: left as i32, y: top as i32 };
        let scissor = vk::Rect2D { offset, extent: vk::Extent2D { width, height } };
        // SAFETY: the area is not empty and within the targets, and a viewport may be as large as any target.
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
        // A pipeline without vertex inputs has fixed strides, which forgets the dynamic ones.
        self.streams.iter_mut().flatten().for_each(|stream| stream.is_stale = true);
    }

    /// Binds a group to a set, its uniform blocks at the start of their buffers.
    pub fn bind(&mut self, set: u32, group: &BindGroup) {
        self.bind_at(set, group, &[]);
    }

    /// Binds a group to a set; each of its uniform blocks, by binding, starts at an offset into its buffer, bytes. Those
    /// without one start at 0.
    pub fn bind_at(&mut self, set: u32, group: &BindGroup, offsets: &[u64]) {
        self.bound.bind(self.encoder, set, group, offsets);
    }

    /// Binds the stream of the vertex input at `location`; `stride_bytes` 0 gives every vertex the first value. Offset
    /// and stride are multiples of 4, and another stride is at least as large as the value of the input.
    pub fn vertices(&mut self, location: u32, buffer: &Buffer, offset_bytes: u64, stride_bytes: u64) {
        let is_vertex_buffer = buffer.0.usage.contains(vk::BufferUsageFlags::VERTEX_BUFFER);
        let is_aligned = offset_bytes.is_multiple_of(COMPONENT_BYTES) && stride_bytes.is_multiple_of(COMPONENT_BYTES);
        let is_within = offset_bytes < buffer.bytes() && stride_bytes <= MAX_STRIDE_BYTES;
        let slot = self.streams.get_mut(location as usize).filter(|_| is_vertex_buffer && is_aligned && is_within);
        let Some(slot) = slot else {
            let problem = format!("cannot be vertex input {location} at {offset_bytes}, stride {stride_bytes}");
            return self.encoder.fail(buffer.0.range(problem));
        };
        *slot = Some(Stream { buffer: buffer.0.raw, offset_bytes, stride_bytes, is_stale: true });
        self.encoder.keep(&buffer.0);
    }

    /// Binds 32-bit indices that start at `offset_bytes`, a multiple of 4.
    pub fn indices(&mut self, buffer: &Buffer, offset_bytes: u64) {
        let is_index_buffer = buffer.0.usage.contains(vk::BufferUsageFlags::INDEX_BUFFER);
        if !is_index_buffer || offset_bytes >= buffer.bytes() || !offset_bytes.is_multiple_of(INDEX_BYTES) {
            return self.encoder.fail(buffer.0.range(format!("cannot be indices at {offset_bytes}")));
        }
        self.encoder.keep(&buffer.0);
        let device = &self.encoder.gpu().context().device;
        let (command_buffer, kind) = (self.encoder.command_buffer, vk::IndexType::UINT32);
        // SAFETY: usage, offset and alignment were checked; the buffer is kept alive.
        unsafe { device.cmd_bind_index_buffer(command_buffer, buffer.0.raw, offset_bytes, kind) };
        self.index_count = Some((buffer.bytes() - offset_bytes) / INDEX_BYTES);
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

    /// Draws indexed triangles, or what the pipeline's topology says. All indices drawn lie in the bound range; what
    /// they say may be anything.
    pub fn draw_indexed(&mut self, index_count: u32, instances: u32, first_index: u32, first_instance: u32) {
        let Some(pipeline) = self.ready(Some(u64::from(first_index) + u64::from(index_count))) else { return };
        let device = &self.encoder.gpu().context().device;
        let command_buffer = self.encoder.command_buffer;
        // SAFETY: all that the pipeline needs is bound, the indices among it; robust access bounds what they point to.
        unsafe { device.cmd_draw_indexed(command_buffer, index_count, instances, first_index, 0, first_instance) };
        self.encoder.count(instances.into(), index_count.into(), triangles(pipeline.topology, index_count));
    }

    /// Draws vertices in order.
    pub fn draw(&mut self, vertices: u32, instances: u32) {
        let Some(pipeline) = self.ready(None) else { return };
        let device = &self.encoder.gpu().context().device;
        // SAFETY: all that the pipeline needs is bound; robust access bounds vertices.
        unsafe { device.cmd_draw(self.encoder.command_buffer, vertices, instances, 0, 0) };
        self.encoder.count(instances.into(), vertices.into(), triangles(pipeline.topology, vertices));
    }

    /// `index_end` is the end of the indices that an indexed draw reads.
    fn ready(&mut self, index_end: Option<u64>) -> Option<Arc<PipelineInner>> {
        match self.check_and_flush(index_end) {
            Ok(pipeline) => Some(pipeline),
            Err(problem) => {
                self.encoder.fail(problem);
                None
            }
        }
    }

    fn check_and_flush(&mut self, index_end: Option<u64>) -> Result<Arc<PipelineInner>, GpuError> {
        let pipeline = self.bound.flush(self.encoder)?;
        for input in pipeline.interface.inputs {
            let wrong =
                |what: &str| problem(&pipeline, format!("vertex input {} '{}' {what}", input.location, input.name));
            let bound = self.streams.get_mut(input.location as usize).and_then(Option::as_mut);
            let stream = bound.ok_or_else(|| wrong("is not bound"))?;
            let (stride, value) = (stream.stride_bytes, vertex_bytes(input.format));
            if stride != 0 && stride < value {
                return Err(wrong(&format!("has {value} bytes and its stream a stride of {stride}")));
            }
            if std::mem::take(&mut stream.is_stale) {
                let device = &self.encoder.gpu().context().device;
                let (buffers, offsets, strides) = ([stream.buffer], [stream.offset_bytes], [stride]);
                let (to, at) = (self.encoder.command_buffer, input.location);
                // SAFETY: usage, offset, location and stride were checked; the buffer is kept alive.
                unsafe { device.cmd_bind_vertex_buffers2(to, at, &buffers, &offsets, None, Some(&strides)) };
            }
        }
        if let Some(end) = index_end {
            let bound = self.index_count.ok_or_else(|| problem(&pipeline, "no indices are bound".to_owned()))?;
            if end > bound {
                return Err(problem(&pipeline, format!("{end} indices are drawn and {bound} are bound")));
            }
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

    /// Binds a group to a set, its uniform blocks at the start of their buffers.
    pub fn bind(&mut self, set: u32, group: &BindGroup) {
        self.bound.bind(self.encoder, set, group, &[]);
    }

    /// Sets the push constants; for the dispatches of every pipeline until the next call.
    pub fn push<T: bytemuck::NoUninit>(&mut self, values: &T) {
        self.bound.push(values);
    }

    /// Runs that many workgroups in x, y and z. Dispatches of one pass may overlap: what one
    /// reads of another's buffers belongs in a pass of its own. An image that bound groups use in two ways fails.
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
        self.encoder.count(0, 0, 0);
    }
}
