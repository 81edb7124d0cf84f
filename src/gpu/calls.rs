//! The logical device, with every call to it counted: what a frame leaves out is known by what it did not call.
//!
//! [`Device`] has exactly the functions that this crate calls, declared in one list; nothing else reaches the handle but
//! what [`Device::uncounted`] names. A count costs one relaxed addition.

use super::device::Gpu;
use ash::prelude::VkResult;
use ash::vk;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};

/// How often each Vulkan function of a device was called, and what the host wrote for the device.
///
/// Not in it: functions of the instance, object names and labels of `VK_EXT_debug_utils`, and the memory blocks that
/// the allocator takes, which [`MemoryReport::blocks`](super::MemoryReport::blocks) counts.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CallCounts {
    /// Calls by Vulkan name, such as `vkCmdDrawIndexed`; functions without a call are left out.
    pub by_name: BTreeMap<String, u64>,
    /// Bytes that the host wrote into memory of the device, staging memory included: every byte on its way to a buffer
    /// or image counts once. Push constants are in their calls.
    pub uploaded_bytes: u64,
}

impl CallCounts {
    /// Calls of one function, by its Vulkan name.
    pub fn of(&self, name: &str) -> u64 {
        self.by_name.get(name).copied().unwrap_or(0)
    }

    /// Calls of all functions.
    pub fn total(&self) -> u64 {
        self.by_name.values().sum()
    }

    /// What was added since `earlier` counts of the same device.
    pub fn since(&self, earlier: &Self) -> Self {
        let added = |(name, count): (&String, &u64)| (name.clone(), count.saturating_sub(earlier.of(name)));
        Self {
            by_name: self.by_name.iter().map(added).filter(|(_, count)| *count > 0).collect(),
            uploaded_bytes: self.uploaded_bytes.saturating_sub(earlier.uploaded_bytes),
        }
    }
}

impl Gpu {
    /// All calls so far, by all who share the device.
    pub fn calls(&self) -> CallCounts {
        self.context().device.counts()
    }
}

/// A logical device, destroyed on drop unless a host owns it.
pub(crate) struct Device {
    raw: ash::Device,
    is_owned: bool,
    counters: Counters,
    uploaded_bytes: AtomicU64,
}

impl Device {
    pub(crate) fn new(raw: ash::Device, is_owned: bool) -> Self {
        Self { raw, is_owned, counters: Counters::default(), uploaded_bytes: AtomicU64::new(0) }
    }

    /// The handle itself, for the allocator and for extensions, which load functions of their own.
    pub(crate) fn uncounted(&self) -> &ash::Device {
        &self.raw
    }

    /// Books bytes that the host wrote into mapped memory: a write is no call.
    pub(crate) fn count_upload(&self, bytes: u64) {
        self.uploaded_bytes.fetch_add(bytes, Ordering::Relaxed);
    }

    fn counts(&self) -> CallCounts {
        let named = self.counters.by_function().into_iter().filter(|(_, count)| *count > 0);
        CallCounts {
            by_name: named.map(|(name, count)| (vulkan_name(name), count)).collect(),
            uploaded_bytes: self.uploaded_bytes.load(Ordering::Relaxed),
        }
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        if self.is_owned {
            // SAFETY: created here; all child objects hold the context and so are gone.
            unsafe { self.raw.destroy_device(None) };
        }
    }
}

/// `vkCmdDrawIndexed` from `cmd_draw_indexed`.
fn vulkan_name(function: &str) -> String {
    let capital =
        |word: &str| word.chars().take(1).map(|c| c.to_ascii_uppercase()).chain(word.chars().skip(1)).collect();
    "vk".to_owned() + &function.split('_').map(capital).collect::<Vec<String>>().concat()
}

type Callbacks<'a> = Option<&'a vk::AllocationCallbacks<'a>>;
type Pipelines = Result<Vec<vk::Pipeline>, (Vec<vk::Pipeline>, vk::Result)>;

/// A counter and a counting method for each function, as `ash` declares it.
macro_rules! functions {
    ($(fn $name:ident $(<$generic:ident>)? ($($argument:ident: $type:ty),* $(,)?) $(-> $result:ty)?;)*) => {
        #[derive(Default)]
        struct Counters {
            $($name: AtomicU64,)*
        }

        impl Counters {
            fn by_function(&self) -> Vec<(&'static str, u64)> {
                vec![$((stringify!($name), self.$name.load(Ordering::Relaxed)),)*]
            }
        }

        impl Device {
            $(pub(crate) unsafe fn $name $(<$generic>)? (&self, $($argument: $type),*) $(-> $result)? {
                self.counters.$name.fetch_add(1, Ordering::Relaxed);
                // SAFETY: the caller keeps to the valid usage of the function, which is all that this one does.
                unsafe { self.raw.$name($($argument),*) }
            })*
        }
    };
}

