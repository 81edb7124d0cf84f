//! Twin of `color.glsl`: sRGB transfer function (IEC 61966-2-1) and Rec. 709 luminance.

use super::Twin;
use super::domain::{ALMOST_ONE, Domain, UNIT};
use glam::DVec3;

/// Linear from sRGB-coded, one channel, [0, 1].
pub fn linear_from_srgb(coded: f64) -> f64 {
    if coded <= 0.04045 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }
}

/// sRGB-coded from linear, one channel, [0, 1].
pub fn srgb_from_linear(linear: f64) -> f64 {
    if linear <= 0.0031308 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

/// Luminance of a linear Rec. 709 colour.
pub fn luminance(color: DVec3) -> f64 {
    color.dot(DVec3::new(0.2126, 0.7152, 0.0722))
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new(
        "linear_from_srgb",
        &[Domain::Uniform(0.0, 1.0, &[0.0, 1e-40, 0.04045, 0.040451, ALMOST_ONE, 1.0])],
        |inputs| inputs.vec3().to_array().map(linear_from_srgb).to_vec(),
    ),
    Twin::new("srgb_from_linear", &[UNIT], |inputs| inputs.vec3().to_array().map(srgb_from_linear).to_vec()),
    Twin::new("luminance", &[Domain::Log(1e-6, 1e6, &[0.0, 1e-40, 1.0, 1e30])], |inputs| {
        vec![luminance(inputs.vec3())]
    }),
];
