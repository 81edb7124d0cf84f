//! The room's error: one line each, with file, field and what to do.

use std::path::PathBuf;

/// Why a file could not be loaded, or why data made in memory is not to be relied on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AssetError {
    /// A file could not be read.
    #[error("{path}: cannot be read ({source}); check the path and its permissions", path = path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The content breaks the format.
    #[error("{file}: {field}: {problem}")]
    Format {
        /// The file.
        file: String,
        /// Path of the field inside it, such as `meshes[0].primitives[1].attributes.POSITION`.
        field: String,
        /// What is wrong and what to do.
        problem: String,
    },
    /// The content is valid but needs something that vair does not do.
    #[error("{file}: {field}: {feature} is not supported; export the file without it")]
    Unsupported {
        /// The file.
        file: String,
        /// Path of the field inside it.
        field: String,
        /// The extension or format, by name.
        feature: String,
    },
    /// A reference leaves the folder of the file.
    #[error("{file}: {field}: `{uri}` lies outside the folder of the file; move it inside, or allow outside files")]
    Outside {
        /// The file that refers, or the folder.
        file: String,
        /// Path of the field inside it.
        field: String,
        /// The reference.
        uri: String,
    },
    /// Decoding would take more memory than allowed.
    #[error(
        "{file}: {field}: needs {needed_bytes} bytes with all before it, over the limit of {limit_bytes}; shrink the data or raise the limit"
    )]
    Memory {
        /// The file.
        file: String,
        /// Path of the field inside it.
        field: String,
        /// Sum with everything decoded before.
        needed_bytes: u64,
        /// [`super::LoadOptions::memory_limit_bytes`].
        limit_bytes: u64,
    },
}
