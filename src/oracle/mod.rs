//! The limit that shells approach: coats ray-cast in double precision on the CPU, from the formulas, sharing no code with
//! the shaders.

use crate::scene::{Camera, Lighting, Pose, Scene};
use glam::{DVec3, DVec4};

/// What is asked of the reference.
#[derive(Debug, Clone, Copy)]
pub struct OracleOptions {
    /// Pixels.
    pub size: [u32; 2],
    /// Samples a pixel.
    pub samples: u32,
    /// Of the sample positions.
    pub seed: u32,
}

/// A reference picture.
#[derive(Debug, Clone)]
pub struct OraclePicture {
    /// Pixels.
    pub size: [u32; 2],
    /// Premultiplied linear RGB and coverage, rows from the top.
    pub radiance: Vec<DVec4>,
    /// Of each pixel's mean.
    pub variance: Vec<DVec3>,
}

impl OraclePicture {
    /// Noise of the picture, as relMSE.
    pub fn noise_relmse(&self) -> f64 {
        0.0
    }
}

/// Why a reference could not be made.
#[derive(Debug, thiserror::Error)]
#[error("the reference could not be made")]
pub struct OracleError;

/// Stand-in until the ray caster is merged: a grey picture.
///
/// # Errors
/// Never.
pub fn render(
    _scene: &Scene,
    _scene_index: usize,
    _pose: &Pose,
    _camera: &Camera,
    _lighting: &Lighting,
    _variant: Option<usize>,
    options: &OracleOptions,
) -> Result<OraclePicture, OracleError> {
    let pixels = options.size[0] as usize * options.size[1] as usize;
    Ok(OraclePicture {
        size: options.size,
        radiance: vec![DVec4::new(0.1, 0.08, 0.05, 1.0); pixels],
        variance: vec![DVec3::ZERO; pixels],
    })
}
