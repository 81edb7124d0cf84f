//! Two-dimensional images and cubes with their one view.

use super::barrier::ImageUse;
use super::device::{Context, Gpu, lock};
use super::error::GpuError;
use super::format;
use super::host::HostImage;
use super::memory::{Block, Memory, MemoryUse};
use ash::vk;
use std::sync::atomic::AtomicU64;
use std::sync::{Arc, Mutex};

/// What image to create.
#[derive(Debug, Clone, Copy)]
pub struct ImageDesc<'a> {
    /// Name, also the owner in the memory report.
    pub name: &'a str,
    /// Width and height, texels, 1 to the device's limit.
    pub size: [u32; 2],
    /// Format.
    pub format: vk::Format,
    /// Mip levels, 1 to `1 + log2(largest side)`.
    pub mip_levels: u32,
    /// Samples per texel: 1, 2, 4, ...
    pub samples: u32,
    /// Uses. Copies are added for images of 1 sample that are not transient.
    pub usage: vk::ImageUsageFlags,
    /// Six square faces (+X, -X, +Y, -Y, +Z, -Z) that a direction looks up, for sampling alone.
    pub is_cube: bool,
}

/// An image that knows how it was used last.
pub struct Image(pub(crate) Arc<ImageInner>);

pub(crate) struct ImageInner {
    context: Arc<Context>,
    pub(crate) raw: vk::Image,
    /// All levels, for shaders.
    pub(crate) view: vk::ImageView,
    /// Level 0, for targets and storage; the same as `view` with one level.
    pub(crate) level_0_view: vk::ImageView,
    pub(crate) name: String,
    pub(crate) size: [u32; 2],
    pub(crate) format: vk::Format,
    pub(crate) mip_levels: u32,
    pub(crate) samples: u32,
    pub(crate) usage: vk::ImageUsageFlags,
    /// 6 of a cube.
    pub(crate) layers: u32,
    pub(crate) last_use: Mutex<ImageUse>,
    /// Number of the encoder that has recorded this and is neither submitted nor dropped; 0 without one.
    pub(crate) recorder: AtomicU64,
    block: Mutex<Option<Block>>,
    is_owned: bool,
}

