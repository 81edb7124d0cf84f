//! How wrong a picture is.

use glam::{DVec3, DVec4};
use nv_flip::{DEFAULT_PIXELS_PER_DEGREE, FlipImageRgb8, FlipPool};

use crate::math::srgb_from_linear;
use crate::measure::twin::tone_mapping;
use crate::render::Picture;

/// Keeps dark pixels from counting without bound: the square of a tenth of the white level.
const FLOOR: f64 = 0.01;

/// A picture as the metrics see it: premultiplied linear RGB and coverage, rows from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct Radiance {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// One value a pixel.
    pub pixels: Vec<DVec4>,
}

impl Radiance {
    /// Of a picture that kept its radiance.
    pub fn of(picture: &Picture) -> Self {
        Self { size: picture.size, pixels: picture.radiance.iter().map(|pixel| pixel.as_dvec4()).collect() }
    }
}

/// Error of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PictureError {
    /// Mean of (I - R)^2 / (R^2 + 0.01) in linear light before the tone curve, over the channels of all pixels that
    /// either picture covers (Rousselle et al. 2011, "Adaptive Sampling and Reconstruction using Greedy Error
    /// Minimization").
    pub relmse: f64,
    /// Mean of FLIP over all pixels of the display pictures (Andersson et al. 2020, "FLIP: A Difference Evaluator for
    /// Alternating Images").
    pub flip: f64,
}

/// Error of a picture against its reference of the same size; `background` is linear light that stands behind both.
pub fn picture_error(picture: &Radiance, reference: &Radiance, background: DVec3) -> PictureError {
    let display = |radiance: &Radiance| shown(radiance.pixels.iter().map(|pixel| displayed(*pixel, background)));
    PictureError {
        relmse: relmse(picture.pixels.iter().zip(&reference.pixels).map(|(i, r)| (*i - *r, *i, *r))),
        flip: flip(reference.size, &display(reference), &display(picture)),
    }
}

/// Error of the CHANGE from one frame to the next against the reference's: what shimmers, though each frame may be
/// right. relMSE keeps the brightness of the first reference frame in its denominator; FLIP sees the changes of the
/// display pictures drawn around mid grey.
pub fn change_error(picture: [&Radiance; 2], reference: [&Radiance; 2], background: DVec3) -> PictureError {
    let pairs = |[a, b]: [&Radiance; 2]| -> Vec<(DVec4, DVec4)> {
        a.pixels.iter().copied().zip(b.pixels.iter().copied()).collect()
    };
    let (picture, first) = (pairs(picture), reference[0]);
    let reference = pairs(reference);
    let relative = relmse(
        picture.iter().zip(&reference).map(|((i0, i1), (r0, r1))| ((*i1 - *i0) - (*r1 - *r0), i0.max(*i1), *r0)),
    );
    let display = |frames: &[(DVec4, DVec4)]| {
        shown(frames.iter().map(|(a, b)| 0.5 + 0.5 * (displayed(*b, background) - displayed(*a, background))))
    };
    PictureError { relmse: relative, flip: flip(first.size, &display(&reference), &display(&picture)) }
}

/// What a reference's own noise adds to a relMSE; `variance` is that of each pixel's mean.
pub fn noise(reference: &Radiance, variance: &[DVec3]) -> f64 {
    let deviation = |variance: &DVec3| variance.max(DVec3::ZERO).powf(0.5).extend(0.0);
    relmse(reference.pixels.iter().zip(variance).map(|(pixel, variance)| (deviation(variance), *pixel, *pixel)))
}

/// Of (error, picture, reference) a pixel.
fn relmse(pixels: impl Iterator<Item = (DVec4, DVec4, DVec4)>) -> f64 {
    let (mut sum, mut count) = (0.0, 0u64);
    for (error, _, reference) in pixels.filter(|(_, picture, reference)| picture.w > 0.0 || reference.w > 0.0) {
        let (error, reference) = (error.truncate(), reference.truncate());
        sum += (error * error / (reference * reference + FLOOR)).element_sum();
        count += 3;
    }
    if count == 0 { 0.0 } else { sum / count as f64 }
}

/// Display colour of a pixel over a background, sRGB-coded, in [0, 1].
fn displayed(pixel: DVec4, background: DVec3) -> DVec3 {
    let light = pixel.truncate() + background * (1.0 - pixel.w).max(0.0);
    let code = |linear: f64| f64::from(srgb_from_linear(linear.clamp(0.0, 1.0) as f32));
    let curved = tone_mapping::neutral(light);
    DVec3::new(code(curved.x), code(curved.y), code(curved.z))
}

fn shown(colors: impl Iterator<Item = DVec3>) -> Vec<u8> {
    colors.flat_map(|color| color.to_array().map(|channel| (channel * 255.0).round() as u8)).collect()
}

fn flip([width, height]: [u32; 2], reference: &[u8], picture: &[u8]) -> f64 {
    let image = |rgb| FlipImageRgb8::with_data(width, height, rgb);
    let difference = nv_flip::flip(image(reference), image(picture), DEFAULT_PIXELS_PER_DEGREE);
    f64::from(FlipPool::from_image(&difference).mean())
}
