//! A host program with its own instance, device, queue, command buffer and image lets vair draw one frame into them:
//! `cargo run --example embed [PICTURE.png]`. Everything that is not `vair::` is what an engine has already.
#![allow(unsafe_code)]

use vair::gpu::{Features, HostDevice, Image, ImageUse, ash, vk};
use vair::render::Picture;
use vair::scene::CameraChoice;
use vair::{FrameOptions, Gpu, Renderer, Scene};

const SIZE: [u32; 2] = [640, 360];
const FORMAT: vk::Format = vk::Format::R8G8B8A8_UNORM;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = std::env::args().nth(1).unwrap_or_else(|| "vair.png".to_owned());
    let host = Engine::new()?;
    let target = EngineImage::new(&host)?;

    // SAFETY: the handles belong together and are destroyed after `gpu` and everything made from it.
    let gpu = unsafe { Gpu::from_host(host.lend()) }?;
    let mut renderer = Renderer::with_gpu(gpu.clone())?;
    let scene = Scene::gallery();
    let camera = CameraChoice::Named(vair::asset::procedural::GALLERY_CAMERA.to_owned());
    let options = FrameOptions { size: SIZE, camera, ..FrameOptions::default() };

    // SAFETY: image and view are alive, of this format and size, and have no contents yet.
    let image = unsafe {
        Image::from_host(&gpu, "engine's image", target.image, target.view, FORMAT, SIZE, vk::ImageLayout::UNDEFINED)
    };
    host.run(|command_buffer| {
        // SAFETY: the command buffer is recording, outside of a pass, and submitted once right after.
        let mut encoder = unsafe { gpu.encoder_on_host("vair", command_buffer) };
        renderer.record(&mut encoder, &scene, &options, &image)?;
        encoder.transition(&image, ImageUse::Host(vk::ImageLayout::GENERAL));
        encoder.finish_on_host()?;
        Ok(())
    })?;
    // SAFETY: `run` has waited for the queue.
    unsafe { gpu.host_idle() };

    Picture::new(SIZE, gpu.read_image(&image)?).save(&out)?;
    println!("{out}, drawn on {} by the host's command buffer", gpu.info().name);

    drop((image, renderer, gpu));
    target.end(&host);
    host.end();
    Ok(())
}

/// The engine's own Vulkan objects.
struct Engine {
    entry: ash::Entry,
    instance: ash::Instance,
    physical_device: vk::PhysicalDevice,
    features: Features,
    device: ash::Device,
    queue: vk::Queue,
    queue_family: u32,
}