impl Gpu {
    /// Creates an image; its contents are undefined until uploaded or drawn.
    ///
    /// # Errors
    /// [`GpuError::Size`] for a side of 0 or beyond the device's limit, [`GpuError::Unsupported`] for a format, level
    /// or sample count that the device lacks, [`GpuError::OutOfMemory`], [`GpuError::Allocation`].
    pub fn image(&self, desc: &ImageDesc<'_>) -> Result<Image, GpuError> {
        let context = self.context().clone();
        let limit = context.info.max_image_size;
        let [width, height] = desc.size;
        if width == 0 || height == 0 || width > limit || height > limit {
            return Err(GpuError::Size { name: desc.name.to_owned(), size: desc.size, limit });
        }
        let mut usage = desc.usage;
        if desc.samples == 1 && !usage.contains(vk::ImageUsageFlags::TRANSIENT_ATTACHMENT) {
            usage |= vk::ImageUsageFlags::TRANSFER_SRC | vk::ImageUsageFlags::TRANSFER_DST;
        }
        check_support(&context, desc, usage)?;
        let layers = if desc.is_cube { 6 } else { 1 };

        let info = vk::ImageCreateInfo::default()
            .image_type(vk::ImageType::TYPE_2D)
            .format(desc.format)
            .extent(vk::Extent3D { width, height, depth: 1 })
            .mip_levels(desc.mip_levels)
            .array_layers(layers)
            .flags(create_flags(desc))
            .samples(vk::SampleCountFlags::from_raw(desc.samples))
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(usage);
        // SAFETY: format, size, levels, samples and usage are supported, as just checked.
        let raw = unsafe { context.device.create_image(&info, None) }
            .map_err(|result| GpuError::from_vk("creating image", desc.name, result))?;
        // From here on the inner value frees the handles on every path.
        let mut inner = ImageInner {
            context: context.clone(),
            raw,
            view: vk::ImageView::null(),
            level_0_view: vk::ImageView::null(),
            name: desc.name.to_owned(),
            size: desc.size,
            format: desc.format,
            mip_levels: desc.mip_levels,
            samples: desc.samples,
            usage,
            layers,
            last_use: Mutex::new(ImageUse::Undefined),
            recorder: AtomicU64::new(0),
            block: Mutex::new(None),
            is_owned: true,
        };
        context.set_name(raw, desc.name);
        // SAFETY: the image was just created.
        let requirements = unsafe { context.device.get_image_memory_requirements(raw) };
        let memory_use = MemoryUse::of_image(usage);
        let block = lock(&context.heap).allocate(desc.name, requirements, Memory::Device, memory_use, false)?;
        // SAFETY: the memory belongs to `allocation` for as long as the block lives.
        let device_memory = unsafe { block.allocation.memory() };
        let offset = block.allocation.offset();
        inner.block = Mutex::new(Some(block));
        // SAFETY: the range satisfies the image's requirements and is bound once.
        unsafe { context.device.bind_image_memory(raw, device_memory, offset) }
            .map_err(|result| GpuError::from_vk("binding memory of", desc.name, result))?;
        let viewed = vk::ImageUsageFlags::SAMPLED
            | vk::ImageUsageFlags::STORAGE
            | vk::ImageUsageFlags::COLOR_ATTACHMENT
            | vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT;
        if usage.intersects(viewed) {
            inner.view = inner.create_view(desc.mip_levels)?;
            inner.level_0_view =
                if desc.mip_levels == 1 || desc.is_cube { inner.view } else { inner.create_view(1)? };
        }
        Ok(Image(Arc::new(inner)))
    }
}

fn create_flags(desc: &ImageDesc<'_>) -> vk::ImageCreateFlags {
    if desc.is_cube { vk::ImageCreateFlags::CUBE_COMPATIBLE } else { vk::ImageCreateFlags::empty() }
}

fn check_support(context: &Context, desc: &ImageDesc<'_>, usage: vk::ImageUsageFlags) -> Result<(), GpuError> {
    let unsupported = |problem| GpuError::Unsupported { name: desc.name.to_owned(), problem };
    // SAFETY: the physical device belongs to the instance; the usage is not empty or the driver says so.
    let found = unsafe {
        context.instance.get_physical_device_image_format_properties(
            context.physical,
            desc.format,
            vk::ImageType::TYPE_2D,
            vk::ImageTiling::OPTIMAL,
            usage,
            create_flags(desc),
        )
    };
    let properties = found.map_err(|result| match result {
        vk::Result::ERROR_FORMAT_NOT_SUPPORTED => unsupported(format!("format {:?} used as {usage:?}", desc.format)),
        result => GpuError::from_vk("asking about the format of", desc.name, result),
    })?;
    let drawn = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT;
    let [width, height] = desc.size;
    if desc.is_cube && (width != height || usage.intersects(drawn | vk::ImageUsageFlags::STORAGE)) {
        return Err(unsupported(format!(
            "a cube of {width}x{height} used as {usage:?}: its faces are square and sampled"
        )));
    }
    let full_chain = desc.size.iter().max().map_or(1, |side| side.ilog2() + 1);
    if desc.mip_levels == 0 || desc.mip_levels > properties.max_mip_levels.min(full_chain) {
        return Err(unsupported(format!("{} mip levels of 1 to {full_chain}", desc.mip_levels)));
    }
    let is_one_count = desc.samples.is_power_of_two() && properties.sample_counts.as_raw() & desc.samples != 0;
    if !is_one_count {
        let counts = properties.sample_counts;
        return Err(unsupported(format!("{} samples per texel of {:?} (has {counts:?})", desc.samples, desc.format)));
    }
    Ok(())
}

