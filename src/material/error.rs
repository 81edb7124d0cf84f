//! What can be wrong with materials.

use super::parameter::ParameterError;

/// Why a look or the look keys of a file could not be used; one line that says where.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MaterialError {
    /// Not TOML.
    #[error("{place}: {message}")]
    Syntax {
        /// File and line.
        place: String,
        /// What the parser says.
        message: String,
    },
    /// A key or value that does not fit.
    #[error("{place}: {problem}")]
    Parameter {
        /// File and line, or the material of the scene.
        place: String,
        /// What is wrong.
        problem: ParameterError,
    },
    /// A section that is not a material.
    #[error("{place}: unknown section `{section}`, write [material.\"NAME\"]")]
    UnknownSection {
        /// File and line.
        place: String,
        /// As written.
        section: String,
    },
    /// No preset of that name.
    #[error("{place}: unknown preset `{name}`, {}", match nearest {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => format!("there are {known}"),
    })]
    UnknownPreset {
        /// File and line.
        place: String,
        /// As written.
        name: String,
        /// The name that was probably meant.
        nearest: Option<String>,
        /// All names.
        known: String,
    },
    /// A material that the scene lacks.
    #[error("{place}: the scene has no material `{name}`, {}", match nearest {
        Some(nearest) => format!("did you mean `{nearest}`?"),
        None => format!("it has {known}"),
    })]
    UnknownMaterial {
        /// File and line.
        place: String,
        /// As written.
        name: String,
        /// The name that was probably meant.
        nearest: Option<String>,
        /// Some of the names.
        known: String,
    },
}
