//! What an engine has before it meets vair: instance, device, queue, images, command buffers. Nothing in it knows of fur.

use vair::gpu::{Features, HostDevice, HostImage, ash, vk};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// The engine's instance, device and queue.
pub struct Engine {
    pub entry: ash::Entry,
    pub instance: ash::Instance,
    pub physical_device: vk::PhysicalDevice,
    pub features: Features,
    pub device: ash::Device,
    pub queue: vk::Queue,
    pub queue_family: u32,
}

impl Engine {
    /// Opens the first device that has what vair needs.
    pub fn new(layers: &[&std::ffi::CStr], extensions: &[&std::ffi::CStr]) -> Result<Self> {
        // SAFETY: the system's Vulkan loader is trusted.
        let entry = unsafe { ash::Entry::load() }?;
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_3);
        let layers: Vec<_> = layers.iter().map(|name| name.as_ptr()).collect();
        let extensions: Vec<_> = extensions.iter().map(|name| name.as_ptr()).collect();
        let info = vk::InstanceCreateInfo::default()
            .application_info(&application)
            .enabled_layer_names(&layers)
            .enabled_extension_names(&extensions);
        // SAFETY: an absent layer or extension is an error, not undefined.
        let instance = unsafe { entry.create_instance(&info, None) }?;
        // SAFETY: the instance is alive.
        let physical_devices = unsafe { instance.enumerate_physical_devices() }?;
        let supported = |device: vk::PhysicalDevice| {
            // SAFETY: listed by the instance.
            let properties = unsafe { instance.get_physical_device_properties(device) };
            // SAFETY: as above, and of Vulkan 1.3.
            (properties.api_version >= vk::API_VERSION_1_3).then(|| unsafe { Features::supported(&instance, device) })
        };
        let mut usable = physical_devices.into_iter().filter_map(|device| Some((device, supported(device)?)));
        let found = usable.find(|(_, features)| features.missing().is_empty());
        let (physical_device, supported) = found.ok_or("no device has what vair needs")?;
        // SAFETY: listed by the instance.
        let families = unsafe { instance.get_physical_device_queue_family_properties(physical_device) };
        let needed = vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE;
        let queue_family = families.iter().position(|family| family.queue_flags.contains(needed)).ok_or("no queue")?;
        let queue_family = u32::try_from(queue_family)?;
        let queues = [vk::DeviceQueueCreateInfo::default().queue_family_index(queue_family).queue_priorities(&[1.0])];
        // An engine enables its own features, too.
        let features = supported.wanted();
        let mut enabled = features;
        let mut chain = enabled.chain();
        let info = vk::DeviceCreateInfo::default().queue_create_infos(&queues).push_next(&mut chain);
        // SAFETY: only supported features are enabled.
        let device = unsafe { instance.create_device(physical_device, &info, None) }?;
        // SAFETY: the device has one queue of this family.
        let queue = unsafe { device.get_device_queue(queue_family, 0) };
        Ok(Self { entry, instance, physical_device, features, device, queue, queue_family })
    }

    /// The handles, lent to vair.
    pub fn lend(&self, has_debug_utils: bool) -> HostDevice {
        HostDevice {
            entry: self.entry.clone(),
            instance: self.instance.clone(),
            physical_device: self.physical_device,
            device: self.device.clone(),
            queue: self.queue,
            queue_family: self.queue_family,
            features: self.features,
            has_debug_utils,
            pipeline_cache_dir: None,
        }
    }

    /// A render target.
    pub fn target(
        &self,
        format: vk::Format,
        size: [u32; 2],
        samples: u32,
        usage: vk::ImageUsageFlags,
    ) -> Result<RenderTarget> {
        let device = &self.device;
        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(format)
            .extent(vk::Extent3D { width: size[0], height: size[1], depth: 1 })
            .mip_levels(1)
            .array_layers(1)
            .samples(vk::SampleCountFlags::from_raw(samples))
            .usage(usage);
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
        let is_depth = usage.contains(vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT);
        let aspect = if is_depth { vk::ImageAspectFlags::DEPTH } else { vk::ImageAspectFlags::COLOR };
        let range = vk::ImageSubresourceRange::default().aspect_mask(aspect).level_count(1).layer_count(1);
        let info = vk::ImageViewCreateInfo::default()
            .image(image)
            .view_type(vk::ImageViewType::TYPE_2D)
            .format(format)
            .subresource_range(range);
        // SAFETY: the image has memory.
        let view = unsafe { device.create_image_view(&info, None) }?;
        Ok(RenderTarget { image, memory, view, format, size, samples, range })
    }

    /// A command buffer of its own pool, and a fence that says when it may be used again.
    pub fn commands(&self) -> Result<Commands> {
        let info = vk::CommandPoolCreateInfo::default().queue_family_index(self.queue_family);
        // SAFETY: the family is the device's.
        let pool = unsafe { self.device.create_command_pool(&info, None) }?;
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
        // SAFETY: the pool was just created.
        let buffer = unsafe { self.device.allocate_command_buffers(&info) }?[0];
        let info = vk::FenceCreateInfo::default().flags(vk::FenceCreateFlags::SIGNALED);
        // SAFETY: the device is alive.
        let fence = unsafe { self.device.create_fence(&info, None) }?;
        Ok(Commands { pool, buffer, fence })
    }

    /// Waits until the device is done with what the command buffer held.
    pub fn wait(&self, commands: &Commands) -> Result<()> {
        // SAFETY: the fence is alive.
        Ok(unsafe { self.device.wait_for_fences(&[commands.fence], true, u64::MAX) }?)
    }

    /// Starts recording anew; the device is done with what it held.
    pub fn begin(&self, commands: &Commands) -> Result<vk::CommandBuffer> {
        let info = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
        // SAFETY: the device is done with the pool's one command buffer.
        unsafe { self.device.reset_command_pool(commands.pool, vk::CommandPoolResetFlags::empty()) }?;
        // SAFETY: the command buffer was just reset.
        unsafe { self.device.begin_command_buffer(commands.buffer, &info) }?;
        Ok(commands.buffer)
    }

    /// Ends recording and submits.
    pub fn submit(&self, commands: &Commands) -> Result<()> {
        let buffers = [commands.buffer];
        let submit = vk::SubmitInfo::default().command_buffers(&buffers);
        // SAFETY: it is recording.
        unsafe { self.device.end_command_buffer(commands.buffer) }?;
        // SAFETY: it was waited for.
        unsafe { self.device.reset_fences(&[commands.fence]) }?;
        // SAFETY: nobody else uses the queue.
        Ok(unsafe { self.device.queue_submit(self.queue, &[submit], commands.fence) }?)
    }

    /// All that was done to an image is done before it goes on in another layout.
    pub fn barrier(
        &self,
        commands: vk::CommandBuffer,
        target: &RenderTarget,
        from: vk::ImageLayout,
        to: vk::ImageLayout,
    ) {
        let barriers = [vk::ImageMemoryBarrier2::default()
            .src_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .src_access_mask(vk::AccessFlags2::MEMORY_WRITE)
            .dst_stage_mask(vk::PipelineStageFlags2::ALL_COMMANDS)
            .dst_access_mask(vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE)
            .old_layout(from)
            .new_layout(to)
            .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .image(target.image)
            .subresource_range(target.range)];
        let info = vk::DependencyInfo::default().image_memory_barriers(&barriers);
        // SAFETY: the command buffer is recording outside of a pass.
        unsafe { self.device.cmd_pipeline_barrier2(commands, &info) };
    }

    /// Begins a dynamic rendering pass.
    pub fn begin_rendering(&self, commands: vk::CommandBuffer, pass: &Pass<'_>) {
        let op = |clears: bool| if clears { vk::AttachmentLoadOp::CLEAR } else { vk::AttachmentLoadOp::LOAD };
        let [width, height] = pass.color.or(pass.depth).map_or([0; 2], |target| target.size);
        let color = |color: &RenderTarget| {
            let clear = vk::ClearColorValue { float32: pass.clear_color };
            let info = vk::RenderingAttachmentInfo::default()
                .image_view(color.view)
                .image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)
                .load_op(vk::AttachmentLoadOp::CLEAR)
                .store_op(vk::AttachmentStoreOp::STORE)
                .clear_value(vk::ClearValue { color: clear });
            match pass.resolve {
                Some(resolve) => info
                    .resolve_mode(vk::ResolveModeFlags::AVERAGE)
                    .resolve_image_view(resolve.view)
                    .resolve_image_layout(vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL),
                None => info,
            }
        };
        let colors: Vec<_> = pass.color.into_iter().map(color).collect();
        let depth = |depth: &RenderTarget| {
            let clear = vk::ClearDepthStencilValue { depth: pass.clear_depth.unwrap_or_default(), stencil: 0 };
            vk::RenderingAttachmentInfo::default()
                .image_view(depth.view)
                .image_layout(vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL)
                .load_op(op(pass.clear_depth.is_some()))
                .store_op(vk::AttachmentStoreOp::STORE)
                .clear_value(vk::ClearValue { depth_stencil: clear })
        };
        let depth = pass.depth.map(depth).unwrap_or_default();
        let info = vk::RenderingInfo::default()
            .render_area(vk::Rect2D::default().extent(vk::Extent2D { width, height }))
            .layer_count(1)
            .color_attachments(&colors)
            .depth_attachment(&depth);
        // SAFETY: the targets are alive and in the layouts named.
        unsafe { self.device.cmd_begin_rendering(commands, &info) };
    }

    /// Ends the pass.
    pub fn end_rendering(&self, commands: vk::CommandBuffer) {
        // SAFETY: a pass was begun.
        unsafe { self.device.cmd_end_rendering(commands) };
    }

    /// Fills a rectangle of the pass with a colour, at one depth: what this engine draws.
    pub fn fill(&self, commands: vk::CommandBuffer, place: vk::Rect2D, color: [f32; 4], depth: f32) {
        let color = vk::ClearAttachment::default()
            .aspect_mask(vk::ImageAspectFlags::COLOR)
            .clear_value(vk::ClearValue { color: vk::ClearColorValue { float32: color } });
        let depth_stencil = vk::ClearDepthStencilValue { depth, stencil: 0 };
        let depth = vk::ClearAttachment::default()
            .aspect_mask(vk::ImageAspectFlags::DEPTH)
            .clear_value(vk::ClearValue { depth_stencil });
        let place = vk::ClearRect::default().rect(place).layer_count(1);
        // SAFETY: inside a pass with a colour and a depth target that hold the rectangle.
        unsafe { self.device.cmd_clear_attachments(commands, &[color, depth], &[place]) };
    }

    /// Destroys a target that the device is done with.
    pub fn destroy_target(&self, target: &RenderTarget) {
        // SAFETY: the device is done with it and nobody else uses the view.
        unsafe { self.device.destroy_image_view(target.view, None) };
        // SAFETY: as above.
        unsafe { self.device.destroy_image(target.image, None) };
        // SAFETY: the image is gone.
        unsafe { self.device.free_memory(target.memory, None) };
    }

    /// Destroys a command buffer that the device is done with.
    pub fn destroy_commands(&self, commands: &Commands) {
        // SAFETY: the device is done with it.
        unsafe { self.device.destroy_fence(commands.fence, None) };
        // SAFETY: as above.
        unsafe { self.device.destroy_command_pool(commands.pool, None) };
    }

    /// Destroys device and instance: everything made from them is gone.
    pub fn destroy(&self) {
        // SAFETY: the device is idle and everything made from it is gone.
        unsafe { self.device.destroy_device(None) };
        // SAFETY: the device is gone.
        unsafe { self.instance.destroy_instance(None) };
    }
}

/// An image to draw into, with its memory and view.
pub struct RenderTarget {
    pub image: vk::Image,
    memory: vk::DeviceMemory,
    pub view: vk::ImageView,
    pub format: vk::Format,
    pub size: [u32; 2],
    pub samples: u32,
    range: vk::ImageSubresourceRange,
}

impl RenderTarget {
    /// As vair is told of it, in the layout that it is in.
    pub fn described<'a>(&self, name: &'a str, layout: vk::ImageLayout) -> HostImage<'a> {
        let &Self { image, view, format, size, samples, .. } = self;
        HostImage { name, image, view, format, size, samples, mip_levels: 1, is_cube: false, layout }
    }
}

/// A command buffer and its fence.
pub struct Commands {
    pool: vk::CommandPool,
    pub buffer: vk::CommandBuffer,
    pub fence: vk::Fence,
}

/// Targets of a pass and what they hold at its start.
pub struct Pass<'a> {
    pub color: Option<&'a RenderTarget>,
    /// Takes the average of the samples.
    pub resolve: Option<&'a RenderTarget>,
    pub depth: Option<&'a RenderTarget>,
    pub clear_color: [f32; 4],
    /// `None` keeps the depth that there is.
    pub clear_depth: Option<f32>,
}
