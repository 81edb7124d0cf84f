//! Loader, instance, validation layer and its messages.

use super::device::lock;
use super::error::GpuError;
use ash::vk;
use std::ffi::{CStr, c_void};
use std::sync::{Arc, Mutex};

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// Warnings and errors of the validation layer. A clone reads the same log, and outlives the device.
#[derive(Debug, Clone, Default)]
pub struct ValidationLog(Arc<Mutex<Vec<String>>>);

impl ValidationLog {
    /// All so far, oldest first, each `error: <id>: <text>` or `warning: ...`. Always empty without validation.
    pub fn messages(&self) -> Vec<String> {
        lock(&self.0).clone()
    }
}

struct Messenger {
    functions: ash::ext::debug_utils::Instance,
    raw: vk::DebugUtilsMessengerEXT,
    /// Keeps alive what the callback writes to.
    _log: ValidationLog,
}

/// An instance, destroyed on drop unless a host owns it.
pub(crate) struct Instance {
    // The library must stay loaded as long as the instance's functions are called.
    _entry: ash::Entry,
    raw: ash::Instance,
    messenger: Option<Messenger>,
    pub(crate) log: ValidationLog,
    pub(crate) has_debug_utils: bool,
    is_owned: bool,
}

impl std::ops::Deref for Instance {
    type Target = ash::Instance;
    fn deref(&self) -> &ash::Instance {
        &self.raw
    }
}

impl Instance {
    pub(crate) fn new(validate: bool) -> Result<Self, GpuError> {
        // SAFETY: the system's Vulkan loader is trusted to run its initialisation.
        let entry = unsafe { ash::Entry::load() }.map_err(|source| GpuError::NoLoader { source })?;
        let failed = |result| GpuError::from_vk("creating", "instance", result);

        // SAFETY: no preconditions.
        let layers = unsafe { entry.enumerate_instance_layer_properties() }.map_err(failed)?;
        let has_layer = layers.iter().any(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER));
        // SAFETY: no preconditions.
        let extensions = unsafe { entry.enumerate_instance_extension_properties(None) }.map_err(failed)?;
        let has_debug_utils =
            extensions.iter().any(|extension| extension.extension_name_as_c_str() == Ok(ash::ext::debug_utils::NAME));
        if validate {
            can_validate(has_layer, has_debug_utils)?;
        }

        let application = vk::ApplicationInfo::default()
            .application_name(c"vair")
            .engine_name(c"vair")
            .api_version(vk::API_VERSION_1_3);
        let mut enabled_extensions = Vec::new();
        let mut enabled_layers = Vec::new();
        if has_debug_utils {
            enabled_extensions.push(ash::ext::debug_utils::NAME.as_ptr());
        }
        let enables = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
        let mut validation = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enables);
        if validate {
            enabled_layers.push(VALIDATION_LAYER.as_ptr());
            enabled_extensions.push(ash::ext::validation_features::NAME.as_ptr());
        }
        let mut info = vk::InstanceCreateInfo::default()
            .application_info(&application)
            .enabled_extension_names(&enabled_extensions)
            .enabled_layer_names(&enabled_layers);
        if validate {
            info = info.push_next(&mut validation);
        }
        // SAFETY: every layer and extension named was listed by the loader or comes with the layer.
        let raw = unsafe { entry.create_instance(&info, None) }.map_err(not_created)?;
        let mut instance = Self {
            _entry: entry,
            raw,
            messenger: None,
            log: ValidationLog::default(),
            has_debug_utils,
            is_owned: true,
        };
        if validate {
            instance.messenger = Some(Messenger::new(&instance._entry, &instance.raw, &instance.log)?);
        }
        Ok(instance)
    }

    pub(crate) fn from_host(entry: ash::Entry, raw: ash::Instance, has_debug_utils: bool) -> Self {
        Self { _entry: entry, raw, messenger: None, log: ValidationLog::default(), has_debug_utils, is_owned: false }
    }
}

