//! Command pools with their queries, recycled between submissions, and the times that they yield.

use super::calls::Device;
use super::device::{Context, lock};
use super::error::GpuError;
use ash::vk;
use std::sync::Arc;

/// Passes that one pair of query pools serves; more passes add more pairs.
const PASSES_PER_CHUNK: u32 = 32;

/// In bit order, as the results are written ("Vulkan 1.3", Queries).
const STATISTICS: vk::QueryPipelineStatisticFlags = vk::QueryPipelineStatisticFlags::from_raw(
    vk::QueryPipelineStatisticFlags::INPUT_ASSEMBLY_VERTICES.as_raw()
        | vk::QueryPipelineStatisticFlags::INPUT_ASSEMBLY_PRIMITIVES.as_raw()
        | vk::QueryPipelineStatisticFlags::VERTEX_SHADER_INVOCATIONS.as_raw()
        | vk::QueryPipelineStatisticFlags::CLIPPING_INVOCATIONS.as_raw()
        | vk::QueryPipelineStatisticFlags::CLIPPING_PRIMITIVES.as_raw()
        | vk::QueryPipelineStatisticFlags::FRAGMENT_SHADER_INVOCATIONS.as_raw()
        | vk::QueryPipelineStatisticFlags::COMPUTE_SHADER_INVOCATIONS.as_raw(),
);
const STATISTIC_COUNT: usize = STATISTICS.as_raw().count_ones() as usize;

/// What a pass did, as the driver counts. Some software drivers count only the fragments that survive `discard`, or
/// count wrongly.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PassStatistics {
    /// Vertices that were fetched.
    pub input_vertices: u64,
    /// Triangles, lines and points that were assembled.
    pub input_primitives: u64,
    /// Vertex shader invocations.
    pub vertex_invocations: u64,
    /// Primitives that reached clipping.
    pub clipping_invocations: u64,
    /// Primitives that clipping put out.
    pub clipping_primitives: u64,
    /// Fragment shader invocations; survivors only on some drivers.
    pub fragment_invocations: u64,
    /// Compute shader invocations.
    pub compute_invocations: u64,
}

/// One pass of a submission.
#[derive(Debug, Clone, PartialEq)]
pub struct PassTime {
    /// Name of the pass.
    pub name: String,
    /// From the pass's barrier to its end, ms; `None` without timestamps.
    pub gpu_ms: Option<f64>,
    /// From the start of the first pass to the start of this one, ms; `None` without timestamps.
    pub gpu_start_ms: Option<f64>,
    /// Draws and dispatches.
    pub draws: u32,
    /// Instances of all draws.
    pub instances: u64,
    /// Vertices of all draws and instances, as the indices name them: one that triangles share counts for each.
    pub vertices: u64,
    /// Triangles of all draws and instances.
    pub triangles: u64,
    /// The driver's counts, where it has them.
    pub statistics: Option<PassStatistics>,
}

/// Times of a submission.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FrameTimes {
    /// Passes in the order of recording.
    pub passes: Vec<PassTime>,
    /// From the start of the first pass to the end of the last, ms; `None` without timestamps.
    pub gpu_ms: Option<f64>,
    /// From the start of recording to the submission, on the host, ms.
    pub record_ms: f64,
}

/// What recording a pass counted.
#[derive(Debug, Clone, Default)]
pub(crate) struct PassRecord {
    pub(crate) name: String,
    pub(crate) draws: u32,
    pub(crate) instances: u64,
    pub(crate) vertices: u64,
    pub(crate) triangles: u64,
}

impl PassRecord {
    pub(crate) fn without_times(self) -> PassTime {
        let Self { name, draws, instances, vertices, triangles } = self;
        PassTime { name, gpu_ms: None, gpu_start_ms: None, draws, instances, vertices, triangles, statistics: None }
    }
}

struct QueryChunk {
    timestamps: vk::QueryPool,
    /// Null without the feature.
    statistics: vk::QueryPool,
}

/// A command pool with one command buffer, and query pools.
pub(crate) struct RawRecording {
    pool: vk::CommandPool,
    command_buffer: vk::CommandBuffer,
    chunks: Vec<QueryChunk>,
}

impl RawRecording {
    fn new(context: &Context) -> Result<Self, GpuError> {
        let failed = |result| GpuError::from_vk("creating", "command pool", result);
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(context.family);
        // SAFETY: the family is the queue's.
        let pool = unsafe { context.device.create_command_pool(&info, None) }.map_err(failed)?;
        let mut recording = Self { pool, command_buffer: vk::CommandBuffer::null(), chunks: Vec::new() };
        let info = vk::CommandBufferAllocateInfo::default()
            .command_pool(pool)
            .level(vk::CommandBufferLevel::PRIMARY)
            .command_buffer_count(1);
        // SAFETY: the pool was just created.
        match unsafe { context.device.allocate_command_buffers(&info) } {
            Ok(buffers) => recording.command_buffer = buffers.first().copied().unwrap_or_default(),
            Err(result) => {
                recording.destroy(&context.device);
                return Err(failed(result));
            }
        }
        Ok(recording)
    }

