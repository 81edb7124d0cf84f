//! Prepared environments as images that shaders sample.

use super::{EnvironmentQuality, PreparedEnvironment, SH_COEFFICIENTS, prepare_environment, prepare_lobes};
use crate::asset::Environment;
use crate::gpu::{Gpu, GpuError, Image, Sampler, SamplerDesc, format_bytes, level_size};
use crate::render::renderer::filled_image;
use ash::vk;
use glam::Vec3;
use std::sync::Arc;

/// Every device filters it (Vulkan 1.3, "Required Format Support").
pub(in crate::render) const FORMAT: vk::Format = vk::Format::R16G16B16A16_SFLOAT;
/// Name of the cube on the device.
const MAP_NAME: &str = "environment";
/// Name of the table of lobes on the device.
const LOBES_NAME: &str = "lobes";

/// An environment on the device.
pub struct EnvironmentMaps {
    /// What it was made of; a host's own maps were made of nothing that is known here.
    made_of: Option<(Arc<Environment>, EnvironmentQuality)>,
    /// Radiance over `scale`; level by level spread by rougher lobes.
    pub map: Image,
    /// Of the map.
    pub sampler: Sampler,
    /// Linear RGB radiance of a texel of 1.
    pub scale: Vec3,
    /// Number of the last level.
    pub last_level: u32,
    /// Linear RGB radiance, orthonormal real spherical harmonics, coefficient l * l + l + m.
    pub harmonics: [Vec3; SH_COEFFICIENTS],
}

impl EnvironmentMaps {
    /// Makes them, from the device's cache folder where they are there.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn new(gpu: &Gpu, environment: &Arc<Environment>, quality: EnvironmentQuality) -> Result<Self, GpuError> {
        let prepared = prepare_environment(gpu, environment, &quality)?;
        let last_level = prepared.last_level();
        let PreparedEnvironment { face_px, levels, scale, harmonics } = prepared;
        let map = sampled_image(gpu, MAP_NAME, [face_px; 2], true, &levels)?;
        let sampler = gpu.sampler(&SamplerDesc { wrap: CLAMPED, ..SamplerDesc::default() })?;
        let made_of = Some((environment.clone(), quality));
        Ok(Self { made_of, map, sampler, scale, last_level, harmonics })
    }

    /// Takes what a host has made by itself.
    ///
    /// # Errors
    /// [`GpuError::Range`] for an image that is no cube or has no level; what the driver answers.
    pub fn from_host(gpu: &Gpu, host: HostEnvironment) -> Result<Self, GpuError> {
        let HostEnvironment { map, scale, harmonics } = host;
        let Some(last_level) = map.mip_levels().checked_sub(1).filter(|_| map.is_cube()) else {
            let problem = "an environment is a cube of at least one level".to_owned();
            return Err(GpuError::Range { name: map.name().to_owned(), problem });
        };
        let sampler = gpu.sampler(&SamplerDesc { wrap: CLAMPED, ..SamplerDesc::default() })?;
        Ok(Self { made_of: None, map, sampler, scale, last_level, harmonics })
    }

    /// Whether they are those of that environment.
    pub fn are_of(&self, environment: &Arc<Environment>, quality: EnvironmentQuality) -> bool {
        self.made_of.as_ref().is_some_and(|(known, made)| *made == quality && is_same(known, environment))
    }

    /// Mean radiance of all directions.
    pub fn mean_radiance(&self) -> Vec3 {
        // Harmonic 0 is the root of 1 / 4 pi.
        self.harmonics[0] * 0.282_094_8
    }
}

/// A prefiltered environment of the host's.
pub struct HostEnvironment {
    /// Cube in shader-read layout: level l of `last` holds radiance over `scale`, spread by a GGX lobe that is seen from the
    /// front, of perceptual roughness l / last.
    pub map: Image,
    /// Linear RGB radiance of a texel of 1.
    pub scale: Vec3,
    /// Linear RGB radiance in orthonormal real spherical harmonics, coefficient `l * l + l + m`, z the polar axis
    /// (`environment_sh`).
    pub harmonics: [Vec3; SH_COEFFICIENTS],
}

/// The table of prefiltered lobe directions and roughness on the device.
pub struct LobeTable {
    nodes: u32,
    /// Four sheets below each other.
    pub map: Image,
    /// Of the map.
    pub sampler: Sampler,
}

impl LobeTable {
    /// Makes it, from the device's cache folder where it is there.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn new(gpu: &Gpu, quality: &EnvironmentQuality) -> Result<Self, GpuError> {
        let texels = prepare_lobes(gpu, quality)?;
        let map = sampled_image(gpu, LOBES_NAME, quality.table_size(), false, &[&texels])?;
        let sampler = gpu.sampler(&SamplerDesc { wrap: CLAMPED, max_lod: 0.25, ..SamplerDesc::default() })?;
        Ok(Self { nodes: quality.table_px, map, sampler })
    }

    /// Whether it is of that size.
    pub fn is_of(&self, quality: &EnvironmentQuality) -> bool {
        self.nodes == quality.table_px
    }
}

/// Bytes on the device, by name: the cube, and the table where it is bound.
pub fn environment_bytes(
    environment: &Environment,
    quality: &EnvironmentQuality,
    binds_lobes: bool,
) -> impl Iterator<Item = (&'static str, u64)> {
    let (face_px, last_level) = quality.cube_of(environment);
    let face = |level| format_bytes(FORMAT, level_size([face_px; 2], level)).unwrap_or(0);
    let cube = (0..=last_level).map(|level| 6 * face(level)).sum();
    let table = binds_lobes.then(|| (LOBES_NAME, format_bytes(FORMAT, quality.table_size()).unwrap_or(0)));
    [(MAP_NAME, cube)].into_iter().chain(table)
}

/// Whether two stand for the same light; texels are compared only where they are not shared.
pub(in crate::render) fn is_same(one: &Arc<Environment>, other: &Arc<Environment>) -> bool {
    Arc::ptr_eq(one, other) || one == other
}

const CLAMPED: [vk::SamplerAddressMode; 2] = [vk::SamplerAddressMode::CLAMP_TO_EDGE; 2];

pub(in crate::render) fn sampled_image(
    gpu: &Gpu,
    name: &str,
    size: [u32; 2],
    is_cube: bool,
    levels: &[impl AsRef<[u8]>],
) -> Result<Image, GpuError> {
    let mut upload = gpu.upload();
    let image = filled_image(gpu, &mut upload, name, size, FORMAT, is_cube, levels)?;
    upload.finish()?;
    Ok(image)
}
