//! One function on the device: all samples in one dispatch.

use crate::gpu::{Gpu, GpuError, Memory, Resource, vk};
use crate::shader::function::Function;

/// More than any function takes on a device made of software.
const TIMEOUT_MS: u64 = 60_000;

/// Result words of all `count` samples, one after the other.
pub(super) fn evaluate(gpu: &Gpu, function: &Function, words: &[u32], count: usize) -> Result<Vec<u32>, GpuError> {
    let group = function.shader.workgroup_size[0] as usize;
    let groups = count.div_ceil(group);
    let stride: usize = function.results.iter().map(|value| value.words as usize).sum();
    // The last group's idle invocations write behind the samples; what they read beyond the end is any value.
    let bytes = (groups * group * stride * size_of::<u32>()) as u64;
    let storage = vk::BufferUsageFlags::STORAGE_BUFFER;
    let inputs = gpu.buffer("given", size_of_val(words) as u64, storage, Memory::Upload)?;
    inputs.write(0, words)?;
    let found = gpu.buffer("found", bytes, storage, Memory::Device)?;
    let back = gpu.buffer("back", bytes, vk::BufferUsageFlags::empty(), Memory::Readback)?;
    let pipeline = gpu.compute_pipeline(function.name, function.shader, &[])?;
    let resources = [("given", Resource::Buffer(&inputs)), ("found", Resource::Buffer(&found))];
    let bind_group = gpu.bind_group(&pipeline, 0, function.name, &resources)?;
    let mut encoder = gpu.encoder(function.name)?;
    encoder.compute_pass(function.name, &[], |pass| {
        pass.pipeline(&pipeline);
        pass.bind(0, &bind_group);
        pass.dispatch([groups as u32, 1, 1]);
    });
    encoder.copy_buffer(&found, &back);
    encoder.submit()?.wait(TIMEOUT_MS)?;
    let mut results = back.read::<u32>()?;
    results.truncate(count * stride);
    Ok(results)
}
