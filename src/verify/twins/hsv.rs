//! Judges `hsv.glsl`.

use super::super::domain::{Domain, UNIT};
use super::super::twin::{Rule, Twin};
use crate::material::reference::hsv;

pub(super) const TWINS: &[Twin] = &[
    Twin::new("rgb_from_hsv", &[Domain::Uniform(-1.0, 7.0, &[-1.0, 0.0, 1e-40, 0.5, 1.0, 7.0])], |given| {
        // The components share one domain; saturation and value are meant in [0, 1] and nothing here needs it.
        hsv::rgb_from_hsv(given.vec3()).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
    // Which channel is largest, and on which side of red a hue falls, is a matter of rounding.
    Twin::new("hsv_from_rgb", &[UNIT], |given| hsv::hsv_from_rgb(given.vec3()).to_array().to_vec())
        .rule(Rule::Stepped(2)),
];
