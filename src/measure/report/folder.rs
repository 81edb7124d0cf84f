//! The report's files: made beside their place and moved there whole.

use super::{Report, ReportError};
use std::fs;
use std::path::{Path, PathBuf};

/// Everything that a report's folder holds; the first says that it is one.
const NAMES: [&str; 4] = ["report.json", "report.csv", "index.html", "plots"];

/// Fails when `folder` could not take a report: it is a file, or holds something else.
///
/// # Errors
/// [`ReportError::Foreign`], and [`ReportError::Write`] when it cannot be read or its parent is missing.
pub fn check_folder(folder: &Path) -> Result<(), ReportError> {
    let failed = |source| ReportError::Write { path: folder.to_owned(), source };
    // What is made there is renamed in the end: the folder's parent must let it.
    tempfile::tempdir_in(parent(folder)).map(drop).map_err(failed)?;
    if !folder.exists() {
        return Ok(());
    }
    if folder.file_name().is_none() {
        let source = std::io::Error::other("a folder that is named by dots cannot be replaced");
        return Err(failed(source));
    }
    let entries = fs::read_dir(folder).and_then(Iterator::collect::<Result<Vec<_>, _>>).map_err(failed)?;
    let is_ours = |entry: &fs::DirEntry| NAMES.iter().any(|name| entry.file_name() == *name);
    let has_report = entries.iter().any(|entry| entry.file_name() == NAMES[0]);
    if entries.is_empty() || (has_report && entries.iter().all(is_ours)) {
        return Ok(());
    }
    Err(ReportError::Foreign { path: folder.to_owned() })
}

/// Writes tables, plots and page; an earlier report in `folder` gives way.
///
/// # Errors
/// Those of [`check_folder`], and when something cannot be drawn or written: `folder` then is as it was.
pub fn save(report: &Report, folder: &Path) -> Result<(), ReportError> {
    check_folder(folder)?;
    let plots = report.plots()?;
    let mut files: Vec<(String, String)> = vec![
        (NAMES[0].to_owned(), format!("{:#}\n", report.json())),
        (NAMES[1].to_owned(), report.csv()),
        (NAMES[2].to_owned(), report.page(&plots)),
    ];
    files.extend(plots.into_iter().map(|plot| (format!("{}/{}.svg", NAMES[3], plot.stem), plot.svg)));

    let failed = |path: PathBuf| move |source| ReportError::Write { path, source };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".vair-report-");
    // A temporary folder is private; a report is as readable as the user's other files (less the umask).
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o777));
    let made = builder.tempdir_in(parent(folder)).map_err(failed(folder.to_owned()))?;
    fs::create_dir(made.path().join(NAMES[3])).map_err(failed(folder.join(NAMES[3])))?;
    for (name, text) in files {
        fs::write(made.path().join(&name), text).map_err(failed(folder.join(&name)))?;
    }
    // The old one steps aside instead of being deleted first: between the two moves nothing is lost.
    let old = made.path().with_extension("old");
    if folder.exists() {
        fs::rename(folder, &old).map_err(failed(folder.to_owned()))?;
    }
    if let Err(source) = fs::rename(made.path(), folder) {
        let _ = fs::rename(&old, folder);
        return Err(ReportError::Write { path: folder.to_owned(), source });
    }
    let _ = made.keep();
    // What remains of the old one harms nobody.
    let _ = fs::remove_dir_all(old);
    Ok(())
}

fn parent(folder: &Path) -> &Path {
    folder.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}
