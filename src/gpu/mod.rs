//! A thin, safe layer over Vulkan 1.3: the only unsafe code of the crate.
//!
//! One file per Vulkan noun. Choices that hold everywhere:
//!
//! - **Ownership.** Handles are RAII and not `Clone`. An [`Encoder`] keeps alive whatever it records; its submission
//!   keeps it until the timeline semaphore has passed, so a `Drop` never blocks and never frees what the device reads.
//! - **Interface.** Pipelines are built from the reflected [`Shader`](crate::shader::Shader)s; bind groups take
//!   resources by the names that the shaders use. Uniform blocks are bound with offsets: a group stays as it is while the
//!   values that it reads move on in their buffer.
//! - **Steady state.** Descriptor sets, command buffers, queries and slices of host-visible memory are recycled, so that a
//!   frame like the one before creates nothing.
//! - **Synchronization.** One queue. An image knows its last use; buffers are covered by one global memory barrier at
//!   each pass start. All masks are pure functions (`barrier.rs`).
//! - **Errors.** Descriptors are checked when built. Recording does not fail: a draw that would be invalid (a set not
//!   bound, a format that differs) is left out and [`Encoder::submit`] returns the first such error.
//! - **Picture space.** Clip space is Y up (the viewport is flipped), depth 0 to 1.
//! - **Robustness.** `robustBufferAccess` is always on: a shader or vertex fetch out of a buffer reads zero or a value of
//!   that buffer. It does not cover the fetch of indices, so an indexed draw is checked against its index buffer.

mod attachment;
mod barrier;
mod buffer;
mod cache;
mod calls;
mod choose;
mod descriptor;
mod device;
mod encoder;
mod error;
mod features;
mod format;
mod host;
mod image;
mod instance;
mod interface;
mod layout;
mod memory;
mod pass;
mod pipeline;
mod query;
mod readback;
mod retire;
mod sampler;
mod transient;
mod upload;

pub use ash;
pub use ash::vk;
pub use attachment::{ColorTarget, DepthTarget, HostPass, Load, RenderPassDesc};
pub use barrier::ImageUse;
pub use buffer::Buffer;
pub use calls::CallCounts;
pub use choose::{DeviceInfo, DeviceKind, DeviceReport, devices};
pub use descriptor::{BindGroup, Resource};
pub use device::{Gpu, GpuOptions};
pub use encoder::{Encoder, Submission};
pub use error::GpuError;
pub use features::{Feature, Features, WgpuEnables};
pub use format::{format_bytes, level_size};
pub use host::{FrameToken, HostCommands, HostDevice, HostImage, HostRendering};
pub use image::{Image, ImageDesc};
pub use instance::ValidationLog;
pub use memory::{Memory, MemoryReport, MemoryUse};
pub use pass::{ComputePass, MAX_OFFSETS, RenderPass};
pub use pipeline::{BlendState, ColorState, DepthState, GraphicsDesc, Pipeline, TargetFormats};
pub use query::{FrameTimes, PassStatistics, PassTime};
pub use sampler::{Sampler, SamplerDesc};
pub use transient::{TransientPool, TransientSlice};
pub use upload::Upload;
