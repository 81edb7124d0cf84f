//! Which devices there are, what each lacks, and which one to take.

use super::error::GpuError;
use super::features::Features;
use super::instance::Instance;
use ash::vk;

/// Kind of a device, best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum DeviceKind {
    /// A card with its own memory.
    Discrete,
    /// Shares the host's memory.
    Integrated,
    /// Passed through to a virtual machine.
    Virtual,
    /// Software.
    Cpu,
    /// Anything else.
    Other,
}

impl std::fmt::Display for DeviceKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Discrete => "discrete",
            Self::Integrated => "integrated",
            Self::Virtual => "virtual",
            Self::Cpu => "cpu",
            Self::Other => "other",
        })
    }
}

/// One device of the machine.
#[derive(Debug, Clone)]
pub struct DeviceReport {
    /// The driver's name for it.
    pub name: String,
    /// Driver and its version.
    pub driver: String,
    /// Vulkan version, for example `1.3.230`.
    pub api: String,
    /// Kind.
    pub kind: DeviceKind,
    /// What it lacks, with reasons; empty means usable.
    pub missing: Vec<String>,
}

/// The device in use, its optional abilities and its limits.
#[derive(Debug, Clone)]
pub struct DeviceInfo {
    /// The driver's name for it.
    pub name: String,
    /// Driver and its version.
    pub driver: String,
    /// Vulkan version, for example `1.3.230`.
    pub api: String,
    /// Kind.
    pub kind: DeviceKind,
    /// PCI vendor.
    pub vendor_id: u32,
    /// PCI device.
    pub device_id: u32,
    /// UUID of the device, the same across processes.
    pub device_uuid: [u8; 16],
    /// UUID of the driver build.
    pub driver_uuid: [u8; 16],
    /// UUID in the header of this driver's pipeline caches.
    pub pipeline_cache_uuid: [u8; 16],
    /// Largest side of a 2D image, texels.
    pub max_image_size: u32,
    /// Textures, each with a sampler, that one shader can read.
    pub max_textures_per_stage: u32,
    /// Sample counts that colour and depth targets both support, ascending; always has 1.
    pub samples: Vec<u32>,
    /// Sum of all memory heaps, bytes.
    pub memory_bytes: u64,
    /// Nanoseconds per timestamp tick; 0 where the queue has no timestamps.
    pub timestamp_period_ns: f64,
    /// Valid bits of a timestamp, 0 to 64.
    pub timestamp_bits: u32,
    /// Invocation counts per pass are available.
    pub pipeline_statistics: bool,
    /// Fragment shaders may write storage blocks and use atomics.
    pub fragment_stores: bool,
    /// Largest sampler anisotropy; 1 where it is not supported.
    pub max_anisotropy: f32,
    /// Largest uniform block, bytes.
    pub max_uniform_bytes: u64,
    /// Offsets of uniform blocks are multiples of this, bytes.
    pub uniform_alignment: u64,
    /// Largest storage block, bytes.
    pub max_storage_bytes: u64,
    /// Most workgroups of one dispatch in x, y and z.
    pub max_workgroups: [u32; 3],
}

/// A physical device with all that choosing and using it takes.
pub(crate) struct Candidate {
    pub(crate) physical: vk::PhysicalDevice,
    pub(crate) family: u32,
    pub(crate) features: Features,
    pub(crate) info: DeviceInfo,
    pub(crate) missing: Vec<String>,
}

impl Candidate {
    pub(crate) fn report(&self) -> DeviceReport {
        DeviceReport {
            name: self.info.name.clone(),
            driver: self.info.driver.clone(),
            api: self.info.api.clone(),
            kind: self.info.kind,
            missing: self.missing.clone(),
        }
    }
}

/// All devices of this machine in the loader's order, usable or not.
///
/// # Errors
/// [`GpuError::NoLoader`] without a Vulkan loader; others where the loader itself fails.
pub fn devices() -> Result<Vec<DeviceReport>, GpuError> {
    let instance = Instance::new(false)?;
    Ok(candidates(&instance)?.iter().map(Candidate::report).collect())
}

/// The best usable device whose name contains `asked`, ignoring case.
pub(crate) fn choose(instance: &Instance, asked: Option<&str>) -> Result<Candidate, GpuError> {
    let (usable, refused): (Vec<_>, Vec<_>) = candidates(instance)?.into_iter().partition(|candidate| {
        let is_match = asked.is_none_or(|part| candidate.info.name.to_lowercase().contains(&part.to_lowercase()));
        is_match && candidate.missing.is_empty()
    });
    // `min_by_key` keeps the loader's order among equals.
    usable.into_iter().min_by_key(|candidate| candidate.info.kind).ok_or_else(|| GpuError::NoDevice {
        asked: asked.map(str::to_owned),
        refused: refused.iter().map(Candidate::report).collect(),
    })
}

fn candidates(instance: &Instance) -> Result<Vec<Candidate>, GpuError> {
    // SAFETY: the instance is alive.
    let listed = unsafe { instance.enumerate_physical_devices() };
    let physical_devices = match listed {
        Ok(devices) => devices,
        // The loader answers so when no driver is installed at all.
        Err(vk::Result::ERROR_INITIALIZATION_FAILED) => Vec::new(),
        Err(result) => return Err(GpuError::from_vk("listing", "devices", result)),
    };
    Ok(physical_devices.into_iter().map(|physical| examine(instance, physical, None)).collect())
}