impl Engine {
    fn new() -> Result<Self, Box<dyn std::error::Error>> {
        // SAFETY: the system's Vulkan loader is trusted.
        let entry = unsafe { ash::Entry::load() }?;
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_3);
        let info = vk::InstanceCreateInfo::default().application_info(&application);
        // SAFETY: no layer or extension is asked for.
        let instance = unsafe { entry.create_instance(&info, None) }?;
        // SAFETY: the instance is alive.
        let physical_devices = unsafe { instance.enumerate_physical_devices() }?;
        let is_recent = |device: &vk::PhysicalDevice| {
            // SAFETY: listed by the instance.
            let properties = unsafe { instance.get_physical_device_properties(*device) };
            properties.api_version >= vk::API_VERSION_1_3
        };
        let physical_device = physical_devices.into_iter().find(is_recent).ok_or("no Vulkan 1.3 device")?;
        // SAFETY: listed by the instance, and of Vulkan 1.3.
        let mut features = unsafe { Features::supported(&instance, physical_device) }.wanted();
        // SAFETY: listed by the instance.
        let families = unsafe { instance.get_physical_device_queue_family_properties(physical_device) };
        let needed = vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE;
        let queue_family = families.iter().position(|family| family.queue_flags.contains(needed)).ok_or("no queue")?;
        let queue_family = u32::try_from(queue_family)?;
        let queues = [vk::DeviceQueueCreateInfo::default().queue_family_index(queue_family).queue_priorities(&[1.0])];
        let enabled = features;
        let mut chain = features.chain();
        let info = vk::DeviceCreateInfo::default().queue_create_infos(&queues).push_next(&mut chain);
        // SAFETY: only supported features are enabled.
        let device = unsafe { instance.create_device(physical_device, &info, None) }?;
        // SAFETY: the device has one queue of this family.
        let queue = unsafe { device.get_device_queue(queue_family, 0) };
        Ok(Self { entry, instance, physical_device, features: enabled, device, queue, queue_family })
    }

    fn lend(&self) -> HostDevice {
        HostDevice {
            entry: self.entry.clone(),
            instance: self.instance.clone(),
            physical_device: self.physical_device,
            device: self.device.clone(),
            queue: self.queue,
            queue_family: self.queue_family,
            features: self.features,
            has_debug_utils: false,
            pipeline_cache_dir: None,
        }
    }

    /// Records with `record`, submits, and waits.
    fn run(
        &self,
        record: impl FnOnce(vk::CommandBuffer) -> Result<(), vair::Error>,
    ) -> Result<(), Box<dyn std::error::Error>> {
        let device = &self.device;
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(self.queue_family);
        // SAFETY: the family is the device's.
        let pool = unsafe { device.create_command_pool(&info, None) }?;
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
        // SAFETY: the pool was just created.
        let buffers = unsafe { device.allocate_command_buffers(&info) }?;
        // SAFETY: the command buffer is new.
        unsafe { device.begin_command_buffer(buffers[0], &vk::CommandBufferBeginInfo::default()) }?;
        record(buffers[0])?;
        // SAFETY: it is recording.
        unsafe { device.end_command_buffer(buffers[0]) }?;
        let submit = vk::SubmitInfo::default().command_buffers(&buffers);
        // SAFETY: nobody else uses the queue.
        unsafe { device.queue_submit(self.queue, &[submit], vk::Fence::null()) }?;
        // SAFETY: as above.
        unsafe { device.queue_wait_idle(self.queue) }?;
        // SAFETY: the work has finished.
        unsafe { device.destroy_command_pool(pool, None) };
        Ok(())
    }

    fn end(self) {
        // SAFETY: the device is idle and everything made from it is gone.
        unsafe { self.device.destroy_device(None) };
        // SAFETY: the device is gone.
        unsafe { self.instance.destroy_instance(None) };
    }
}

/// The engine's render target.
struct EngineImage {
    image: vk::Image,
    memory: vk::DeviceMemory,
    view: vk::ImageView,
}

impl EngineImage {
    fn new(engine: &Engine) -> Result<Self, vk::Result> {
        let device = &engine.device;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(FORMAT)
            .extent(vk::Extent3D { width: SIZE[0], height: SIZE[1], depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::TYPE_1)
            .usage(vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC);
        // SAFETY: every device supports such an image.
        let image = unsafe { device.create_image(&info, None) }?;
        // SAFETY: the image was just created.
        let requirements = unsafe { device.get_image_memory_requirements(image) };
        let info = vk::MemoryAllocateInfo::default()
            .allocation_size(requirements.size)
            .memory_type_index(requirements.memory_type_bits.trailing_zeros());
        // SAFETY: the type is one that the image allows.
        let memory = unsafe { device.allocate_memory(&info, None) }?;
        // SAFETY: size and type are what the image requires.
        unsafe { device.bind_image_memory(image, memory, 0) }?;
        let range =
            vk::ImageSubresourceRange::default().aspect_mask(vk::ImageAspectFlags::COLOR).level_count(1).layer_count(1);
        let info = vk::ImageViewCreateInfo::default()
            .image(image)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(FORMAT)
            .subresource_range(range);
        // SAFETY: the image has memory.
        let view = unsafe { device.create_image_view(&info, None) }?;
        Ok(Self { image, memory, view })
    }

    fn end(self, engine: &Engine) {
        // SAFETY: the queue is idle and vair no longer uses the view.
        unsafe { engine.device.destroy_image_view(self.view, None) };
        // SAFETY: as above.
        unsafe { engine.device.destroy_image(self.image, None) };
        // SAFETY: the image is gone.
        unsafe { engine.device.free_memory(self.memory, None) };
    }
}
