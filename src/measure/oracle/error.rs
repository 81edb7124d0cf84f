//! Errors of this room.

/// A scene that has no exact picture, or options that make none.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum OracleError {
    /// The picture has no pixels.
    #[error("the reference is {width}x{height} pixels; both sides must be at least 1")]
    Size {
        /// Pixels.
        width: u32,
        /// Pixels.
        height: u32,
    },
    /// The environment differ from one direction to another.
    #[error(
        "the reference knows a constant environment alone, not those of '{name}'; ask for EnvironmentLight::constant"
    )]
    EnvironmentLight {
        /// The environment.
        name: String,
    },
    /// Noise is estimated from pairs of samples.
    #[error("{samples} samples a pixel give no estimate of the noise; ask for an even number, at least 2")]
    Samples {
        /// As asked.
        samples: u32,
    },
    /// Infinitely many layers of such fur would hide everything, or the oracle lacks the feature.
    #[error("material \"{material}\": {problem}")]
    Unsupported {
        /// Name of the material.
        material: String,
        /// What it has, and what to do.
        problem: String,
    },
}
