//! Codes, messages, and the border that no panic crosses.

use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};
use vair::Error;
use vair::gpu::GpuError;
use vair::material::MaterialError;
use vair::render::RenderError;
use vair::scene::SceneError;

/// How a call ended. All but VAIR_OK leave a message: vair_last_error_message().
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VairResult {
    /// It did what it says.
    VairOk = 0,
    /// An argument is NULL, out of its range, or does not belong here. Nothing was done.
    VairErrorArgument = 1,
    /// A file cannot be read, or data is not what it should be.
    VairErrorFile = 2,
    /// A look, preset or parameter is wrong.
    VairErrorMaterial = 3,
    /// The scene lacks what was asked for.
    VairErrorScene = 4,
    /// The device, or the way in which it was created, lacks what is needed.
    VairErrorUnsupported = 5,
    /// The device is out of memory.
    VairErrorOutOfMemory = 6,
    /// The device was lost.
    VairErrorDeviceLost = 7,
    /// The driver failed in another way.
    VairErrorDevice = 8,
    /// A fault of vair's own. The objects of the call are good for nothing but to be freed (frames: finished).
    VairErrorInternal = 9,
}

/// Why a call failed.
#[derive(Debug)]
pub(crate) struct Failure {
    code: VairResult,
    message: String,
}

thread_local! {
    static MESSAGE: RefCell<CString> = RefCell::default();
}

/// What the last call of this thread that failed had to say: one line of UTF-8, what, where and what to do; never NULL. It is
/// valid until the thread's next call that fails.
#[unsafe(no_mangle)]
pub extern "C" fn vair_last_error_message() -> *const c_char {
    // NULL would be a trap: the message is gone only while its thread ends.
    MESSAGE.try_with(|message| message.borrow().as_ptr()).unwrap_or(c"".as_ptr())
}

/// Runs a call of the host's. Neither a failure nor a panic goes further.
pub(crate) fn border(call: impl FnOnce() -> Result<(), Failure>) -> VairResult {
    // What a panic leaves half-done is not used again: the header says so of VAIR_ERROR_INTERNAL.
    let ended = catch_unwind(AssertUnwindSafe(call));
    let Failure { code, message } = match ended {
        Ok(Ok(())) => return VairResult::VairOk,
        Ok(Err(failure)) => failure,
        Err(panic) => internal(&*panic),
    };
    let message = CString::new(message.replace('\0', " ")).unwrap_or_default();
    // Without a message where the thread is ending.
    let _ = MESSAGE.try_with(|kept| kept.replace(message));
    code
}

/// The same for calls that return nothing.
pub(crate) fn border_of_free(call: impl FnOnce()) {
    border(|| {
        call();
        Ok(())
    });
}

fn internal(panic: &(dyn Any + Send)) -> Failure {
    let said = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
    let message = format!("a fault of vair's own: {}; please report it", said.unwrap_or("it gave no reason"));
    Failure { code: VairResult::VairErrorInternal, message }
}

impl Failure {
    pub(crate) fn argument(message: impl Into<String>) -> Self {
        Self { code: VairResult::VairErrorArgument, message: message.into() }
    }

    pub(crate) fn material(message: impl Into<String>) -> Self {
        Self { code: VairResult::VairErrorMaterial, message: message.into() }
    }

    pub(crate) fn scene(message: impl Into<String>) -> Self {
        Self { code: VairResult::VairErrorScene, message: message.into() }
    }

    pub(crate) fn unsupported(message: impl Into<String>) -> Self {
        Self { code: VairResult::VairErrorUnsupported, message: message.into() }
    }
}

impl<E: Into<Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        let error = error.into();
        Self { code: code_of(&error), message: error.to_string() }
    }
}

fn code_of(error: &Error) -> VairResult {
    match error {
        Error::Gpu(error) | Error::Render(RenderError::Gpu(error) | RenderError::Frame { source: error, .. }) => {
            code_of_device(error)
        }
        Error::Scene(error) | Error::Render(RenderError::Scene(error)) => code_of_scene(error),
        Error::Render(RenderError::Option { .. }) => VairResult::VairErrorArgument,
        Error::Material(_) => VairResult::VairErrorMaterial,
        _ => VairResult::VairErrorFile,
    }
}

fn code_of_device(error: &GpuError) -> VairResult {
    match error {
        GpuError::OutOfMemory { .. } | GpuError::Allocation { .. } => VairResult::VairErrorOutOfMemory,
        GpuError::DeviceLost { .. } => VairResult::VairErrorDeviceLost,
        GpuError::NoLoader { .. }
        | GpuError::NoDevice { .. }
        | GpuError::MissingLayer { .. }
        | GpuError::MissingExtension { .. }
        | GpuError::NoShaders { .. }
        | GpuError::Unsupported { .. } => VairResult::VairErrorUnsupported,
        GpuError::Range { .. } | GpuError::Size { .. } => VairResult::VairErrorArgument,
        _ => VairResult::VairErrorDevice,
    }
}

fn code_of_scene(error: &SceneError) -> VairResult {
    match error {
        SceneError::Asset(_) => VairResult::VairErrorFile,
        SceneError::Material(MaterialError::UnknownMaterial { .. }) => VairResult::VairErrorScene,
        SceneError::Material(_) | SceneError::Keys { .. } | SceneError::Parameter { .. } => {
            VairResult::VairErrorMaterial
        }
        _ => VairResult::VairErrorScene,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    fn message() -> String {
        // SAFETY: never NULL, and no call of this thread comes between.
        let text = unsafe { CStr::from_ptr(vair_last_error_message()) };
        text.to_str().unwrap().to_owned()
    }

    #[test]
    fn a_panic_becomes_a_code_and_a_message() {
        let code = border(|| panic!("index 3 of 2"));
        assert_eq!(code, VairResult::VairErrorInternal);
        assert!(message().contains("index 3 of 2"), "{}", message());
    }

    #[test]
    fn a_message_stays_until_the_next_failure() {
        border(|| Err(Failure::argument("first\0of two")));
        assert_eq!(border(|| Ok(())), VairResult::VairOk);
        assert_eq!(message(), "first of two");
        std::thread::spawn(|| assert_eq!(message(), "")).join().unwrap();
    }

    #[test]
    fn errors_keep_their_kind() {
        let lost = RenderError::Gpu(GpuError::DeviceLost { name: "frame".to_owned() });
        assert_eq!(Failure::from(lost).code, VairResult::VairErrorDeviceLost);
        let option = RenderError::Option { option: "views", problem: "none".to_owned() };
        assert_eq!(Failure::from(option).code, VairResult::VairErrorArgument);
    }
}
