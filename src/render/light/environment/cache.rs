//! What was prepared, on disk. As with the pipeline cache, a file that does not check is ignored and replaced: a cache can
//! only make a start slower, never wrong.

use super::EnvironmentQuality;
use super::prepare::SHADERS;
use crate::gpu::Gpu;
use crate::math::fnv1a;
use crate::render::picture::write_file;
use crate::shader::{Defines, ShaderKey};
use std::path::PathBuf;

const MAGIC: &[u8; 8] = b"vairenv1";

/// The bytes of `name`, from its file, or from `make`, which are then kept in one. The file's name tells apart contents,
/// settings, shaders and devices.
///
/// # Errors
/// Those of `make`; what concerns the file is only logged.
pub(super) fn cached<T, E>(
    gpu: &Gpu,
    name: &str,
    content: u64,
    quality: &EnvironmentQuality,
    decode: impl Fn(&[u8]) -> Option<T>,
    encode: impl Fn(&T) -> Vec<u8>,
    make: impl FnOnce() -> Result<T, E>,
) -> Result<T, E> {
    let Some(path) = file_of(gpu, name, content, quality) else { return make() };
    match std::fs::read(&path) {
        Ok(file) => match unwrap(&file).and_then(&decode) {
            Some(found) => return Ok(found),
            None => tracing::warn!("{} is damaged; making it anew", path.display()),
        },
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
        Err(error) => tracing::warn!("{} not read: {error}", path.display()),
    }
    let made = make()?;
    let folder = path.parent().map_or(Ok(()), std::fs::create_dir_all);
    if let Err(error) = folder
        .map_err(|error| error.to_string())
        .and_then(|()| write_file(&path, &wrap(&encode(&made))).map_err(|error| error.to_string()))
    {
        tracing::warn!("{} not kept: {error}", path.display());
    }
    Ok(made)
}

/// `None` where the device was opened without a folder for what it caches.
fn file_of(gpu: &Gpu, name: &str, content: u64, quality: &EnvironmentQuality) -> Option<PathBuf> {
    let info = gpu.info();
    let EnvironmentQuality { face_px, samples, table_px } = *quality;
    let settings = [face_px, samples, table_px, info.vendor_id, info.device_id];
    let shaders = SHADERS.map(|file| ShaderKey::new(file, Defines::NONE).shader().spirv_hash.to_le_bytes());
    let content = content.to_le_bytes();
    let pieces = std::iter::once(&content).chain(&shaders).map(|word| word.as_slice());
    let key = fnv1a(pieces.chain([bytemuck::cast_slice(&settings), &info.device_uuid, &info.driver_uuid]));
    Some(gpu.cache_dir()?.join("environments").join(format!("{name}-{key:016x}.bin")))
}

fn wrap(data: &[u8]) -> Vec<u8> {
    [MAGIC, &fnv1a([data]).to_le_bytes(), data].concat()
}

fn unwrap(file: &[u8]) -> Option<&[u8]> {
    let (magic, rest) = file.split_first_chunk::<8>()?;
    let (sum, data) = rest.split_first_chunk::<8>()?;
    (magic == MAGIC && u64::from_le_bytes(*sum) == fnv1a([data])).then_some(data)
}
