//! Judges `transparency.glsl`.

use super::super::domain::{Domain, UNIT};
use super::super::twin::{Limit, Rule, Twin};
use crate::material::reference::transparency::{
    TRANSMITTANCE_STEPS, attenuation, half_bits, half_value, packed, weight,
};

/// What halves hold: subnormal ones, and the largest that is kept.
const RADIANCE: Domain = Domain::Log(1e-9, 64512.0, &[0.0, 1e-40, 6.1e-5, 1.0, 1.000_488_3, 2048.0, 64512.0]);
const REST: Domain = Domain::Choice(&[0, 1, 16, 31]);
/// A number below the smallest normal one is zero to some devices, and not to a small power.
const COLOR: Domain = Domain::Uniform(0.0, 1.0, &[0.0, 1e-8, 0.5, 1.0]);
/// Distances after which nothing is left, or nothing is lost.
const WAY: Domain = Domain::Log(1e-6, 1e3, &[0.0, 1e-40, 1.0, 1e3]);

pub(super) const TWINS: &[Twin] = &[
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("transparency_half", &[RADIANCE], |given| vec![f64::from(half_bits(given.number()))])
    }
    // Where two halves are equally near.
    .rule(Rule::Stepped(1)),
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("transparency_packed", &[RADIANCE, UNIT, REST], |given| {
            vec![f64::from(packed(given.number(), given.number(), given.uint()))]
        })
    }
    .rule(Rule::Stepped(4)),
    Twin::new("transparency_radiance", &[Domain::Bits], |given| vec![half_value(given.uint() >> 17)]).limit(0.0, 0.0),
    Twin::new("transparency_transmittance", &[Domain::Bits], |given| {
        vec![f64::from(given.uint() >> 5 & 4095) / TRANSMITTANCE_STEPS]
    }),
    Twin::new("transparency_weight", &[UNIT], |given| vec![weight(given.number())]),
    // Vulkan has the logarithm within 2^-21 where it is near 0; the power multiplies it by the way.
    Twin::new("transparency_attenuation", &[COLOR, WAY], |given| {
        attenuation(given.vec3(), given.number()).to_array().to_vec()
    })
    .allowance(|given| {
        let (color, way) = (given.vec3(), given.number());
        (attenuation(color, way) * way * 2f64.powi(-21)).to_array().to_vec()
    }),
];
