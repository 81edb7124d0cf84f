//! One error for programs that want one: every room's error becomes it with `?`.

use crate::asset::AssetError;
use crate::gpu::GpuError;
use crate::material::MaterialError;
#[cfg(feature = "measure")]
use crate::measure::{oracle::OracleError, profile::ProfileError, report::ReportError, verify::VerifyError};
use crate::render::RenderError;
use crate::scene::SceneError;

/// Anything that this crate can fail with. Each message is one line: what, where, and what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file cannot be loaded.
    #[error(transparent)]
    Asset(#[from] AssetError),
    /// A look or preset is wrong.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// A scene cannot be made, or lacks what was asked for.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// The device failed.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// A picture cannot be made or written.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// A report cannot be made or written.
    #[cfg(feature = "measure")]
    #[error(transparent)]
    Report(#[from] ReportError),
    /// The shader functions cannot be judged.
    #[cfg(feature = "measure")]
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// A frame cannot be profiled.
    #[cfg(feature = "measure")]
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// A reference cannot be made.
    #[cfg(feature = "measure")]
    #[error(transparent)]
    Oracle(#[from] OracleError),
}
