//! A wgpu device that vair can draw on.
//!
//! `wgpu::Adapter::request_device` leaves off what `vair::gpu::Features` marks as [`WgpuEnables::Never`]. Nor can a
//! callback of wgpu-hal add all of it: the callback may push structures, but the core features (`full_draw_index_uint32`)
//! are closed to it. So the device is created here, from the list that wgpu-hal asks for and vair's own additions, and
//! given to wgpu.
//!
//! [`WgpuEnables::Never`]: vair::gpu::WgpuEnables::Never

use crate::Problem;
use vair::gpu::{Features, HostDevice, ash, vk};
use wgpu::hal::api::Vulkan;

/// wgpu's device and queue, and what its Vulkan device was created with.
pub struct Device {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
    features: Features,
}

impl Device {
    /// Opens the adapter that wgpu would take.
    pub fn open(instance: &wgpu::Instance) -> Result<Self, Problem> {
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
        let desc = wgpu::DeviceDescriptor {
            label: Some("engine"),
            // An engine asks for what it needs itself; vair needs nothing that has a name in wgpu.
            required_features: wgpu::Features::empty(),
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (opened, features) = create(&adapter, &desc)?;
        // SAFETY: it was created from this adapter with the features and limits of `desc`.
        let (device, queue) = unsafe { adapter.create_device_from_hal(opened, &desc) }?;
        Ok(Self { device, queue, features })
    }

    /// What vair borrows. The handles are wgpu's and live as long as it does.
    pub fn lend(&self) -> Result<HostDevice, Problem> {
        // SAFETY: no handle is destroyed.
        let hal = unsafe { self.device.as_hal::<Vulkan>() }.ok_or("the device is not of wgpu's Vulkan backend")?;
        let instance = hal.shared_instance();
        Ok(HostDevice {
            // wgpu-hal 30 and vair have the same ash, so its types are passed on as they are.
            entry: instance.entry().clone(),
            instance: instance.raw_instance().clone(),
            physical_device: hal.raw_physical_device(),
            device: hal.raw_device().clone(),
            queue: hal.raw_queue(),
            queue_family: hal.queue_family_index(),
            features: self.features,
            has_debug_utils: instance.extensions().contains(&ash::ext::debug_utils::NAME),
            pipeline_cache_dir: None,
        })
    }
}

/// Creates the Vulkan device with all that wgpu wants for `desc` and all that vair requires.
fn create(
    adapter: &wgpu::Adapter,
    desc: &wgpu::DeviceDescriptor<'_>,
) -> Result<(wgpu::hal::OpenDevice<Vulkan>, Features), Problem> {
    // SAFETY: no handle is destroyed.
    let hal = unsafe { adapter.as_hal::<Vulkan>() }.ok_or("the adapter is not of wgpu's Vulkan backend")?;
    let instance = hal.shared_instance().raw_instance();
    let physical_device = hal.raw_physical_device();
    let name = adapter.get_info().name;
    if hal.physical_device_capabilities().properties().api_version < vk::API_VERSION_1_3 {
        return Err(format!("{name} has no Vulkan 1.3; choose another adapter").into());
    }
    // SAFETY: the adapter's own handles, of Vulkan 1.3; wgpu-hal creates its instance for that version.
    let missing = unsafe { Features::supported(instance, physical_device) }.missing();
    if !missing.is_empty() {
        return Err(format!("{name} lacks {}; choose another adapter", missing.join(", ")).into());
    }

    let extensions = hal.required_device_extensions(desc.required_features);
    let mut wgpu_features = hal.physical_device_features(&extensions, desc.required_features);
    let core = wgpu_features.get_core().full_draw_index_uint32(true);
    let mut host_query_reset = vk::PhysicalDeviceHostQueryResetFeatures::default().host_query_reset(true);
    let mut dynamic_rendering = vk::PhysicalDeviceDynamicRenderingFeatures::default().dynamic_rendering(true);
    let mut synchronization2 = vk::PhysicalDeviceSynchronization2Features::default().synchronization2(true);
    // wgpu-hal takes queues of the first family and no other.
    let queues = [vk::DeviceQueueCreateInfo::default().queue_family_index(0).queue_priorities(&[1.0])];
    let names: Vec<_> = extensions.iter().map(|extension| extension.as_ptr()).collect();
    let info = vk::DeviceCreateInfo::default()
        .queue_create_infos(&queues)
        .enabled_extension_names(&names)
        .push_next(&mut host_query_reset)
        .push_next(&mut dynamic_rendering)
        .push_next(&mut synchronization2);
    // wgpu's core features are put in first, then ours, which contain them.
    let info = wgpu_features.add_to_device_create(info).enabled_features(&core);
    // SAFETY: wgpu-hal lists what the device supports, and vair's features were found supported above.
    let device = unsafe { instance.create_device(physical_device, &info, None) }?;

    // The same in words: `Gpu::from_host` refuses a device whose list lacks what it requires.
    let has_timeline = hal.physical_device_capabilities().supports_extension(ash::khr::timeline_semaphore::NAME);
    let v12 = vk::PhysicalDeviceVulkan12Features::default().timeline_semaphore(has_timeline).host_query_reset(true);
    let v13 = vk::PhysicalDeviceVulkan13Features::default().dynamic_rendering(true).synchronization2(true);
    let features = Features::new(core, v12, v13);

    // SAFETY: created just now, from this adapter, with one queue of family 0 and all that the adapter listed.
    let opened = unsafe {
        hal.device_from_raw(
            device,
            None,
            &extensions,
            desc.required_features,
            &desc.required_limits,
            &desc.memory_hints,
            0,
            0,
        )
    }?;
    Ok((opened, features))
}
