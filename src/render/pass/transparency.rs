//! What blends, in the order in which it lies at every sample, whatever the order in which it was drawn.
//!
//! The transparent pass appends its fragments to a list a pixel instead of writing them; this pass sorts each list and
//! composes it over the opaque picture, sample by sample. In: lists, linear HDR colour and (with several samples) reversed
//! depth, of all samples. Out: linear HDR colour of one sample, premultiplied. Cost: the lists' memory, and for each sample a
//! walk along its pixel's list. Source: Yang et al. 2010, "Real-Time Concurrent Linked List Construction on the GPU".
//! Twin: `material::reference::transparency`.
//!
//! Where there are more fragments than entries, those that come late are blended over the opaque picture, from far to near
//! as objects are sorted, and thus below all that was listed: plausible, and seldom seen, since the frame is drawn again
//! with more entries up to [`Lists::MAX_PER_PIXEL`].

use super::Frame;
use crate::gpu::{
    BindGroup, Buffer, ColorTarget, Encoder, Gpu, GpuError, Load, Memory, Pipeline, RenderPassDesc, Resource,
};
use crate::render::plan::{Pass, Plan};
use crate::render::resources::Resources;
use crate::render::targets::Targets;
use crate::shader::layout::{TransparencyEntries, TransparencyEntry};
use ash::vk;

/// Descriptor set of the lists.
pub const LIST_SET: u32 = 3;

/// The lists of a picture of one size, kept from frame to frame.
pub struct Lists {
    size: [u32; 2],
    capacity: u32,
    count: Buffer,
    heads: Buffer,
    entries: Buffer,
    readback: Buffer,
    has_count: bool,
}

impl Lists {
    /// Entries a pixel, on average, of the first frame.
    pub const FIRST_PER_PIXEL: u32 = 1;
    /// Entries a pixel, on average, beyond which the lists do not grow.
    pub const MAX_PER_PIXEL: u32 = 32;

    /// Entries of the first frame of that size.
    pub fn first_capacity(size: [u32; 2]) -> u32 {
        size[0].saturating_mul(size[1]).saturating_mul(Self::FIRST_PER_PIXEL)
    }

    /// Names on the device and bytes, before they grow.
    pub fn first_bytes(size: [u32; 2]) -> [(&'static str, u64); 3] {
        let heads = u64::from(size[0]) * u64::from(size[1]) * size_of::<u32>() as u64;
        [(COUNT_NAME, COUNT_BYTES), (HEADS_NAME, heads), (ENTRIES_NAME, entry_bytes(Self::first_capacity(size).into()))]
    }

    /// Makes them, with at most as many entries as one buffer of the device holds.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub fn new(gpu: &Gpu, size: [u32; 2], capacity: u32) -> Result<Self, GpuError> {
        let capacity = capacity.min(most_entries(size, gpu.info().max_storage_bytes));
        let usage = vk::BufferUsageFlags::STORAGE_BUFFER;
        let [_, (_, head_bytes), _] = Self::first_bytes(size);
        let device = |name, bytes| gpu.buffer(name, bytes, usage, Memory::Device);
        let entries = device(ENTRIES_NAME, entry_bytes(capacity.into()))?;
        let header = TransparencyEntries { width: size[0], capacity };
        let readback = gpu.buffer(COUNT_NAME, COUNT_BYTES, vk::BufferUsageFlags::TRANSFER_DST, Memory::Readback)?;
        let mut upload = gpu.upload();
        upload.buffer(&entries, 0, bytemuck::bytes_of(&header));
        // A host may ask before the first frame has been drawn.
        upload.buffer(&readback, 0, &[0; COUNT_BYTES as usize]);
        upload.finish()?;
        Ok(Self {
            size,
            capacity,
            count: device(COUNT_NAME, COUNT_BYTES)?,
            heads: device(HEADS_NAME, head_bytes)?,
            entries,
            readback,
            has_count: false,
        })
    }

    /// Whether they are of that size.
    pub fn fit(&self, size: [u32; 2]) -> bool {
        self.size == size
    }

    /// A frame with them has been recorded: its count will be there when it has been drawn.
    pub fn keep_count(&mut self) {
        self.has_count = true;
    }

    /// Fragments of the last frame, and entries that there are.
    ///
    /// # Errors
    /// Those of reading memory.
    pub fn in_use(&self) -> Result<ListUse, GpuError> {
        let counted = if self.has_count { self.readback.read::<u32>()? } else { Vec::new() };
        Ok(ListUse { fragments: counted.first().copied().unwrap_or_default(), entries: self.capacity })
    }