    pub(crate) fn destroy(self, device: &Device) {
        for chunk in &self.chunks {
            // SAFETY: the submission that used it has finished.
            unsafe { device.destroy_query_pool(chunk.timestamps, None) };
            // SAFETY: as above; null is allowed.
            unsafe { device.destroy_query_pool(chunk.statistics, None) };
        }
        // SAFETY: as above; the command buffer goes with its pool.
        unsafe { device.destroy_command_pool(self.pool, None) };
    }
}

/// A command buffer in use; returns to the context when the last owner (encoder, submission, device) is done.
pub(crate) struct Recording {
    context: Arc<Context>,
    raw: Option<RawRecording>,
    pub(crate) command_buffer: vk::CommandBuffer,
}

impl Recording {
    /// Takes a free command buffer and begins it.
    pub(crate) fn begin(context: &Arc<Context>, name: &str) -> Result<Self, GpuError> {
        let free = lock(&context.recordings).pop();
        let raw = free.map_or_else(|| RawRecording::new(context), Ok)?;
        let recording = Self { context: context.clone(), command_buffer: raw.command_buffer, raw: Some(raw) };
        recording.start(name)?;
        Ok(recording)
    }

    fn start(&self, name: &str) -> Result<(), GpuError> {
        let failed = |result| GpuError::from_vk("recording", name, result);
        let device = &self.context.device;
        let Some(raw) = &self.raw else { return Ok(()) };
        // SAFETY: the submission that used the pool has finished.
        unsafe { device.reset_command_pool(raw.pool, vk::CommandPoolResetFlags::empty()) }.map_err(failed)?;
        for chunk in &raw.chunks {
            reset(device, chunk);
        }
        let info = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        self.context.set_name(raw.command_buffer, name);
        // SAFETY: the command buffer was just reset with its pool.
        unsafe { device.begin_command_buffer(raw.command_buffer, &info) }.map_err(failed)
    }

    /// Starts counting and timing pass `index`.
    pub(crate) fn begin_pass(&mut self, index: usize, counts_work: bool) {
        let Some((chunk, query)) = self.chunk(index) else { return };
        let (timestamps, statistics) = (chunk.timestamps, chunk.statistics);
        let device = &self.context.device;
        if timestamps != vk::QueryPool::null() {
            let stage = vk::PipelineStageFlags2::ALL_COMMANDS;
            // SAFETY: the query was reset when recording began and is written once.
            unsafe { device.cmd_write_timestamp2(self.command_buffer, stage, timestamps, 2 * query) };
        }
        if counts_work && statistics != vk::QueryPool::null() {
            let flags = vk::QueryControlFlags::empty();
            // SAFETY: as above; begun and ended outside of rendering.
            unsafe { device.cmd_begin_query(self.command_buffer, statistics, query, flags) };
        }
    }

    /// Ends what [`Recording::begin_pass`] started.
    pub(crate) fn end_pass(&mut self, index: usize, counts_work: bool) {
        let Some((chunk, query)) = self.chunk(index) else { return };
        let (timestamps, statistics) = (chunk.timestamps, chunk.statistics);
        let device = &self.context.device;
        if counts_work && statistics != vk::QueryPool::null() {
            // SAFETY: begun by `begin_pass` in this command buffer.
            unsafe { device.cmd_end_query(self.command_buffer, statistics, query) };
        }
        if timestamps != vk::QueryPool::null() {
            let stage = vk::PipelineStageFlags2::ALL_COMMANDS;
            // SAFETY: the query was reset when recording began and is written once.
            unsafe { device.cmd_write_timestamp2(self.command_buffer, stage, timestamps, 2 * query + 1) };
        }
    }

    /// The chunk that serves pass `index`, and its number in it. Without queries a pass just goes untimed.
    fn chunk(&mut self, index: usize) -> Option<(&QueryChunk, u32)> {
        let per_chunk = PASSES_PER_CHUNK as usize;
        let raw = self.raw.as_mut()?;
        if index / per_chunk == raw.chunks.len() {
            raw.chunks.push(new_chunk(&self.context));
        }
        Some((raw.chunks.get(index / per_chunk)?, (index % per_chunk) as u32))
    }

