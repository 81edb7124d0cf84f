//! What Vulkan's validation layer says: wgpu hands it to the crate `log`.

use crate::Problem;
use log::{Level, LevelFilter, Log, Metadata, Record};
use std::sync::{Mutex, PoisonError};
use vair::gpu::ash;

static MESSAGES: Messages = Messages(Mutex::new(Vec::new()));

struct Messages(Mutex<Vec<String>>);

impl Log for Messages {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        metadata.level() <= Level::Warn
    }

    fn log(&self, record: &Record<'_>) {
        if !self.enabled(record.metadata()) {
            return;
        }
        let text = record.args().to_string();
        // "GENERAL" is the loader talking about other drivers' files; lines that begin with a tab belong to the one before.
        if record.target().starts_with("wgpu_hal::vulkan") && !text.starts_with("GENERAL") && !text.starts_with('\t') {
            self.0.lock().unwrap_or_else(PoisonError::into_inner).push(text);
        }
    }

    fn flush(&self) {}
}

/// Listens from now on. wgpu asks for warnings only when somebody hears them, so this comes before its instance.
pub fn listen() -> Result<(), Problem> {
    log::set_logger(&MESSAGES)?;
    log::set_max_level(LevelFilter::Warn);
    Ok(())
}

/// Whether the layer is installed; wgpu does without it in silence.
pub fn is_present() -> Result<bool, Problem> {
    // SAFETY: the system's Vulkan loader is trusted to run its initialisation.
    let entry = unsafe { ash::Entry::load() }?;
    // SAFETY: no preconditions.
    let layers = unsafe { entry.enumerate_instance_layer_properties() }?;
    Ok(layers.iter().any(|layer| layer.layer_name_as_c_str() == Ok(c"VK_LAYER_KHRONOS_validation")))
}

/// Fails with all that was said so far.
pub fn check() -> Result<(), Problem> {
    let messages = MESSAGES.0.lock().unwrap_or_else(PoisonError::into_inner);
    match messages.is_empty() {
        true => Ok(()),
        false => Err(format!("the validation layer objects:\n{}", messages.join("\n")).into()),
    }
}