    /// Entries for the fragments of the last frame, where there can be more than there are.
    ///
    /// # Errors
    /// Those of reading memory.
    pub fn larger_capacity(&self, gpu: &Gpu) -> Result<Option<u32>, GpuError> {
        let ListUse { fragments, entries } = self.in_use()?;
        // An eighth more, so that a moving camera does not make every frame a longer one.
        let wanted = fragments.saturating_add(fragments / 8);
        let capacity = wanted.min(most_entries(self.size, gpu.info().max_storage_bytes));
        Ok((fragments > entries && capacity > entries).then_some(capacity))
    }

    /// The lists as [`LIST_SET`] of a pipeline that appends or composes.
    fn group(&self, gpu: &Gpu, pipeline: &Pipeline) -> Result<BindGroup, GpuError> {
        let offered = [
            ("TransparencyCount", Resource::Buffer(&self.count)),
            ("TransparencyHeads", Resource::Buffer(&self.heads)),
            ("TransparencyEntries", Resource::Buffer(&self.entries)),
        ];
        gpu.bind_group(pipeline, LIST_SET, "transparency lists", &offered)
    }
}

/// What one frame composes, and by which pipeline.
pub struct Composition<'a> {
    lists: &'a Lists,
    pipeline: &'a Pipeline,
    /// For those that append.
    appending: BindGroup,
    composing: BindGroup,
    pictures: BindGroup,
}

impl<'a> Composition<'a> {
    /// Binds the lists and what lies behind them; `None` where the plan lists nothing.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub fn new(
        gpu: &Gpu,
        resources: &'a Resources,
        plan: &Plan,
        targets: &Targets,
        lists: Option<&'a Lists>,
    ) -> Result<Option<Self>, GpuError> {
        let appends = plan.pipelines.iter().find(|spec| spec.lists());
        let (Some(spec), Some(appends), Some(lists)) = (&plan.composition, appends, lists) else { return Ok(None) };
        let pipeline = resources.pipeline(spec);
        let offered =
            [("opaque", Resource::Texture(&targets.color)), ("opaque_depth", Resource::Texture(&targets.depth))];
        Ok(Some(Self {
            lists,
            pipeline,
            appending: lists.group(gpu, resources.pipeline(appends))?,
            composing: lists.group(gpu, pipeline)?,
            pictures: gpu.bind_group(pipeline, 0, "transparency", &offered)?,
        }))
    }

    /// [`LIST_SET`] of the pipelines that append.
    pub fn appending(&self) -> &BindGroup {
        &self.appending
    }
}

/// Empties the lists.
pub fn clear(encoder: &mut Encoder, composition: &Composition) {
    let Lists { count, heads, .. } = composition.lists;
    encoder.clear_buffers("clear transparency", &[count, heads]);
}

/// Records the pass.
pub fn record(encoder: &mut Encoder, frame: &Frame, targets: &Targets, composition: &Composition) {
    let Some(resolved) = &targets.resolved else { return };
    let has_samples = targets.color.samples() > 1;
    let color = [ColorTarget {
        image: resolved,
        // What blends nowhere has been resolved already.
        load: if has_samples { Load::Keep } else { Load::Discard },
        store: true,
        resolve: None,
    }];
    let sampled = [&targets.color, &targets.depth];
    let sampled = if has_samples { &sampled[..] } else { &sampled[..1] };
    let name = Pass::Transparency.name();
    encoder.render_pass(
        &RenderPassDesc { name, size: frame.options.size, color: &color, depth: None, sampled },
        |pass| {
            pass.pipeline(composition.pipeline);
            pass.bind(0, &composition.pictures);
            pass.bind(LIST_SET, &composition.composing);
            pass.draw(3, 1);
        },
    );
    encoder.copy_buffer(&composition.lists.count, &composition.lists.readback);
}

/// How many entries a frame asked for, and how many there were. Beyond them, order is that of objects.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ListUse {
    /// Fragments that blend.
    pub fragments: u32,
    /// Entries of all lists together.
    pub entries: u32,
}

const COUNT_NAME: &str = "transparency count";
const HEADS_NAME: &str = "transparency heads";
const ENTRIES_NAME: &str = "transparency entries";
const COUNT_BYTES: u64 = size_of::<u32>() as u64;

/// Bytes of that many entries and what stands before them.
fn entry_bytes(entries: u64) -> u64 {
    size_of::<TransparencyEntries>() as u64 + entries * size_of::<TransparencyEntry>() as u64
}

fn most_entries(size: [u32; 2], max_storage_bytes: u64) -> u32 {
    let pixels = u64::from(size[0]) * u64::from(size[1]);
    let in_one_buffer = (max_storage_bytes - entry_bytes(0)) / size_of::<TransparencyEntry>() as u64;
    (pixels * u64::from(Lists::MAX_PER_PIXEL)).min(in_one_buffer).min(u64::from(u32::MAX) - 1) as u32
}