impl Gpu {
    /// Whether images of that format can be used like that, tiled as the device likes.
    pub fn can_be_target(&self, format: vk::Format, features: vk::FormatFeatureFlags) -> bool {
        let context = self.context();
        // SAFETY: the physical device belongs to the instance; any format may be asked about.
        let known = unsafe { context.instance.get_physical_device_format_properties(context.physical, format) };
        known.optimal_tiling_features.contains(features)
    }
}

impl Image {
    /// Wraps an image of the host, for example of a swapchain, as a target, source or texture.
    ///
    /// # Safety
    /// Image and view belong to this device, are as described, have the uses that they are put to, and live until the work
    /// recorded with this has finished. The image is in the layout named when the first such work starts.
    pub unsafe fn from_host(gpu: &Gpu, host: &HostImage<'_>) -> Self {
        let last_use = match host.layout {
            vk::ImageLayout::UNDEFINED => ImageUse::Undefined,
            vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL => ImageUse::Sampled,
            layout => ImageUse::Host(layout),
        };
        Self(Arc::new(ImageInner {
            context: gpu.context().clone(),
            raw: host.image,
            view: host.view,
            level_0_view: host.view,
            name: host.name.to_owned(),
            size: host.size,
            format: host.format,
            mip_levels: host.mip_levels,
            samples: host.samples,
            usage: vk::ImageUsageFlags::from_raw(u32::MAX),
            layers: if host.is_cube { 6 } else { 1 },
            last_use: Mutex::new(last_use),
            recorder: AtomicU64::new(0),
            block: Mutex::new(None),
            is_owned: false,
        }))
    }

    /// Width and height, texels.
    pub fn size(&self) -> [u32; 2] {
        self.0.size
    }

    /// Format.
    pub fn format(&self) -> vk::Format {
        self.0.format
    }

    /// It has six faces.
    pub fn is_cube(&self) -> bool {
        self.0.layers == 6
    }

    /// Number of mip levels.
    pub fn mip_levels(&self) -> u32 {
        self.0.mip_levels
    }

    /// Samples per texel.
    pub fn samples(&self) -> u32 {
        self.0.samples
    }

    /// A number that no other live image has.
    pub fn place(&self) -> usize {
        Arc::as_ptr(&self.0).addr()
    }

    /// Name given at creation.
    pub fn name(&self) -> &str {
        &self.0.name
    }
}

impl ImageInner {
    fn create_view(&self, level_count: u32) -> Result<vk::ImageView, GpuError> {
        let range = vk::ImageSubresourceRange::default()
            .aspect_mask(format::view_aspect(self.format))
            .level_count(level_count)
            .layer_count(self.layers);
        let info = vk::ImageViewCreateInfo::default()
            .image(self.raw)
            .view_type(if self.layers == 1 { vk::ImageViewType::TYPE_2D } else { vk::ImageViewType::CUBE })
            .format(self.format)
            .subresource_range(range);
        // SAFETY: the image has memory and at least `level_count` levels.
        let view = unsafe { self.context.device.create_image_view(&info, None) }
            .map_err(|result| GpuError::from_vk("viewing", &self.name, result))?;
        self.context.set_name(view, &self.name);
        Ok(view)
    }

    pub(crate) fn range(&self, problem: String) -> GpuError {
        GpuError::Range { name: self.name.clone(), problem }
    }
}

impl Drop for ImageInner {
    fn drop(&mut self) {
        if !self.is_owned {
            return;
        }
        if self.level_0_view != self.view {
            // SAFETY: the last owner is gone, submissions in flight among them.
            unsafe { self.context.device.destroy_image_view(self.level_0_view, None) };
        }
        // SAFETY: as above; null is allowed.
        unsafe { self.context.device.destroy_image_view(self.view, None) };
        // SAFETY: as above.
        unsafe { self.context.device.destroy_image(self.raw, None) };
        if let Some(block) = lock(&self.block).take() {
            lock(&self.context.heap).free(block);
        }
    }
}
