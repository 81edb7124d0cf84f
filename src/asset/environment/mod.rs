//! Light from all around: equirectangular pictures of linear radiance (.hdr and .exr), and the studio that comes along.

mod exr;
mod hdr;
mod reduction;
mod studio;

use super::context::Context;
use super::{AssetError, LoadOptions, uri};
use crate::math::fnv1a;
use glam::Vec3;
use reduction::Reduction;
use std::f32::consts::{PI, TAU};
use std::path::Path;

/// Columns and rows that an environment keeps at most; a larger file is reduced while it is read.
pub const MAX_ENVIRONMENT_SIZE: [u32; 2] = [2048, 1024];

/// Largest radiance that is kept; the sun's disc is about 1.6e9 cd/m2, which is 2e7 where a sunlit white wall is 1.
pub const MAX_RADIANCE: f32 = 1e8;

/// Linear radiance from every direction, as an equirectangular picture.
///
/// Rows run from the top (+Y) to the bottom. Columns run around: the direction (x, y, z) is found at
/// `u = atan2(z, x) / 2 pi + 1/2`, `v = acos(y) / pi`, as glTF viewers have it: an eye at +Z that looks along -Z has
/// u = 1/4 before it and greater u on its right.
#[derive(Debug, Clone, PartialEq)]
pub struct Environment {
    /// For messages and reports: the file's path, or what made it.
    pub name: String,
    /// Columns and rows, at least 1, at most [`MAX_ENVIRONMENT_SIZE`].
    pub size: [u32; 2],
    /// RGB row by row, each in [0, [`MAX_RADIANCE`]].
    pub texels: Vec<[f32; 3]>,
}

impl Environment {
    /// Reads a Radiance picture (.hdr) or an OpenEXR picture (.exr), told apart by content, and what was odd about it, a
    /// line each. A picture above [`MAX_ENVIRONMENT_SIZE`] is reduced by a box filter over solid angle, row by row, so
    /// that its size costs time and no memory. Numbers that are no light are repaired: NaN and negative ones become 0,
    /// those above [`MAX_RADIANCE`] become that.
    ///
    /// # Errors
    /// The file cannot be read, is neither format, is broken or cut off, has no channels of colour or luminance, or
    /// would take more than [`LoadOptions::memory_limit_bytes`].
    pub fn load(path: &Path, options: &LoadOptions) -> Result<(Self, Vec<String>), AssetError> {
        let context = Context::new(path, options);
        let bytes = uri::read_file(path, options.memory_limit_bytes)?;
        context.spend("file", bytes.len() as u64)?;
        let reduction = if exr::is_exr(&bytes) {
            exr::decode(&context, &bytes)?
        } else if hdr::is_hdr(&bytes) {
            hdr::decode(&context, &bytes)?
        } else {
            return Err(context.error("file", "is neither Radiance (.hdr) nor OpenEXR (.exr); convert it"));
        };
        let (size, texels) = reduction.finish(&context);
        Ok((Self { name: path.display().to_string(), size, texels }, context.into_warnings()))
    }

    /// The same linear radiance from everywhere.
    pub fn constant(radiance: Vec3) -> Self {
        Self { name: "constant".to_owned(), size: [1, 1], texels: vec![radiance.to_array()] }
    }

    /// The embedded studio, made by formula: a large soft key light at the upper left behind the camera, a fill on its
    /// right, strips behind the subject that draw its outline, a panel above, a floor that bounces light and dim walls. A
    /// white matt sphere shows about 0.9 where it faces the camera (+Z).
    pub fn studio() -> Self {
        studio::studio()
    }

    /// The radiance of all texels, where they are alike.
    pub fn constant_radiance(&self) -> Option<Vec3> {
        let first = *self.texels.first()?;
        self.texels.iter().all(|texel| *texel == first).then_some(Vec3::from_array(first))
    }

    /// Linear radiance from a direction of any length, bilinear between texels.
    pub fn radiance(&self, direction: Vec3) -> Vec3 {
        let [width, height] = self.size.map(|side| side as i64);
        let polar = direction.x.hypot(direction.z).atan2(direction.y);
        let u = direction.z.atan2(direction.x) / TAU + 0.5;
        let (x, y) = (u * width as f32 - 0.5, polar / PI * height as f32 - 0.5);
        let texel = |dx: i64, dy: i64| {
            let column = (x.floor() as i64 + dx).rem_euclid(width);
            let row = (y.floor() as i64 + dy).clamp(0, height - 1);
            Vec3::from_array(self.texels[(row * width + column) as usize])
        };
        let part = x - x.floor();
        texel(0, 0).lerp(texel(1, 0), part).lerp(texel(0, 1).lerp(texel(1, 1), part), y - y.floor())
    }

    /// Tells environments of different size or texels apart, whatever their names.
    pub fn content_hash(&self) -> u64 {
        fnv1a([bytemuck::bytes_of(&self.size), bytemuck::cast_slice(&self.texels)])
    }
}

/// Unit vector from the subject towards the middle of a texel.
fn direction_of_texel([width, height]: [u32; 2], column: u32, row: u32) -> Vec3 {
    let azimuth = ((column as f32 + 0.5) / width as f32 - 0.5) * TAU;
    let polar = (row as f32 + 0.5) / height as f32 * PI;
    Vec3::new(polar.sin() * azimuth.cos(), polar.cos(), polar.sin() * azimuth.sin())
}
