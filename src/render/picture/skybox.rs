//! The background of a picture where nothing was drawn: the skybox, on the device and on the host alike.

use crate::asset::Environment;
use crate::gpu::{Gpu, GpuError, Image, Sampler, SamplerDesc, format_bytes};
use crate::render::light::{LARGEST_TEXEL, RADIANCE_FORMAT as FORMAT, halves, is_same, sampled_image};
use crate::scene::{Camera, EnvironmentLight};
use ash::vk;
use glam::{Mat3, Vec3, Vec4};
use std::sync::Arc;

/// Name of the picture on the device.
const NAME: &str = "skybox";

/// The environment behind a picture, by pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct Skybox {
    environment: EnvironmentLight,
    /// From the eye, in the environment's axes, through the top left corner of the picture. Any length.
    pub(in crate::render) corner: Vec3,
    /// From one pixel to the next on its right.
    pub(in crate::render) right: Vec3,
    /// To the one below.
    pub(in crate::render) down: Vec3,
}

impl Skybox {
    /// What `camera` sees of the environment in a picture of `size` pixels. To parallel rays all of it is one direction.
    pub fn new(environment: &EnvironmentLight, camera: &Camera, size: [u32; 2]) -> Self {
        let axes =
            Mat3::from_rotation_y(-environment.rotation_deg.to_radians()) * Mat3::from_mat4(camera.world_from_camera);
        let projection = camera.clip_from_camera;
        let [corner, right, down] = if camera.is_orthographic {
            [Vec3::NEG_Z, Vec3::ZERO, Vec3::ZERO]
        } else {
            // clip = projection * (x, y, z, 1) with w = -z: the ray of a place in [-1, 1] at z = -1.
            let ray = |x: f32, y: f32| {
                let (x, y) = (x + projection.z_axis.x, y + projection.z_axis.y);
                Vec3::new(x / projection.x_axis.x, y / projection.y_axis.y, -1.0)
            };
            let pixel = size.map(|side| 2.0 / side as f32);
            let corner = ray(-1.0, 1.0);
            [corner, ray(-1.0 + pixel[0], 1.0) - corner, ray(-1.0, 1.0 - pixel[1]) - corner]
        };
        Self { environment: environment.clone(), corner: axes * corner, right: axes * right, down: axes * down }
    }

    /// Linear RGB radiance at the middle of a pixel, columns and rows from the top left.
    pub fn radiance(&self, x: u32, y: u32) -> Vec3 {
        let ray = self.corner + self.right * (x as f32 + 0.5) + self.down * (y as f32 + 0.5);
        self.environment.map.radiance(ray) * self.environment.strength
    }
}

/// An environment as a picture to look at: sharper than the cube, which is made to be blurred.
pub struct SkyboxImage {
    environment: Arc<Environment>,
    /// Radiance over `scale`, equirectangular.
    pub map: Image,
    /// Goes around, and ends at the poles.
    pub sampler: Sampler,
    /// Radiance of a texel of 1.
    pub scale: f32,
}

impl SkyboxImage {
    /// Makes it.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn new(gpu: &Gpu, environment: &Arc<Environment>) -> Result<Self, GpuError> {
        let largest = environment.texels.iter().flatten().fold(0.0, |largest: f32, channel| largest.max(*channel));
        let scale = if largest > 0.0 { largest / LARGEST_TEXEL } else { 1.0 };
        let texel = |texel: &[f32; 3]| halves((Vec3::from_array(*texel) / scale).extend(1.0));
        let bytes: Vec<u8> = environment.texels.iter().flat_map(texel).collect();
        let map = sampled_image(gpu, NAME, environment.size, false, &[&bytes])?;
        let wrap = [vk::SamplerAddressMode::REPEAT, vk::SamplerAddressMode::CLAMP_TO_EDGE];
        let sampler = gpu.sampler(&SamplerDesc { wrap, max_lod: 0.25, ..SamplerDesc::default() })?;
        Ok(Self { environment: environment.clone(), map, sampler, scale })
    }

    /// Whether it is that environment's.
    pub fn is_of(&self, environment: &Arc<Environment>) -> bool {
        is_same(&self.environment, environment)
    }
}

/// Bytes of the picture on the device, by its name.
pub fn skybox_bytes(environment: &Environment) -> (&'static str, u64) {
    (NAME, format_bytes(FORMAT, environment.size).unwrap_or(0))
}

/// The background of a picture, linear RGB.
#[derive(Debug, Clone, PartialEq)]
pub enum PictureBackground {
    /// Nothing.
    Transparent,
    /// The same everywhere.
    Color(Vec3),
    /// The environment.
    Environment(Skybox),
}

impl PictureBackground {
    /// Premultiplied colour and opacity at a pixel.
    pub fn at(&self, x: u32, y: u32) -> Vec4 {
        match self {
            Self::Transparent => Vec4::ZERO,
            Self::Color(color) => color.extend(1.0),
            Self::Environment(skybox) => skybox.radiance(x, y).extend(1.0),
        }
    }
}