functions! {
    fn allocate_command_buffers(info: &vk::CommandBufferAllocateInfo<'_>) -> VkResult<Vec<vk::CommandBuffer>>;
    fn allocate_descriptor_sets(info: &vk::DescriptorSetAllocateInfo<'_>) -> VkResult<Vec<vk::DescriptorSet>>;
    fn begin_command_buffer(commands: vk::CommandBuffer, info: &vk::CommandBufferBeginInfo<'_>) -> VkResult<()>;
    fn bind_buffer_memory(buffer: vk::Buffer, memory: vk::DeviceMemory, offset: vk::DeviceSize) -> VkResult<()>;
    fn bind_image_memory(image: vk::Image, memory: vk::DeviceMemory, offset: vk::DeviceSize) -> VkResult<()>;
    fn cmd_begin_query(
        commands: vk::CommandBuffer, pool: vk::QueryPool, query: u32, flags: vk::QueryControlFlags,
    );
    fn cmd_begin_rendering(commands: vk::CommandBuffer, info: &vk::RenderingInfo<'_>);
    fn cmd_bind_descriptor_sets(
        commands: vk::CommandBuffer, point: vk::PipelineBindPoint, layout: vk::PipelineLayout, first_set: u32,
        sets: &[vk::DescriptorSet], dynamic_offsets: &[u32],
    );
    fn cmd_bind_index_buffer(
        commands: vk::CommandBuffer, buffer: vk::Buffer, offset: vk::DeviceSize, kind: vk::IndexType,
    );
    fn cmd_bind_pipeline(commands: vk::CommandBuffer, point: vk::PipelineBindPoint, pipeline: vk::Pipeline);
    fn cmd_bind_vertex_buffers2(
        commands: vk::CommandBuffer, first_binding: u32, buffers: &[vk::Buffer], offsets: &[vk::DeviceSize],
        sizes: Option<&[vk::DeviceSize]>, strides: Option<&[vk::DeviceSize]>,
    );
    fn cmd_copy_buffer(
        commands: vk::CommandBuffer, source: vk::Buffer, target: vk::Buffer, regions: &[vk::BufferCopy],
    );
    fn cmd_copy_buffer_to_image(
        commands: vk::CommandBuffer, source: vk::Buffer, target: vk::Image, layout: vk::ImageLayout,
        regions: &[vk::BufferImageCopy],
    );
    fn cmd_copy_image_to_buffer(
        commands: vk::CommandBuffer, source: vk::Image, layout: vk::ImageLayout, target: vk::Buffer,
        regions: &[vk::BufferImageCopy],
    );
    fn cmd_dispatch(commands: vk::CommandBuffer, x: u32, y: u32, z: u32);
    fn cmd_draw(commands: vk::CommandBuffer, vertices: u32, instances: u32, first_vertex: u32, first_instance: u32);
    fn cmd_draw_indexed(
        commands: vk::CommandBuffer, indices: u32, instances: u32, first_index: u32, vertex_offset: i32,
        first_instance: u32,
    );
    fn cmd_end_query(commands: vk::CommandBuffer, pool: vk::QueryPool, query: u32);
    fn cmd_end_rendering(commands: vk::CommandBuffer);
    fn cmd_fill_buffer(
        commands: vk::CommandBuffer, buffer: vk::Buffer, offset: vk::DeviceSize, size: vk::DeviceSize, value: u32,
    );
    fn cmd_pipeline_barrier2(commands: vk::CommandBuffer, info: &vk::DependencyInfo<'_>);
    fn cmd_push_constants(
        commands: vk::CommandBuffer, layout: vk::PipelineLayout, stages: vk::ShaderStageFlags, offset: u32,
        constants: &[u8],
    );
    fn cmd_set_cull_mode(commands: vk::CommandBuffer, mode: vk::CullModeFlags);
    fn cmd_set_front_face(commands: vk::CommandBuffer, front: vk::FrontFace);
    fn cmd_set_scissor(commands: vk::CommandBuffer, first: u32, scissors: &[vk::Rect2D]);
    fn cmd_set_viewport(commands: vk::CommandBuffer, first: u32, viewports: &[vk::Viewport]);
    fn cmd_write_timestamp2(
        commands: vk::CommandBuffer, stage: vk::PipelineStageFlags2, pool: vk::QueryPool, query: u32,
    );
    fn create_buffer(info: &vk::BufferCreateInfo<'_>, callbacks: Callbacks<'_>) -> VkResult<vk::Buffer>;
    fn create_command_pool(info: &vk::CommandPoolCreateInfo<'_>, callbacks: Callbacks<'_>) -> VkResult<vk::CommandPool>;
    fn create_compute_pipelines(
        cache: vk::PipelineCache, infos: &[vk::ComputePipelineCreateInfo<'_>], callbacks: Callbacks<'_>,
    ) -> Pipelines;
    fn create_descriptor_pool(
        info: &vk::DescriptorPoolCreateInfo<'_>, callbacks: Callbacks<'_>,
    ) -> VkResult<vk::DescriptorPool>;
    fn create_descriptor_set_layout(
        info: &vk::DescriptorSetLayoutCreateInfo<'_>, callbacks: Callbacks<'_>,
    ) -> VkResult<vk::DescriptorSetLayout>;
    fn create_graphics_pipelines(
        cache: vk::PipelineCache, infos: &[vk::GraphicsPipelineCreateInfo<'_>], callbacks: Callbacks<'_>,
    ) -> Pipelines;
    fn create_image(info: &vk::ImageCreateInfo<'_>, callbacks: Callbacks<'_>) -> VkResult<vk::Image>;
    fn create_image_view(info: &vk::ImageViewCreateInfo<'_>, callbacks: Callbacks<'_>) -> VkResult<vk::ImageView>;
    fn create_pipeline_cache(
        info: &vk::PipelineCacheCreateInfo<'_>, callbacks: Callbacks<'_>,
    ) -> VkResult<vk::PipelineCache>;
    fn create_pipeline_layout(
        info: &vk::PipelineLayoutCreateInfo<'_>, callbacks: Callbacks<'_>,
    ) -> VkResult<vk::PipelineLayout>;
    fn create_query_pool(info: &vk::QueryPoolCreateInfo<'_>, callbacks: Callbacks<'_>) -> VkResult<vk::QueryPool>;
    fn create_sampler(info: &vk::SamplerCreateInfo<'_>, callbacks: Callbacks<'_>) -> VkResult<vk::Sampler>;
    fn create_semaphore(info: &vk::SemaphoreCreateInfo<'_>, callbacks: Callbacks<'_>) -> VkResult<vk::Semaphore>;
    fn create_shader_module(
        info: &vk::ShaderModuleCreateInfo<'_>, callbacks: Callbacks<'_>,
    ) -> VkResult<vk::ShaderModule>;
    fn destroy_buffer(buffer: vk::Buffer, callbacks: Callbacks<'_>);
    fn destroy_command_pool(pool: vk::CommandPool, callbacks: Callbacks<'_>);
    fn destroy_descriptor_pool(pool: vk::DescriptorPool, callbacks: Callbacks<'_>);
    fn destroy_descriptor_set_layout(layout: vk::DescriptorSetLayout, callbacks: Callbacks<'_>);
    fn destroy_image(image: vk::Image, callbacks: Callbacks<'_>);
    fn destroy_image_view(view: vk::ImageView, callbacks: Callbacks<'_>);
    fn destroy_pipeline(pipeline: vk::Pipeline, callbacks: Callbacks<'_>);
    fn destroy_pipeline_cache(cache: vk::PipelineCache, callbacks: Callbacks<'_>);
    fn destroy_pipeline_layout(layout: vk::PipelineLayout, callbacks: Callbacks<'_>);
    fn destroy_query_pool(pool: vk::QueryPool, callbacks: Callbacks<'_>);
    fn destroy_sampler(sampler: vk::Sampler, callbacks: Callbacks<'_>);
    fn destroy_semaphore(semaphore: vk::Semaphore, callbacks: Callbacks<'_>);
    fn destroy_shader_module(module: vk::ShaderModule, callbacks: Callbacks<'_>);
    fn end_command_buffer(commands: vk::CommandBuffer) -> VkResult<()>;
    fn get_buffer_memory_requirements(buffer: vk::Buffer) -> vk::MemoryRequirements;
    fn get_device_queue(family: u32, index: u32) -> vk::Queue;
    fn get_image_memory_requirements(image: vk::Image) -> vk::MemoryRequirements;
    fn get_pipeline_cache_data(cache: vk::PipelineCache) -> VkResult<Vec<u8>>;
    fn get_query_pool_results<T>(
        pool: vk::QueryPool, first: u32, results: &mut [T], flags: vk::QueryResultFlags,
    ) -> VkResult<()>;
    fn get_semaphore_counter_value(semaphore: vk::Semaphore) -> VkResult<u64>;
    fn queue_submit2(queue: vk::Queue, submits: &[vk::SubmitInfo2<'_>], fence: vk::Fence) -> VkResult<()>;
    fn reset_command_pool(pool: vk::CommandPool, flags: vk::CommandPoolResetFlags) -> VkResult<()>;
    fn reset_query_pool(pool: vk::QueryPool, first: u32, count: u32);
    fn update_descriptor_sets(writes: &[vk::WriteDescriptorSet<'_>], copies: &[vk::CopyDescriptorSet<'_>]);
    fn wait_semaphores(info: &vk::SemaphoreWaitInfo<'_>, timeout_ns: u64) -> VkResult<()>;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_go_by_their_vulkan_names() {
        assert_eq!(vulkan_name("cmd_draw_indexed"), "vkCmdDrawIndexed");
        assert_eq!(vulkan_name("cmd_pipeline_barrier2"), "vkCmdPipelineBarrier2");
    }

    #[test]
    fn what_was_added_since_leaves_out_what_was_not() {
        let counts = |draws, dispatches, uploaded_bytes| CallCounts {
            by_name: [("vkCmdDraw".to_owned(), draws), ("vkCmdDispatch".to_owned(), dispatches)].into(),
            uploaded_bytes,
        };
        let added = counts(5, 2, 30).since(&counts(3, 2, 10));
        assert_eq!((added.of("vkCmdDraw"), added.of("vkCmdDispatch"), added.uploaded_bytes), (2, 0, 20));
        assert_eq!((added.by_name.len(), added.total()), (1, 2));
    }
}
