//! A device that belongs to the host program.

use super::features::Features;
use ash::vk;
use std::path::PathBuf;

/// What a host brings; this crate destroys none of it.
pub struct HostDevice {
    /// The loaded library.
    pub entry: ash::Entry,
    /// Instance, created for Vulkan 1.3 or later.
    pub instance: ash::Instance,
    /// The device's physical device.
    pub physical_device: vk::PhysicalDevice,
    /// Device, created with at least the features that [`Features::missing`] would name.
    pub device: ash::Device,
    /// Queue with graphics and compute.
    pub queue: vk::Queue,
    /// Family of `queue`.
    pub queue_family: u32,
    /// Features that the device was created with; [`Features::wanted`] is the ready-made choice.
    pub features: Features,
    /// `VK_EXT_debug_utils` is enabled on the instance: objects get names and passes get labels.
    pub has_debug_utils: bool,
    /// Folder for the pipeline cache; `None` keeps it in memory.
    pub pipeline_cache_dir: Option<PathBuf>,
}
