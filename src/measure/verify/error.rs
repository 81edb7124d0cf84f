//! What keeps a function from being judged.

use crate::gpu::GpuError;

/// Error of [`crate::measure::verify`].
#[derive(Debug, thiserror::Error)]
pub enum VerifyError {
    /// No function has that name, or a part of it.
    #[error("no shader function is called '{name}'{}; --list names them", meant(.nearest))]
    UnknownFunction {
        /// What was asked for.
        name: String,
        /// The name that was probably meant.
        nearest: Option<&'static str>,
    },
    /// A function of the library that nothing judges.
    #[error("shaders_glsl/lib/{file}: {name} has no twin: give it one in src/measure/twin")]
    NoTwin {
        /// Function.
        name: &'static str,
        /// File under `shaders_glsl/lib`.
        file: &'static str,
    },
    /// A twin of nothing.
    #[error("the twin {name} judges no function of shaders_glsl/lib: rename or remove it in src/measure/twin")]
    NoFunction {
        /// Name that the twin declares.
        name: String,
    },
    /// A twin that declares other arguments than its function has.
    #[error("the twin {name}: {problem}; list one domain an argument or member in src/measure/twin")]
    Domains {
        /// Function.
        name: &'static str,
        /// What differs.
        problem: String,
    },
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
}

fn meant(nearest: &Option<&'static str>) -> String {
    nearest.map_or_else(String::new, |name| format!("; did you mean '{name}'?"))
}
