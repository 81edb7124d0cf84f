//! Where compiled pipelines are kept between runs.

use std::env;
use std::path::PathBuf;

/// The user's cache folder for this program; `None` where the system names none.
pub fn pipeline_cache_dir() -> Option<PathBuf> {
    let named = |name: &str| env::var_os(name).map(PathBuf::from).filter(|path| path.is_absolute());
    let folder = match () {
        () if cfg!(windows) => named("LOCALAPPDATA"),
        () if cfg!(target_os = "macos") => named("HOME").map(|home| home.join("Library/Caches")),
        () => named("XDG_CACHE_HOME").or_else(|| named("HOME").map(|home| home.join(".cache"))),
    };
    folder.map(|folder| folder.join("vair"))
}
