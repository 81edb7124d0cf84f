//! What blends, in the order in which it lies at every sample, whatever the order in which it was drawn.
//!
//! The OIT build pass appends its fragments to a linked list a pixel; this pass sorts each list and composes it over the
//! opaque picture, sample by sample. In: lists, linear HDR colour and (with several samples) reversed depth, of all samples.
//! Out: linear HDR colour of one sample, premultiplied. Cost: the lists' memory, and for each sample a walk along its pixel's
//! list. Source: Yang et al. 2010, "Real-Time Concurrent Linked List Construction on the GPU". Twin:
//! `measure::twin::transparency`.
//!
//! Where there are more fragments than entries, those that come late are blended over the opaque picture, from far to near
//! as objects are sorted, and thus below all that was listed: plausible, and seldom seen, since the frame is drawn again
//! with more entries up to [`Lists::MAX_PER_PIXEL`].

use super::full_screen::{self, FullScreenDesc};
use super::{Definition, Pass, no_attachments, no_draws, opaque};
use crate::gpu::{BindGroup, Buffer, Encoder, Gpu, GpuError, Load, Memory, Pipeline, Resource};
use crate::render::options::Transparency;
use crate::render::plan::{PipelineSpec, PlanOptions};
use crate::shader::layout::{TransparencyEntries, TransparencyEntry};
use crate::shader::{Defines, ShaderFile, ShaderKey};
use ash::vk;

pub(super) const PASS: Definition = Definition {
    name: "OIT resolve",
    wanted: |plan, input| match () {
        () if !plan.draws_of(Pass::OitBuild).is_empty() => Ok(()),
        () if input.options.everything && input.options.lists_what_blends() => Ok(()),
        () if plan.blends() => Err("what blends is sorted by objects"),
        () => Err("no material blends"),
    },
    add_draws: no_draws,
    full_screen: |options| Some(desc(options)),
    attachments: no_attachments,
    optional_attachments: &[],
    record: |encoder, frame| {
        let targets = frame.targets;
        let (Some(resolved), Some((lists, _))) = (targets.resolved(), &targets.lists) else { return };
        // What blends nowhere has been resolved already, where there are several samples.
        let load = if frame.options.msaa > 1 { Load::Keep } else { Load::Discard };
        full_screen::record(encoder, frame, Pass::OitResolve, resolved, load, |_| {});
        encoder.copy_buffer(&lists.count, &lists.readback);
    },
};

/// The pipeline that composes the lists of what blends over the opaque picture, and what it reads.
fn desc(options: &PlanOptions) -> FullScreenDesc {
    let defines = Defines::NONE.with(Defines::MULTISAMPLE, options.target.samples > 1);
    let fragment = ShaderKey::new(ShaderFile::OitResolveFrag, defines);
    let weighted = u32::from(options.transparency == Transparency::Weighted);
    let spec = PipelineSpec::full_screen(fragment, vec![("WEIGHTED", weighted)], options.target.color);
    let mut reads = vec![("opaque", opaque::COLOR), ("opaque_depth", opaque::DEPTH)];
    reads.extend(BLOCKS);
    FullScreenDesc { spec, reads }
}

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

    /// The lists as [`LIST_SET`] of the pipelines that build them.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub(in crate::render) fn building_group(&self, gpu: &Gpu, builds: &Pipeline) -> Result<BindGroup, GpuError> {
        let offered = BLOCKS.map(|(block, name)| (block, self.buffer(name).map(Resource::Buffer)));
        let offered: Vec<_> = offered.into_iter().filter_map(|(block, buffer)| Some((block, buffer?))).collect();
        gpu.bind_group(builds, LIST_SET, "OIT lists", &offered)
    }

    /// One of the buffers that shaders know, by its name on the device.
    pub(in crate::render) fn buffer(&self, name: &str) -> Option<&Buffer> {
        [&self.count, &self.heads, &self.entries].into_iter().find(|buffer| buffer.name() == name)
    }

    /// Empties the lists.
    pub(in crate::render) fn clear(&self, encoder: &mut Encoder) {
        encoder.clear_buffers("OIT clear", &[&self.count, &self.heads]);
    }
}

/// Names of the lists' blocks in the shaders, and of their buffers on the device.
const BLOCKS: [(&str, &str); 3] =
    [("TransparencyCount", COUNT_NAME), ("TransparencyHeads", HEADS_NAME), ("TransparencyEntries", ENTRIES_NAME)];

/// How many entries a frame asked for, and how many there were. Beyond them, order is that of objects.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ListUse {
    /// Fragments that blend.
    pub fragments: u32,
    /// Entries of all lists together.
    pub entries: u32,
}

const COUNT_NAME: &str = "OIT count";
const HEADS_NAME: &str = "OIT heads";
const ENTRIES_NAME: &str = "OIT entries";
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
