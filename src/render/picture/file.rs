//! Files that are whole or not there.

use crate::render::RenderError;
use std::io::Write;
use std::path::Path;

/// Writes a file whole or not at all: to a temporary file beside it, then renamed.
///
/// # Errors
/// [`RenderError::Write`].
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), RenderError> {
    let write = || -> std::io::Result<()> {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut builder = tempfile::Builder::new();
        // A temporary file is private; this one is to be as readable as the user's other files (less the umask).
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut file = builder.tempfile_in(folder)?;
        file.write_all(bytes)?;
        file.persist(path)?;
        Ok(())
    };
    write().map_err(|source| RenderError::Write { path: path.to_owned(), source })
}
