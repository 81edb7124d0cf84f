//! A host program: its own instance, device, queue, images and command buffers, under the validation layer.

#[path = "../../examples/engine/mod.rs"]
#[allow(dead_code, reason = "shared with the example, and no test uses all of it")]
mod engine;

pub use engine::{Engine, Pass, RenderTarget};
use std::ffi::{CStr, c_void};
use std::sync::{Mutex, PoisonError};
use vair::gpu::ash;
use vair::gpu::vk;
use vair::gpu::*;

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
    /// Its own objects.
    pub engine: Engine,
    debug: ash::ext::debug_utils::Instance,
    messenger: vk::DebugUtilsMessengerEXT,
}

impl Host {
    /// Opens the first device that the crate can use.
    pub fn new() -> Self {
        let engine = Engine::new(&[c"VK_LAYER_KHRONOS_validation"], &[ash::ext::debug_utils::NAME]).unwrap();
        let debug = ash::ext::debug_utils::Instance::new(&engine.entry, &engine.instance);
        let info = vk::DebugUtilsMessengerCreateInfoEXT::default()
            .message_severity(
                vk::DebugUtilsMessageSeverityFlagsEXT::ERROR | vk::DebugUtilsMessageSeverityFlagsEXT::WARNING,
            )
            .message_type(vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION)
            .pfn_user_callback(Some(on_message));
        // SAFETY: the extension is enabled.
        let messenger = unsafe { debug.create_debug_utils_messenger(&info, None) }.unwrap();
        Self { engine, debug, messenger }
    }

    /// The handles, lent to the crate.
    pub fn lend(&self) -> HostDevice {
        self.engine.lend(true)
    }

    /// Records with `record`, submits and waits, all by the host's own means.
    pub fn run(&self, record: impl FnOnce(vk::CommandBuffer)) {
        let commands = self.engine.commands().unwrap();
        record(self.engine.begin(&commands).unwrap());
        self.engine.submit(&commands).unwrap();
        self.engine.wait(&commands).unwrap();
        self.engine.destroy_commands(&commands);
    }

    /// Destroys the device: everything made from it is gone.
    pub fn destroy(self) {
        // SAFETY: the device is idle and everything made from it is gone.
        unsafe { self.engine.device.destroy_device(None) };
        // SAFETY: nothing that it listens to is left.
        unsafe { self.debug.destroy_debug_utils_messenger(self.messenger, None) };
        // SAFETY: as above.
        unsafe { self.engine.instance.destroy_instance(None) };
    }
}
