//! What an environment is on the device: a cube of prefiltered radiance, spherical harmonics, and the table that says how
//! lobes look into the cube.

mod backdrop;
mod cache;
mod maps;
mod prepare;
mod prepared;
mod quality;

pub use backdrop::{Backdrop, BackdropImage, Behind, backdrop_bytes};
pub use maps::{EnvironmentMaps, LobeTable, environment_bytes};
pub use prepared::{HARMONICS, PreparedEnvironment};
pub use quality::EnvironmentQuality;

use crate::asset::Environment;
use crate::gpu::{Gpu, GpuError};

/// Cube and harmonics of an environment, from the device's cache folder or computed.
///
/// # Errors
/// When the device is out of memory or lost.
pub fn prepare_environment(
    gpu: &Gpu,
    environment: &Environment,
    quality: &EnvironmentQuality,
) -> Result<PreparedEnvironment, GpuError> {
    let make = || prepare::environment(gpu, environment, quality);
    let content = environment.content_hash();
    let (decode, encode) = (PreparedEnvironment::from_bytes, PreparedEnvironment::to_bytes);
    cache::cached(gpu, "environment", content, quality, decode, encode, make)
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
    cache::cached(gpu, "lobes", 0, &own, decode, Vec::clone, || prepare::lobes(gpu, &own))
}