/// Asks a physical device for everything that matters. `given` is the queue family of a host, whose timestamps count;
/// `None` takes the first that will do.
pub(crate) fn examine(instance: &ash::Instance, physical: vk::PhysicalDevice, given: Option<u32>) -> Candidate {
    // SAFETY: `physical` was listed by `instance`.
    let properties = unsafe { instance.get_physical_device_properties(physical) };
    let version = properties.api_version;
    let (major, minor) = (vk::api_version_major(version), vk::api_version_minor(version));
    let api = format!("{major}.{minor}.{}", vk::api_version_patch(version));

    let mut driver = format!("version {}", properties.driver_version);
    let mut ids = vk::PhysicalDeviceIDProperties::default();
    let mut missing = Vec::new();
    let mut features = Features::default();
    if (major, minor) < (1, 3) {
        missing.push(format!("Vulkan 1.3 (has {api})"));
    } else {
        let mut names = vk::PhysicalDeviceDriverProperties::default();
        let mut all = vk::PhysicalDeviceProperties2::default().push_next(&mut names).push_next(&mut ids);
        // SAFETY: both chained structures are core since 1.2, and the device has 1.3.
        unsafe { instance.get_physical_device_properties2(physical, &mut all) };
        driver = [names.driver_name_as_c_str(), names.driver_info_as_c_str()]
            .into_iter()
            .map(|text| text.unwrap_or_default().to_string_lossy().into_owned())
            .filter(|text| !text.is_empty())
            .collect::<Vec<_>>()
            .join(" ");
        // SAFETY: `physical` belongs to `instance` and has Vulkan 1.3.
        features = unsafe { Features::supported(instance, physical) };
        missing.extend(features.missing());
    }

    // SAFETY: `physical` was listed by `instance`.
    let families = unsafe { instance.get_physical_device_queue_family_properties(physical) };
    let needed = vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE;
    let will_do = |index: usize| given.is_none_or(|given| given as usize == index);
    let family = (0..families.len()).find(|&index| will_do(index) && families[index].queue_flags.contains(needed));
    if family.is_none() {
        missing.push("a queue with graphics and compute".to_owned());
    }
    let timestamp_bits = family.map_or(0, |index| families[index].timestamp_valid_bits);
    // SAFETY: `physical` was listed by `instance`.
    let memory = unsafe { instance.get_physical_device_memory_properties(physical) };

    let limits = &properties.limits;
    let sample_mask = limits.framebuffer_color_sample_counts & limits.framebuffer_depth_sample_counts;
    let info = DeviceInfo {
        name: properties.device_name_as_c_str().unwrap_or_default().to_string_lossy().into_owned(),
        driver,
        api,
        kind: match properties.device_type {
            vk::PhysicalDeviceType::DISCRETE_GPU => DeviceKind::Discrete,
            vk::PhysicalDeviceType::INTEGRATED_GPU => DeviceKind::Integrated,
            vk::PhysicalDeviceType::VIRTUAL_GPU => DeviceKind::Virtual,
            vk::PhysicalDeviceType::CPU => DeviceKind::Cpu,
            _ => DeviceKind::Other,
        },
        vendor_id: properties.vendor_id,
        device_id: properties.device_id,
        device_uuid: ids.device_uuid,
        driver_uuid: ids.driver_uuid,
        pipeline_cache_uuid: properties.pipeline_cache_uuid,
        max_image_size: limits.max_image_dimension2_d,
        max_textures_per_stage: (limits.max_per_stage_descriptor_sampled_images)
            .min(limits.max_per_stage_descriptor_samplers),
        samples: (0..7).map(|bit| 1 << bit).filter(|count| sample_mask.as_raw() & count != 0).collect(),
        memory_bytes: memory.memory_heaps_as_slice().iter().map(|heap| heap.size).sum(),
        timestamp_period_ns: if timestamp_bits == 0 { 0.0 } else { f64::from(limits.timestamp_period) },
        timestamp_bits,
        pipeline_statistics: false,
        fragment_stores: false,
        max_anisotropy: limits.max_sampler_anisotropy,
        max_uniform_bytes: u64::from(limits.max_uniform_buffer_range),
        uniform_alignment: limits.min_uniform_buffer_offset_alignment.max(1),
        max_storage_bytes: u64::from(limits.max_storage_buffer_range),
        max_workgroups: limits.max_compute_work_group_count,
    };
    let family = family.unwrap_or(0) as u32;
    let mut candidate = Candidate { physical, family, features, info, missing };
    candidate.info.set_optional(&features.wanted());
    candidate
}

impl DeviceInfo {
    /// Takes over which optional features are enabled.
    pub(crate) fn set_optional(&mut self, enabled: &Features) {
        let core = enabled.core();
        self.pipeline_statistics = core.pipeline_statistics_query == vk::TRUE;
        self.fragment_stores = core.fragment_stores_and_atomics == vk::TRUE;
        self.max_anisotropy = if core.sampler_anisotropy == vk::TRUE { self.max_anisotropy } else { 1.0 };
    }
}
