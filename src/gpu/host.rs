//! A device that belongs to the host program.

use super::features::Features;
use super::pipeline::TargetFormats;
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

/// A command buffer of the host's to record into, outside of passes.
pub struct HostCommands(pub(crate) vk::CommandBuffer);

impl HostCommands {
    /// Vouches for a command buffer.
    ///
    /// # Safety
    /// It is recording, outside of a render pass, belongs to the device that records into it and to a family with graphics
    /// and compute, and nobody else records into it meanwhile. It is submitted once, to the queue of that device, before
    /// anything recorded later.
    pub unsafe fn recording(command_buffer: vk::CommandBuffer) -> Self {
        Self(command_buffer)
    }
}

/// A dynamic rendering pass that the host has begun, to draw in.
#[derive(Clone, Copy)]
pub struct HostRendering {
    pub(crate) command_buffer: vk::CommandBuffer,
    pub(crate) formats: TargetFormats,
}

impl HostRendering {
    /// Vouches for a pass.
    ///
    /// # Safety
    /// The command buffer is recording inside a dynamic rendering pass whose targets have these formats and samples and hold
    /// all that is drawn to; while this is used it stays so, and nobody else records into it. It is submitted to the queue
    /// of the device, after the command buffer that the frame began with or as that one.
    pub unsafe fn begun(command_buffer: vk::CommandBuffer, formats: TargetFormats) -> Self {
        Self { command_buffer, formats }
    }

    /// Formats and samples of its targets.
    pub fn formats(&self) -> TargetFormats {
        self.formats
    }
}

/// An image of the host's, to draw into or to read; this crate does not destroy it.
#[derive(Debug, Clone, Copy)]
pub struct HostImage<'a> {
    /// Name in messages.
    pub name: &'a str,
    /// The image.
    pub image: vk::Image,
    /// View of all its levels (and faces), which is what shaders read; level 0 is drawn into.
    pub view: vk::ImageView,
    /// Format.
    pub format: vk::Format,
    /// Width and height, texels.
    pub size: [u32; 2],
    /// Mip levels of the view.
    pub mip_levels: u32,
    /// Samples a texel.
    pub samples: u32,
    /// It is a cube of six faces.
    pub is_cube: bool,
    /// Layout that it is in when the first work recorded with it starts; `SHADER_READ_ONLY_OPTIMAL` is what reading needs,
    /// and `UNDEFINED` is for what has no contents yet.
    pub layout: vk::ImageLayout,
}

/// A frame of the host's that the device may still work on: what only that frame used comes back when the token does.
///
/// It can be given back once and by nobody who has not recorded the frame; so there is no frame number to confuse. A token
/// that is dropped keeps its memory until the device's end.
#[derive(Debug)]
#[must_use = "give it to `Gpu::frame_passed` or `Gpu::frame_on_timeline` when the frame has been submitted"]
pub struct FrameToken {
    pub(crate) frame: u64,
    pub(crate) device: usize,
}
