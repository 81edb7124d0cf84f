//! The pipeline cache on disk.
//!
//! The file is keyed by device and driver and wrapped in a checksum, because drivers trust what they are given. A file
//! that does not check is ignored and replaced: a cache can only make a start slower, never wrong.

use super::calls::Device;
use super::choose::DeviceInfo;
use crate::math::fnv1a;
use ash::vk;
use std::io::Write;
use std::path::{Path, PathBuf};

const MAGIC: &[u8; 8] = b"vairpc01";
/// Magic and checksum.
const WRAPPER_BYTES: usize = 16;
/// `VkPipelineCacheHeaderVersionOne`.
const HEADER_BYTES: usize = 32;

/// A `VkPipelineCache` and the file it came from.
pub(crate) struct PipelineCache {
    pub(crate) raw: vk::PipelineCache,
    path: Option<PathBuf>,
    /// The folder that the device's user gave.
    pub(crate) dir: Option<PathBuf>,
}

impl PipelineCache {
    /// Never fails: without a usable file or cache object, pipelines are just compiled.
    pub(crate) fn open(device: &Device, info: &DeviceInfo, dir: Option<&Path>) -> Self {
        let path = dir.map(|dir| dir.join(file_name(info)));
        let data = path.as_deref().map(|path| read(path, info)).unwrap_or_default();
        let create_info = vk::PipelineCacheCreateInfo::default().initial_data(&data);
        // SAFETY: the data is empty or passed checksum and header, as VUID-VkPipelineCacheCreateInfo-initialDataSize asks.
        let raw = unsafe { device.create_pipeline_cache(&create_info, None) }.unwrap_or_else(|result| {
            tracing::warn!("no pipeline cache ({result}); pipelines are compiled anew");
            vk::PipelineCache::null()
        });
        Self { raw, path, dir: dir.map(Path::to_owned) }
    }

    /// Writes the file, if there is one to write.
    pub(crate) fn save(&self, device: &Device) {
        let Some(path) = &self.path else { return };
        if self.raw == vk::PipelineCache::null() {
            return;
        }
        // SAFETY: the cache is alive and nobody compiles while the last handle is dropped.
        let data = match unsafe { device.get_pipeline_cache_data(self.raw) } {
            Ok(data) => data,
            Err(result) => return tracing::warn!("pipeline cache not saved: {result}"),
        };
        if let Err(error) = write(path, &data) {
            tracing::warn!("pipeline cache {} not saved: {error}", path.display());
        }
    }
}

fn file_name(info: &DeviceInfo) -> String {
    let hex = |uuid: &[u8; 16]| uuid.iter().map(|byte| format!("{byte:02x}")).collect::<String>();
    let (device, driver) = (hex(&info.device_uuid), hex(&info.driver_uuid));
    format!("pipelines-{:04x}-{:04x}-{device}-{driver}.bin", info.vendor_id, info.device_id)
}

fn read(path: &Path, info: &DeviceInfo) -> Vec<u8> {
    let file = match std::fs::read(path) {
        Ok(file) => file,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Vec::new(),
        Err(error) => {
            tracing::warn!("pipeline cache {} not read: {error}", path.display());
            return Vec::new();
        }
    };
    match unwrap(&file).filter(|data| has_header_of(data, info)) {
        Some(data) => data.to_vec(),
        None => {
            tracing::warn!("pipeline cache {} is damaged or of another driver; building it anew", path.display());
            Vec::new()
        }
    }
}

fn write(path: &Path, data: &[u8]) -> std::io::Result<()> {
    let dir = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(dir)?;
    // Renamed when whole, so that a reader never sees half a file.
    let mut file = tempfile::NamedTempFile::new_in(dir)?;
    file.write_all(&wrap(data))?;
    file.persist(path)?;
    Ok(())
}

fn wrap(data: &[u8]) -> Vec<u8> {
    let mut file = Vec::with_capacity(WRAPPER_BYTES + data.len());
    file.extend_from_slice(MAGIC);
    file.extend_from_slice(&fnv1a([data]).to_le_bytes());
    file.extend_from_slice(data);
    file
}

fn unwrap(file: &[u8]) -> Option<&[u8]> {
    let (magic, rest) = file.split_first_chunk::<8>()?;
    let (sum, data) = rest.split_first_chunk::<8>()?;
    (magic == MAGIC && u64::from_le_bytes(*sum) == fnv1a([data])).then_some(data)
}

fn has_header_of(data: &[u8], info: &DeviceInfo) -> bool {
    let word = |index: usize| data.get(index * 4..index * 4 + 4).map(|bytes| bytes.to_vec());
    let is_word = |index: usize, value: u32| word(index) == Some(value.to_le_bytes().to_vec());
    is_word(0, HEADER_BYTES as u32)
        && is_word(1, vk::PipelineCacheHeaderVersion::ONE.as_raw() as u32)
        && is_word(2, info.vendor_id)
        && is_word(3, info.device_id)
        && data.get(16..HEADER_BYTES) == Some(info.pipeline_cache_uuid.as_slice())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wrapped_unwraps_and_a_flipped_bit_does_not() {
        let mut file = wrap(b"pipelines");
        assert_eq!(unwrap(&file), Some(b"pipelines".as_slice()));
        let last = file.len() - 1;
        file[last] ^= 1;
        assert_eq!(unwrap(&file), None);
        assert_eq!(unwrap(&file[..10]), None);
        assert_eq!(unwrap(&[]), None);
    }
}
