//! Pictures of the limit, and how noisy they are.

use super::OracleError;
use super::ray::Eye;
use super::shade::Shading;
use super::stage::Stage;
use crate::measure::twin::albedo::Fit;
use crate::measure::twin::hash::pcg3d;
use crate::scene::{Camera, Lighting, Pose, Scene};
use glam::{DVec2, DVec3, DVec4};
use rayon::prelude::*;

/// How a reference is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OracleOptions {
    /// Pixels: width, height; each at least 1.
    pub size: [u32; 2],
    /// Samples a pixel, an even number of at least 2: two in each stratum of the pixel, whose area counts evenly (box
    /// filter).
    pub samples: u32,
    /// Chooses where in the strata they lie.
    pub seed: u32,
}

/// A reference.
#[derive(Debug, Clone, PartialEq)]
pub struct OraclePicture {
    /// Pixels: width, height.
    pub size: [u32; 2],
    /// Linear RGB radiance, premultiplied, and coverage; rows from the top. The background is nothing: 0.
    pub radiance: Vec<DVec4>,
    /// Estimated variance of each pixel's radiance, that is of the mean of its samples.
    pub variance: Vec<DVec3>,
}

impl OraclePicture {
    /// What the noise alone adds to an error that is given as relMSE: the mean over pixels and channels of
    /// `variance / (radiance^2 + 0.01)`.
    pub fn noise_relmse(&self) -> f64 {
        let noise = |(radiance, variance): (&DVec4, &DVec3)| {
            (*variance / (radiance.truncate() * radiance.truncate() + 0.01)).element_sum() / 3.0
        };
        self.radiance.iter().zip(&self.variance).map(noise).sum::<f64>() / self.radiance.len() as f64
    }
}

/// Renders a scene with fur of infinitely many layers. The same arguments give the same bits on any number of threads.
///
/// # Errors
/// [`OracleError::Size`] and [`OracleError::Samples`] for options that make no picture, [`OracleError::Unsupported`] for
/// fur without a limit (`blend`, `edge_fade`, `tip_fade`) and for features that the oracle lacks.
pub fn render(
    scene: &Scene,
    scene_index: usize,
    pose: &Pose,
    camera: &Camera,
    lighting: &Lighting,
    variant: Option<usize>,
    options: &OracleOptions,
) -> Result<OraclePicture, OracleError> {
    let OracleOptions { size: [width, height], samples, .. } = *options;
    if width == 0 || height == 0 {
        return Err(OracleError::Size { width, height });
    }
    if samples < 2 || !samples.is_multiple_of(2) {
        return Err(OracleError::Samples { samples });
    }
    let Some(ambient_radiance) = lighting.environment.constant_radiance() else {
        return Err(OracleError::EnvironmentLight { name: lighting.environment.map.name.clone() });
    };
    let stage = Stage::new(scene, scene_index, pose, variant)?;
    let shading = Shading {
        lights: &lighting.lights,
        ambient_radiance: ambient_radiance.as_dvec3(),
        eye: Eye::new(camera),
        fit: Fit::shipped(),
    };
    let rows: Vec<Vec<(DVec4, DVec3)>> = (0..height)
        .into_par_iter()
        .map(|y| (0..width).map(|x| pixel(&stage, &shading, [x, y], options)).collect())
        .collect();
    let (radiance, variance) = rows.into_iter().flatten().unzip();
    Ok(OraclePicture { size: options.size, radiance, variance })
}

/// Mean radiance and coverage of a pixel, and the variance of that mean.
fn pixel(stage: &Stage, shading: &Shading, [x, y]: [u32; 2], options: &OracleOptions) -> (DVec4, DVec3) {
    let [width, height] = options.size;
    let [columns, rows] = strata(options.samples / 2);
    let count = f64::from(options.samples);
    let (mut sum, mut variance) = (DVec4::ZERO, DVec3::ZERO);
    for stratum in 0..columns * rows {
        let corner = DVec2::new(f64::from(stratum % columns), f64::from(stratum / columns));
        let pair = [0, 1].map(|of_pair| {
            let [right, down, _] = pcg3d([y * width + x, 2 * stratum + of_pair, options.seed]);
            let jitter = DVec2::new(f64::from(right), f64::from(down)) / 4_294_967_296.0;
            let in_pixel = (corner + jitter) / DVec2::new(f64::from(columns), f64::from(rows));
            let place =
                (DVec2::new(f64::from(x), f64::from(y)) + in_pixel) / DVec2::new(f64::from(width), f64::from(height));
            let ray = shading.eye.ray(DVec2::new(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y));
            stage.first(&ray).map_or(DVec4::ZERO, |met| shading.radiance(stage, &ray, &met).extend(1.0))
        });
        sum += pair[0] + pair[1];
        // Two samples of a stratum tell its variance, (a - b)^2 / 2, without bias; it counts twice in the sum.
        let difference = (pair[0] - pair[1]).truncate();
        variance += difference * difference;
    }
    (sum / count, variance / (count * count))
}

/// Columns and rows of so many strata, as square as they divide.
fn strata(count: u32) -> [u32; 2] {
    let mut rows = count.isqrt();
    while !count.is_multiple_of(rows) {
        rows -= 1;
    }
    [count / rows, rows]
}