/// Without the extension the layer would run and nobody would hear it.
fn can_validate(has_layer: bool, has_debug_utils: bool) -> Result<(), GpuError> {
    match (has_layer, has_debug_utils) {
        (false, _) => Err(GpuError::MissingLayer { layer: "VK_LAYER_KHRONOS_validation" }),
        (true, false) => Err(GpuError::MissingExtension { extension: "VK_EXT_debug_utils" }),
        (true, true) => Ok(()),
    }
}

/// The loader refuses an instance when no driver at all is installed.
fn not_created(result: vk::Result) -> GpuError {
    match result {
        vk::Result::ERROR_INCOMPATIBLE_DRIVER => GpuError::NoDevice { asked: None, refused: Vec::new() },
        result => GpuError::from_vk("creating", "instance", result),
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        self.messenger = None;
        if self.is_owned {
            // SAFETY: created here; everything made from it holds the context that holds this, so it is gone.
            unsafe { self.raw.destroy_instance(None) };
        }
    }
}

impl Messenger {
    fn new(entry: &ash::Entry, instance: &ash::Instance, log: &ValidationLog) -> Result<Self, GpuError> {
        let functions = ash::ext::debug_utils::Instance::new(entry, instance);
        let info = vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(
                vk::DebugUtilsMessageSeverityFlagsEXT::WARNING | vk::DebugUtilsMessageSeverityFlagsEXT::ERROR,
            )
            // GENERAL is the loader talking about other drivers' files.
            .message_type(
                vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION | vk::DebugUtilsMessageTypeFlagsEXT::PERFORMANCE,
            )
            .pfn_user_callback(Some(on_message))
            .user_data(Arc::as_ptr(&log.0).cast_mut().cast());
        // SAFETY: the extension is enabled; the user data is what `_log` keeps, which outlives the messenger.
        let raw = unsafe { functions.create_debug_utils_messenger(&info, None) }
            .map_err(|result| GpuError::from_vk("creating", "debug messenger", result))?;
        Ok(Self { functions, raw, _log: log.clone() })
    }
}

impl Drop for Messenger {
    fn drop(&mut self) {
        // SAFETY: created in `new` from an instance that is still alive.
        unsafe { self.functions.destroy_debug_utils_messenger(self.raw, None) };
    }
}

unsafe extern "system" fn on_message(
    severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _types: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user_data: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: the layer passes a valid structure for the time of the call (VkDebugUtilsMessengerCallbackEXT).
    let Some(data) = (unsafe { data.as_ref() }) else { return vk::FALSE };
    // SAFETY: the pointer was set from the `Arc` of a log that outlives the messenger.
    let Some(messages) = (unsafe { user_data.cast::<Mutex<Vec<String>>>().as_ref() }) else { return vk::FALSE };
    // SAFETY: `p_message` is null or a null-terminated string, by the same rule.
    let text = unsafe { data.message_as_c_str() }.map(CStr::to_string_lossy).unwrap_or_default();
    // SAFETY: `p_message_id_name` is null or a null-terminated string, by the same rule.
    let id = unsafe { data.message_id_name_as_c_str() }.map(CStr::to_string_lossy).unwrap_or_default();
    let kind = match severity {
        vk::DebugUtilsMessageSeverityFlagsEXT::ERROR => "error",
        _ => "warning",
    };
    lock(messages).push(format!("{kind}: {id}: {text}"));
    vk::FALSE
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_any_driver_the_error_names_the_package() {
        let error = not_created(vk::Result::ERROR_INCOMPATIBLE_DRIVER).to_string();
        assert!(error.contains("mesa-vulkan-drivers"), "{error}");
    }

    #[test]
    fn validation_that_nobody_would_hear_is_refused() {
        assert!(can_validate(true, true).is_ok());
        assert!(matches!(can_validate(false, true), Err(GpuError::MissingLayer { .. })));
        let error = can_validate(true, false).err().unwrap().to_string();
        assert!(error.contains("VK_EXT_debug_utils"), "{error}");
    }
}
