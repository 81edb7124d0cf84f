//! Where a reference leads: data URIs, percent-decoding, and the rule that a file reads only
//! inside its own folder.

use super::context::Context;
use super::{AssetError, LoadOptions};
use base64::Engine;
use base64::engine::general_purpose::STANDARD_PAD_INDIFFERENT;
use percent_encoding::{percent_decode, percent_decode_str};
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

/// Why a relative path has no file.
enum Miss {
    Outside,
    Io(std::io::Error),
}

/// Resolves `relative` under `folder`, following links; the answer lies inside it unless
/// `allow_outside`.
fn locate(folder: &Path, relative: &str, allow_outside: bool) -> Result<PathBuf, Miss> {
    let path = folder.join(relative);
    if allow_outside {
        return Ok(path);
    }
    let inside = |component: Component| matches!(component, Component::Normal(_) | Component::CurDir);
    if !Path::new(relative).components().all(inside) {
        return Err(Miss::Outside);
    }
    let root = folder.canonicalize().map_err(Miss::Io)?;
    // A link may lead anywhere: compare where it ends.
    let path = path.canonicalize().map_err(Miss::Io)?;
    if path.starts_with(&root) { Ok(path) } else { Err(Miss::Outside) }
}

/// Whether a link at the end of a path is followed.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Links {
    Follow,
    /// For a path that was already followed to its end: what is a link there now has been put there since.
    Refuse,
}

/// Opens without waiting: opening a pipe would wait for its writer. What it opened, its metadata tells.
#[cfg(target_os = "linux")]
fn open(path: &Path, links: Links) -> std::io::Result<File> {
    use std::os::unix::fs::OpenOptionsExt;
    // Of fcntl.h; these two differ between processors, others agree on all that Vulkan runs on.
    const O_NONBLOCK: i32 = 0o4000;
    #[cfg(any(target_arch = "aarch64", target_arch = "arm"))]
    const O_NOFOLLOW: i32 = 0o100_000;
    #[cfg(not(any(target_arch = "aarch64", target_arch = "arm")))]
    const O_NOFOLLOW: i32 = 0o400_000;
    let flags = if links == Links::Refuse { O_NONBLOCK | O_NOFOLLOW } else { O_NONBLOCK };
    std::fs::OpenOptions::new().read(true).custom_flags(flags).open(path)
}

/// Elsewhere a pipe can only be asked for by its path, before opening.
#[cfg(not(target_os = "linux"))]
fn open(path: &Path, links: Links) -> std::io::Result<File> {
    let kind = if links == Links::Refuse { std::fs::symlink_metadata(path) } else { std::fs::metadata(path) }?;
    if kind.is_file() { File::open(path) } else { Err(not_plain(kind.is_dir())) }
}

fn not_plain(is_folder: bool) -> std::io::Error {
    if is_folder {
        std::io::Error::new(std::io::ErrorKind::IsADirectory, "it is a folder, not a file")
    } else {
        std::io::Error::new(std::io::ErrorKind::InvalidInput, "it is not a plain file")
    }
}

/// Bytes of a plain file, or its size where that is over the limit. What was opened is what is asked.
fn read_opened(path: &Path, limit_bytes: u64, links: Links) -> Result<Result<Vec<u8>, u64>, AssetError> {
    let io = |source| AssetError::Io { path: path.to_path_buf(), source };
    let file = open(path, links).map_err(io)?;
    let kind = file.metadata().map_err(io)?;
    if !kind.is_file() {
        return Err(io(not_plain(kind.is_dir())));
    }
    if kind.len() > limit_bytes {
        return Ok(Err(kind.len()));
    }
    let mut bytes = Vec::new();
    // It may grow while it is read.
    file.take(limit_bytes.saturating_add(1)).read_to_end(&mut bytes).map_err(io)?;
    let read_bytes = bytes.len() as u64;
    Ok(if read_bytes > limit_bytes { Err(read_bytes) } else { Ok(bytes) })
}

fn too_large(path: &Path, needed_bytes: u64, limit_bytes: u64) -> AssetError {
    AssetError::Memory { file: path.display().to_string(), field: "file".to_owned(), needed_bytes, limit_bytes }
}

/// Reads a plain file that the user named; pipes, devices and folders are refused without waiting for them.
///
/// # Errors
/// [`AssetError::Memory`] when it is larger than `limit_bytes`; [`AssetError::Io`] when it cannot be read.
pub fn read_file(path: &Path, limit_bytes: u64) -> Result<Vec<u8>, AssetError> {
    read_opened(path, limit_bytes, Links::Follow)?.map_err(|needed_bytes| too_large(path, needed_bytes, limit_bytes))
}

/// Reads `relative` (a plain path, not percent-encoded) inside `folder`.
///
/// # Errors
/// [`AssetError::Outside`] for `..`, an absolute path or a link that leaves `folder`, unless the options allow it;
/// [`AssetError::Memory`] when the file is larger than the limit; [`AssetError::Io`] when it cannot be read.
pub fn read_inside(folder: &Path, relative: &str, options: &LoadOptions) -> Result<Vec<u8>, AssetError> {
    // The folder of a bare file name is the current one.
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let path = match locate(folder, relative, options.allow_outside) {
        Ok(path) => path,
        Err(Miss::Io(source)) => return Err(AssetError::Io { path: folder.join(relative), source }),
        Err(Miss::Outside) => {
            return Err(AssetError::Outside {
                file: folder.display().to_string(),
                field: "path".to_owned(),
                uri: relative.to_owned(),
            });
        }
    };
    let limit_bytes = options.memory_limit_bytes;
    read_opened(&path, limit_bytes, links_of(options.allow_outside))?
        .map_err(|needed_bytes| too_large(&path, needed_bytes, limit_bytes))
}