    /// Times of all passes. The submission must have finished.
    pub(crate) fn times(&self, passes: &[PassRecord], record_ms: f64) -> FrameTimes {
        let mut times = FrameTimes { record_ms, ..FrameTimes::default() };
        let (mut first_tick, mut last_tick) = (None, None);
        for (index, record) in passes.iter().enumerate() {
            let mut pass = record.clone().without_times();
            let chunks = self.raw.as_ref().map_or(&[][..], |raw| &raw.chunks);
            if let Some(chunk) = chunks.get(index / PASSES_PER_CHUNK as usize) {
                let query = (index % PASSES_PER_CHUNK as usize) as u32;
                if let Some([start, end]) = self.ticks(chunk, query) {
                    pass.gpu_ms = Some(self.ms_between(start, end));
                    pass.gpu_start_ms = Some(self.ms_between(*first_tick.get_or_insert(start), start));
                    last_tick = Some(end);
                }
                pass.statistics = self.statistics(chunk, query);
            }
            times.passes.push(pass);
        }
        times.gpu_ms = first_tick.zip(last_tick).map(|(first, last)| self.ms_between(first, last));
        times
    }

    fn ticks(&self, chunk: &QueryChunk, query: u32) -> Option<[u64; 2]> {
        if chunk.timestamps == vk::QueryPool::null() {
            return None;
        }
        let mut ticks = [0_u64; 2];
        let (device, flags) = (&self.context.device, vk::QueryResultFlags::TYPE_64);
        // SAFETY: the pool has both queries; the array is as large as two results.
        unsafe { device.get_query_pool_results(chunk.timestamps, 2 * query, &mut ticks, flags) }.ok()?;
        Some(ticks)
    }

    fn statistics(&self, chunk: &QueryChunk, query: u32) -> Option<PassStatistics> {
        if chunk.statistics == vk::QueryPool::null() {
            return None;
        }
        let mut counts = [[0_u64; STATISTIC_COUNT]];
        let (device, flags) = (&self.context.device, vk::QueryResultFlags::TYPE_64);
        // SAFETY: the pool has the query; one element holds one result of as many counts as flags.
        unsafe { device.get_query_pool_results(chunk.statistics, query, &mut counts, flags) }.ok()?;
        let [counts] = counts;
        Some(PassStatistics {
            input_vertices: counts[0],
            input_primitives: counts[1],
            vertex_invocations: counts[2],
            clipping_invocations: counts[3],
            clipping_primitives: counts[4],
            fragment_invocations: counts[5],
            compute_invocations: counts[6],
        })
    }

    fn ms_between(&self, start: u64, end: u64) -> f64 {
        let info = &self.context.info;
        ticks_between(start, end, info.timestamp_bits) as f64 * info.timestamp_period_ns * 1e-6
    }
}

/// Ticks from `start` to `end` of a counter of `bits` that may wrap once.
fn ticks_between(start: u64, end: u64, bits: u32) -> u64 {
    let mask = if bits >= 64 { u64::MAX } else { (1 << bits) - 1 };
    end.wrapping_sub(start) & mask
}

fn reset(device: &Device, chunk: &QueryChunk) {
    if chunk.timestamps != vk::QueryPool::null() {
        // SAFETY: host query reset is a required feature; no submission in flight uses the pool.
        unsafe { device.reset_query_pool(chunk.timestamps, 0, 2 * PASSES_PER_CHUNK) };
    }
    if chunk.statistics != vk::QueryPool::null() {
        // SAFETY: as above.
        unsafe { device.reset_query_pool(chunk.statistics, 0, PASSES_PER_CHUNK) };
    }
}

fn new_chunk(context: &Context) -> QueryChunk {
    let create = |info: vk::QueryPoolCreateInfo<'_>, name: &str| {
        // SAFETY: the count is not zero; statistics are asked for only where the feature is enabled.
        let pool = unsafe { context.device.create_query_pool(&info, None) };
        pool.inspect(|pool| context.set_name(*pool, name)).unwrap_or_default()
    };
    let info = vk::QueryPoolCreateInfo::default();
    let mut chunk = QueryChunk { timestamps: vk::QueryPool::null(), statistics: vk::QueryPool::null() };
    if context.info.timestamp_bits > 0 {
        let info = info.query_type(vk::QueryType::TIMESTAMP).query_count(2 * PASSES_PER_CHUNK);
        chunk.timestamps = create(info, "pass timestamps");
    }
    if context.info.pipeline_statistics {
        let info = info
            .query_type(vk::QueryType::PIPELINE_STATISTICS)
            .query_count(PASSES_PER_CHUNK)
            .pipeline_statistics(STATISTICS);
        chunk.statistics = create(info, "pass statistics");
    }
    reset(&context.device, &chunk);
    chunk
}

impl Drop for Recording {
    fn drop(&mut self) {
        if let Some(raw) = self.raw.take() {
            lock(&self.context.recordings).push(raw);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_counter_of_few_bits_wraps() {
        assert_eq!(ticks_between(10, 30, 64), 20);
        assert_eq!(ticks_between(0xffff_fff0, 0x10, 32), 0x20);
        assert_eq!(ticks_between(u64::MAX, 1, 64), 2);
    }
}
