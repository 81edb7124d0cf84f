//! Errors of this room.

use crate::gpu::{FrameToken, GpuError};
use crate::scene::SceneError;
use std::path::PathBuf;

/// Why a frame or picture could not be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The scene lacks what the options name.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An option is out of its range.
    #[error("{option}: {problem}")]
    Option {
        /// Which.
        option: &'static str,
        /// What is wrong and what to do.
        problem: String,
    },
    /// A host's frame lacks something.
    #[error("recording the frame: {source}")]
    Frame {
        /// Of the frame, which is to be submitted, and given back, like any other.
        token: FrameToken,
        /// What failed first.
        source: GpuError,
    },
    /// A picture could not be encoded.
    #[error("{format} encoder: {problem}")]
    Encode {
        /// File format.
        format: &'static str,
        /// What it said.
        problem: String,
    },
    /// A file name has no ending that names a picture format.
    #[error("{}: name the picture .png (display colour) or .exr (linear light)", path.display())]
    Ending {
        /// The file.
        path: PathBuf,
    },
    /// A picture could not be written.
    #[error("{}: {source}; choose a folder that exists and can be written", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Cause.
        source: std::io::Error,
    },
}
