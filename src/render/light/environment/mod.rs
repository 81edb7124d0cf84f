//! Image-based lighting: a cube of prefiltered radiance, spherical-harmonics (SH) irradiance coefficients, and the table of
//! prefiltered lobe directions and roughness.

mod cache;
mod maps;
mod prepare;
mod prepared;
mod quality;

pub use maps::{EnvironmentMaps, HostEnvironment, LobeTable, environment_bytes};
pub(in crate::render) use maps::{FORMAT as RADIANCE_FORMAT, is_same, sampled_image};
pub(in crate::render) use prepare::{LARGEST_TEXEL, halves};
pub use prepared::{PreparedEnvironment, SH_COEFFICIENTS};
pub use quality::EnvironmentQuality;

use crate::asset::Environment;
use crate::gpu::{Gpu, GpuError};

/// Cube and SH irradiance coefficients of an environment, from the device's cache folder or computed.
///
/// # Errors
/// When the device is out of memory or lost.
pub fn prepare_environment(
    gpu: &Gpu,
    environment: &Environment,
    quality: &EnvironmentQuality,
) -> Result<PreparedEnvironment, GpuError> {
    let make = || compute_environment(gpu, environment, quality);
    let content = environment.content_hash();
    let (decode, encode) = (PreparedEnvironment::from_bytes, PreparedEnvironment::to_bytes);
    cache::cached(gpu, "environment", content, quality, decode, encode, make)
}

/// [`prepare_environment`] without the cache: computed.
///
/// # Errors
/// When the device is out of memory or lost.
pub fn compute_environment(
    gpu: &Gpu,
    environment: &Environment,
    quality: &EnvironmentQuality,
) -> Result<PreparedEnvironment, GpuError> {
    prepare::environment(gpu, environment, quality)
}

/// [`prepare_lobes`] without the cache: computed.
///
/// # Errors
/// When the device is out of memory or lost.
pub fn compute_lobes(gpu: &Gpu, quality: &EnvironmentQuality) -> Result<Vec<u8>, GpuError> {
    prepare::lobes(gpu, quality)
}

/// Texels of the table of lobes, from the device's cache folder or computed: `table_px` columns of cosines, four sheets
/// (GGX, then the models of sheen) of `table_px` rows of roughness, each four half floats (`environment_table_uv`).
///
/// # Errors
/// When the device is out of memory or lost.
pub fn prepare_lobes(gpu: &Gpu, quality: &EnvironmentQuality) -> Result<Vec<u8>, GpuError> {
    // What makes the table depends on its size alone.
    let own = EnvironmentQuality { table_px: quality.table_px, ..EnvironmentQuality::default() };
    let bytes = own.table_size().iter().product::<u32>() as usize * 8;
    let decode = |file: &[u8]| (file.len() == bytes).then(|| file.to_vec());
    cache::cached(gpu, "lobes", 0, &own, decode, Vec::clone, || compute_lobes(gpu, &own))
}
