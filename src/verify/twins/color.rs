//! Judges `color.glsl`.

use super::super::domain::{ALMOST_ONE, Domain, UNIT};
use super::super::twin::Twin;
use crate::material::reference::color;

pub(super) const TWINS: &[Twin] = &[
    Twin::new(
        "linear_from_srgb",
        &[Domain::Uniform(0.0, 1.0, &[0.0, 1e-40, 0.04045, 0.040451, ALMOST_ONE, 1.0])],
        |given| given.vec3().to_array().map(color::linear_from_srgb).to_vec(),
    ),
    Twin::new("srgb_from_linear", &[UNIT], |given| given.vec3().to_array().map(color::srgb_from_linear).to_vec()),
    Twin::new("luminance", &[Domain::Log(1e-6, 1e6, &[0.0, 1e-40, 1.0, 1e30])], |given| {
        vec![color::luminance(given.vec3())]
    }),
];
