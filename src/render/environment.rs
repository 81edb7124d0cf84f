//! What an environment is on the device: a cube of prefiltered radiance, and spherical harmonics.

use crate::asset::Environment;
use crate::gpu::{Gpu, GpuError, Image, ImageDesc, Sampler, SamplerDesc};
use ash::vk;
use glam::Vec3;
use std::sync::Arc;

/// Coefficients of bands 0 to 4.
pub const HARMONICS: usize = 25;

/// An environment on the device.
pub struct EnvironmentMaps {
    environment: Arc<Environment>,
    /// Radiance over `scale`; level by level spread by rougher lobes.
    pub map: Image,
    /// Of the map.
    pub sampler: Sampler,
    /// Linear RGB radiance of a texel of 1.
    pub scale: Vec3,
    /// Number of the last level.
    pub last_level: u32,
    /// Linear RGB radiance, orthonormal real spherical harmonics, coefficient l * l + l + m.
    pub harmonics: [Vec3; HARMONICS],
}

impl EnvironmentMaps {
    /// Makes them.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn new(gpu: &Gpu, environment: &Arc<Environment>) -> Result<Self, GpuError> {
        let scale = environment.constant_radiance().unwrap_or(Vec3::ONE);
        let map = gpu.image(&ImageDesc {
            name: "environment",
            size: [1, 1],
            format: vk::Format::R16G16B16A16_SFLOAT,
            mip_levels: 1,
            samples: 1,
            usage: vk::ImageUsageFlags::SAMPLED,
            is_cube: true,
        })?;
        let texels = [half::f16::ONE.to_bits(); 24];
        let mut upload = gpu.upload();
        upload.image(&map, &[bytemuck::cast_slice(&texels)]);
        upload.finish()?;
        let mut harmonics = [Vec3::ZERO; HARMONICS];
        // The constant's coefficient: radiance times the root of 4 pi.
        harmonics[0] = scale * 3.544_907_7;
        let sampler =
            gpu.sampler(&SamplerDesc { wrap: [vk::SamplerAddressMode::CLAMP_TO_EDGE; 2], ..SamplerDesc::default() })?;
        Ok(Self { environment: environment.clone(), map, sampler, scale, last_level: 0, harmonics })
    }

    /// Whether they are those of that environment.
    pub fn are_of(&self, environment: &Arc<Environment>) -> bool {
        Arc::ptr_eq(&self.environment, environment) || *self.environment == **environment
    }
}
