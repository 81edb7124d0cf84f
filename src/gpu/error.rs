//! What can go wrong between this program and a Vulkan device.

use super::choose::DeviceReport;
use ash::vk;

/// Error of the device layer: what, on which named object, and what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GpuError {
    /// The Vulkan loader library is absent.
    #[error("no Vulkan loader ({source}): install it (Debian: libvulkan1 and mesa-vulkan-drivers)")]
    NoLoader {
        /// Why the library did not load.
        source: ash::LoadingError,
    },
    /// No device is usable.
    #[error("{}", no_device(.asked, .refused))]
    NoDevice {
        /// Part of a device name that was asked for.
        asked: Option<String>,
        /// Every device found, with what it lacks; empty `missing` means that only its name does not match.
        refused: Vec<DeviceReport>,
    },
    /// Validation was asked for and its layer is absent.
    #[error("Vulkan layer {layer} is not installed: install vulkan-validationlayers or point VK_LAYER_PATH at it")]
    MissingLayer {
        /// Name of the layer.
        layer: &'static str,
    },
    /// Validation was asked for and its messages would have no way out.
    #[error("the Vulkan loader lacks {extension}, which validation needs: update it (Debian: libvulkan1)")]
    MissingExtension {
        /// Name of the instance extension.
        extension: &'static str,
    },
    /// Host or device memory ran out.
    #[error("out of memory for '{name}': use a smaller size, fewer samples or smaller textures")]
    OutOfMemory {
        /// Object or work that needed the memory.
        name: String,
    },
    /// The device stopped answering and cannot be used any more.
    #[error("the Vulkan device was lost during '{name}': create a new device; if it repeats, update the driver")]
    DeviceLost {
        /// Object or work during which it was noticed.
        name: String,
    },
    /// Work did not end within its time.
    #[error("'{name}' did not end within {timeout_ms} ms: allow more time or do less work at once")]
    Timeout {
        /// Submission.
        name: String,
        /// Time allowed.
        timeout_ms: u64,
    },
    /// The allocator refused.
    #[error("no memory for '{name}': {source}")]
    Allocation {
        /// Object that needed the memory.
        name: String,
        /// The allocator's reason.
        source: gpu_allocator::AllocationError,
    },
    /// Shaders, pipeline, bound resources or targets do not fit each other.
    #[error("pipeline '{pipeline}': {problem}")]
    Interface {
        /// Pipeline, or the pass where no pipeline is known.
        pipeline: String,
        /// What does not fit, with set, binding and names.
        problem: String,
    },
    /// The crate was built without a shader compiler.
    #[error(
        "pipeline '{pipeline}': vair was built without shaders: build it where glslangValidator is installed (Debian: \
         glslang-tools) and neither VAIR_NO_SHADERS nor DOCS_RS is set"
    )]
    NoShaders {
        /// Pipeline.
        pipeline: String,
    },
    /// A size that the device cannot hold.
    #[error("'{name}' of {}x{} texels: each side must be 1 to {limit} on this device", .size[0], .size[1])]
    Size {
        /// Image.
        name: String,
        /// Width and height asked for, texels.
        size: [u32; 2],
        /// Largest side on this device, texels.
        limit: u32,
    },
    /// A read, write, copy or upload that does not fit its resource.
    #[error("'{name}': {problem}")]
    Range {
        /// Buffer or image.
        name: String,
        /// What does not fit, in numbers.
        problem: String,
    },
    /// A format, sample count or use that this device does not have.
    #[error("'{name}': {problem}; this device does not support it")]
    Unsupported {
        /// Object.
        name: String,
        /// What was asked for.
        problem: String,
    },
    /// An encoder that records into the host's command buffer cannot submit it.
    #[error("'{name}' records into the host's command buffer: call finish_on_host and let the host submit")]
    HostSubmits {
        /// Encoder.
        name: String,
    },
    /// Any other Vulkan error.
    #[error("Vulkan: {what} '{name}' failed: {result}")]
    Vulkan {
        /// The operation.
        what: &'static str,
        /// Object.
        name: String,
        /// The driver's answer.
        result: vk::Result,
    },
}

impl GpuError {
    /// Classifies the driver's answer to `what` on the object `name`.
    pub(crate) fn from_vk(what: &'static str, name: &str, result: vk::Result) -> Self {
        let name = name.to_owned();
        match result {
            vk::Result::ERROR_OUT_OF_DEVICE_MEMORY
            | vk::Result::ERROR_OUT_OF_HOST_MEMORY
            | vk::Result::ERROR_OUT_OF_POOL_MEMORY
            | vk::Result::ERROR_FRAGMENTED_POOL => Self::OutOfMemory { name },
            vk::Result::ERROR_DEVICE_LOST => Self::DeviceLost { name },
            result => Self::Vulkan { what, name, result },
        }
    }
}

fn no_device(asked: &Option<String>, refused: &[DeviceReport]) -> String {
    if refused.is_empty() {
        return "no Vulkan device: install a Vulkan 1.3 driver (Debian: mesa-vulkan-drivers)".to_owned();
    }
    let wanted = asked.as_ref().map(|name| format!(" whose name contains '{name}'")).unwrap_or_default();
    let found: Vec<String> = refused
        .iter()
        .map(|device| match device.missing.is_empty() {
            true => format!("{} (usable)", device.name),
            false => format!("{} (lacks {})", device.name, device.missing.join(", ")),
        })
        .collect();
    format!("no usable Vulkan device{wanted}; found: {}", found.join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::DeviceKind;

    #[test]
    fn a_refused_device_says_what_it_lacks() {
        let device = DeviceReport {
            name: "Old Card".into(),
            driver: "d".into(),
            api: "1.1.0".into(),
            kind: DeviceKind::Discrete,
            missing: vec!["Vulkan 1.3".into()],
        };
        let text = GpuError::NoDevice { asked: Some("card".into()), refused: vec![device] }.to_string();
        assert_eq!(text, "no usable Vulkan device whose name contains 'card'; found: Old Card (lacks Vulkan 1.3)");
    }

    #[test]
    fn out_of_memory_and_device_loss_are_their_own_kinds() {
        let error = GpuError::from_vk("create", "x", vk::Result::ERROR_OUT_OF_DEVICE_MEMORY);
        assert!(matches!(error, GpuError::OutOfMemory { .. }));
        let error = GpuError::from_vk("submit", "x", vk::Result::ERROR_DEVICE_LOST);
        assert!(matches!(error, GpuError::DeviceLost { .. }));
    }
}