/// What [`locate`] has followed to its end, is followed no further.
fn links_of(allow_outside: bool) -> Links {
    if allow_outside { Links::Follow } else { Links::Refuse }
}

/// Bytes behind a glTF `uri`: a data URI or a percent-encoded relative path.
pub(super) fn read(context: &Context, field: &str, uri: &str) -> Result<Vec<u8>, AssetError> {
    if let Some(data) = uri.strip_prefix("data:") {
        return decode_data(context, field, data);
    }
    if has_scheme(uri) {
        let scheme = uri.split(':').next().unwrap_or_default();
        return Err(context.unsupported(field, format_args!("a URI with scheme `{scheme}:`")));
    }
    let relative = percent_decode_str(uri)
        .decode_utf8()
        .map_err(|_| context.error(field, format_args!("`{uri}` does not percent-decode to UTF-8")))?;
    let path = match locate(&context.folder, &relative, context.allow_outside) {
        Ok(path) => path,
        Err(Miss::Outside) => return Err(context.outside(field, &relative)),
        Err(Miss::Io(source)) => {
            let problem = format_args!("`{relative}` cannot be read ({source}); put it beside the file").to_string();
            return Err(context.error(field, problem));
        }
    };
    match read_opened(&path, context.left_bytes(), links_of(context.allow_outside))? {
        Ok(bytes) => {
            context.spend(field, bytes.len() as u64)?;
            Ok(bytes)
        }
        Err(bytes) => {
            context.check(field, bytes)?;
            Err(context.error(field, "is larger than any memory"))
        }
    }
}

/// RFC 3986: letter, then letters, digits, `+`, `-`, `.`, then `:`.
fn has_scheme(uri: &str) -> bool {
    uri.split_once(':').is_some_and(|(scheme, _)| {
        scheme.starts_with(|first: char| first.is_ascii_alphabetic())
            && scheme.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.'))
    })
}

/// RFC 2397, after `data:`.
fn decode_data(context: &Context, field: &str, data: &str) -> Result<Vec<u8>, AssetError> {
    let (header, payload) =
        data.split_once(',').ok_or_else(|| context.error(field, "data URI has no comma before its data"))?;
    context.spend(field, payload.len() as u64)?;
    let bytes: Vec<u8> = percent_decode(payload.as_bytes()).collect();
    if !header.ends_with(";base64") {
        return Ok(bytes);
    }
    STANDARD_PAD_INDIFFERENT
        .decode(&bytes)
        .map_err(|source| context.error(field, format_args!("data URI is not valid base64 ({source})")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn context() -> Context {
        Context::new(Path::new("a.gltf"), &LoadOptions::default())
    }

    #[test]
    fn data_uris_decode() {
        let context = context();
        for (uri, bytes) in [
            ("data:application/octet-stream;base64,AQID", &[1u8, 2, 3][..]),
            ("data:;base64,AQI=", &[1, 2]),
            ("data:;base64,AQI", &[1, 2]),
            ("data:;base64,AQI%3D", &[1, 2]),
            ("data:text/plain,a%20b", b"a b"),
        ] {
            assert_eq!(read(&context, "f", uri).unwrap(), bytes, "{uri}");
        }
        for uri in ["data:;base64,!!", "data:nothing"] {
            assert!(read(&context, "buffers[0].uri", uri).unwrap_err().to_string().contains("buffers[0].uri"), "{uri}");
        }
    }

    #[test]
    fn schemes_are_refused() {
        for uri in ["http://example.org/a.png", "file:///a.png", "C:/a.png"] {
            assert!(matches!(read(&context(), "f", uri), Err(AssetError::Unsupported { .. })), "{uri}");
        }
        assert!(!has_scheme("a b:c.png"));
    }

    #[test]
    fn reads_only_inside_the_folder() {
        let closed = LoadOptions::default();
        let open = LoadOptions { allow_outside: true, ..closed.clone() };
        let outer = tempfile::tempdir().unwrap();
        let folder = outer.path().join("in");
        std::fs::create_dir(&folder).unwrap();
        std::fs::write(outer.path().join("secret"), b"s").unwrap();
        std::fs::write(folder.join("ü b"), b"ok").unwrap();
        assert_eq!(read_inside(&folder, "./ü b", &closed).unwrap(), b"ok");
        let absolute = outer.path().join("secret").display().to_string();
        for relative in ["../secret", "x/../../secret", absolute.as_str()] {
            assert!(matches!(read_inside(&folder, relative, &closed), Err(AssetError::Outside { .. })), "{relative}");
        }
        assert_eq!(read_inside(&folder, "../secret", &open).unwrap(), b"s");
        assert!(matches!(read_inside(&folder, "missing", &closed), Err(AssetError::Io { .. })));
        assert!(matches!(read_inside(&folder, "nul\0", &closed), Err(AssetError::Io { .. })));
        assert!(matches!(read_inside(&folder, ".", &closed), Err(AssetError::Io { .. })));
        let small = LoadOptions { memory_limit_bytes: 1, ..closed.clone() };
        assert!(matches!(read_inside(&folder, "ü b", &small), Err(AssetError::Memory { .. })));
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(outer.path().join("secret"), folder.join("link")).unwrap();
            assert!(matches!(read_inside(&folder, "link", &closed), Err(AssetError::Outside { .. })));
            // A link that comes between the check and the opening.
            assert!(read_opened(&folder.join("link"), 9, Links::Refuse).is_err());
            assert_eq!(read_file(&folder.join("link"), 9).unwrap(), b"s");
            let pipe = folder.join("pipe");
            assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
            assert!(read_file(&pipe, 9).unwrap_err().to_string().contains("not a plain file"));
            assert!(read_inside(&folder, "pipe", &closed).is_err());
        }
    }
}
