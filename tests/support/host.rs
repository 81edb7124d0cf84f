//! A host program: its own instance, device, queue, image and command buffers, under the validation layer.

use std::ffi::{CStr, c_void};
use std::sync::{Mutex, PoisonError};
use vair::gpu::ash;
use vair::gpu::vk;
use vair::gpu::*;

/// Format of the host's image.
pub const FORMAT: vk::Format = vk::Format::R8G8B8A8_UNORM;
static MESSAGES: Mutex<Vec<String>> = Mutex::new(Vec::new());

/// What the validation layer has said to any host of this process.
pub fn messages() -> Vec<String> {
    MESSAGES.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

unsafe extern "system" fn on_message(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _types: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    _user_data: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: the layer passes a valid structure for the time of the call.
    let data = unsafe { &*data };
    // SAFETY: the message is a null-terminated string for the time of the call.
    let text = unsafe { data.message_as_c_str() }.map(CStr::to_string_lossy).unwrap_or_default();
    MESSAGES.lock().unwrap().push(text.into_owned());
    vk::FALSE
}

/// What a host program has before it meets this crate.
pub struct Host {
    entry: ash::Entry,
    instance: ash::Instance,
    debug: ash::ext::debug_utils::Instance,
    messenger: vk::DebugUtilsMessengerEXT,
    physical_device: vk::PhysicalDevice,
    device: ash::Device,
    queue: vk::Queue,
    queue_family: u32,
    features: Features,
}

impl Host {
    /// Opens the first device that the crate can use.
    pub fn new() -> Self {
        // SAFETY: the system's Vulkan loader is trusted.
        let entry = unsafe { ash::Entry::load() }.unwrap();
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_3);
        let layers = [c"VK_LAYER_KHRONOS_validation".as_ptr()];
        let extensions = [ash::ext::debug_utils::NAME.as_ptr()];
        let info = vk::InstanceCreateInfo::default()
            .application_info(&application)
            .enabled_layer_names(&layers)
            .enabled_extension_names(&extensions);
        // SAFETY: an absent layer or extension is an error, not undefined.
        let instance = unsafe { entry.create_instance(&info, None) }.unwrap();
        let debug = ash::ext::debug_utils::Instance::new(&entry, &instance);
        let info = vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(
                vk::DebugUtilsMessageSeverityFlagsEXT::ERROR | vk::DebugUtilsMessageSeverityFlagsEXT::WARNING,
            )
            .message_type(vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION)
            .pfn_user_callback(Some(on_message));
        // SAFETY: the extension is enabled.
        let messenger = unsafe { debug.create_debug_utils_messenger(&info, None) }.unwrap();

        let name =
            devices().unwrap().into_iter().find(|device| device.missing.is_empty()).expect("a usable device").name;
        // SAFETY: the instance is alive.
        let all = unsafe { instance.enumerate_physical_devices() }.unwrap();
        let is_it = |device: &vk::PhysicalDevice| {
            // SAFETY: listed by the instance.
            let properties = unsafe { instance.get_physical_device_properties(*device) };
            properties.device_name_as_c_str().unwrap().to_string_lossy() == name
        };
        let physical_device = all.into_iter().find(is_it).unwrap();
        // SAFETY: listed by the instance; usable means Vulkan 1.3.
        let mut features = unsafe { Features::supported(&instance, physical_device) }.wanted();
        // SAFETY: listed by the instance.
        let families = unsafe { instance.get_physical_device_queue_family_properties(physical_device) };
        let needed = vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE;
        let queue_family = families.iter().position(|family| family.queue_flags.contains(needed)).unwrap() as u32;
        let queues = [vk::DeviceQueueCreateInfo::default().queue_family_index(queue_family).queue_priorities(&[1.0])];
        let wanted = features;
        let mut chain = features.chain();
        let info = vk::DeviceCreateInfo::default().queue_create_infos(&queues).push_next(&mut chain);
        // SAFETY: only supported features are enabled.
        let device = unsafe { instance.create_device(physical_device, &info, None) }.unwrap();
        // SAFETY: the device has one queue of this family.
        let queue = unsafe { device.get_device_queue(queue_family, 0) };
        Self { entry, instance, debug, messenger, physical_device, device, queue, queue_family, features: wanted }
    }

    /// The handles, lent to the crate.
    pub fn lend(&self) -> HostDevice {
        HostDevice {
            entry: self.entry.clone(),
            instance: self.instance.clone(),
            physical_device: self.physical_device,
            device: self.device.clone(),
            queue: self.queue,
            queue_family: self.queue_family,
            features: self.features,
            has_debug_utils: true,
            pipeline_cache_dir: None,
        }
    }

    /// An image with its memory and view.
    pub fn image(&self, size: [u32; 2]) -> (vk::Image, vk::DeviceMemory, vk::ImageView) {
        let device = &self.device;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(FORMAT)
            .extent(vk::Extent3D { width: size[0], height: size[1], depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC);
        // SAFETY: every device supports such an image.
        let image = unsafe { device.create_image(&info, None) }.unwrap();
        // SAFETY: the image was just created.
        let requirements = unsafe { device.get_image_memory_requirements(image) };
        let info = vk::MemoryAllocateInfo::default()
            .allocation_size(requirements.size)
            .memory_type_index(requirements.memory_type_bits.trailing_zeros());
        // SAFETY: the type is one that the image allows.
        let memory = unsafe { device.allocate_memory(&info, None) }.unwrap();
        // SAFETY: size and type are what the image requires.
        unsafe { device.bind_image_memory(image, memory, 0) }.unwrap();
        let range =
            vk::ImageSubresourceRange::default().aspect_mask(vk::ImageAspectFlags::COLOR).level_count(1).layer_count(1);
        let info = vk::ImageViewCreateInfo::default()
            .image(image)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(FORMAT)
            .subresource_range(range);
        // SAFETY: the image has memory.
        let view = unsafe { device.create_image_view(&info, None) }.unwrap();
        (image, memory, view)
    }

    /// Records with `record`, submits and waits, all by the host's own means.
    pub fn run(&self, record: impl FnOnce(vk::CommandBuffer)) {
        let device = &self.device;
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(self.queue_family);
        // SAFETY: the family is the device's.
        let pool = unsafe { device.create_command_pool(&info, None) }.unwrap();
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
        // SAFETY: the pool was just created.
        let buffers = unsafe { device.allocate_command_buffers(&info) }.unwrap();
        // SAFETY: the command buffer is new.
        unsafe { device.begin_command_buffer(buffers[0], &vk::CommandBufferBeginInfo::default()) }.unwrap();
        record(buffers[0]);
        // SAFETY: it is recording.
        unsafe { device.end_command_buffer(buffers[0]) }.unwrap();
        let submit = vk::SubmitInfo::default().command_buffers(&buffers);
        // SAFETY: nobody else uses the queue.
        unsafe { device.queue_submit(self.queue, &[submit], vk::Fence::null()) }.unwrap();
        // SAFETY: as above.
        unsafe { device.queue_wait_idle(self.queue) }.unwrap();
        // SAFETY: the work has finished.
        unsafe { device.destroy_command_pool(pool, None) };
    }

    /// Destroys everything; the crate has let go of it.
    pub fn end(self, image: (vk::Image, vk::DeviceMemory, vk::ImageView)) {
        // SAFETY: the device is idle; each handle is the host's and destroyed once, children first.
        unsafe { self.device.destroy_image_view(image.2, None) };
        // SAFETY: as above.
        unsafe { self.device.destroy_image(image.0, None) };
        // SAFETY: as above.
        unsafe { self.device.free_memory(image.1, None) };
        // SAFETY: as above.
        unsafe { self.device.destroy_device(None) };
        // SAFETY: as above.
        unsafe { self.debug.destroy_debug_utils_messenger(self.messenger, None) };
        // SAFETY: as above.
        unsafe { self.instance.destroy_instance(None) };
    }
}
