//! Judges `environment_lobe.glsl`.

use super::super::domain::{ALPHA, Domain};
use super::super::twin::{Given, Rule, Twin};
use crate::material::reference::environment_lobe::{axis, normal, roughness, spread};

/// Middles of shares, of up to a hundred taps.
const SHARE: Domain = Domain::Uniform(0.005, 0.995, &[0.005, 0.5, 0.995]);

fn alpha(given: &mut Given<'_>) -> (f64, f64) {
    (given.number(), given.number())
}

pub(super) const TWINS: &[Twin] = &[
    Twin::new("environment_tap_spread", &[ALPHA], |given| vec![spread(alpha(given))]).rule(Rule::Conditioned(2)),
    Twin::new("environment_tap_roughness", &[ALPHA, Domain::Choice(&[0, 1, 3, 7, 64])], |given| {
        vec![roughness(alpha(given), given.uint())]
    }),
    // Where the eye grazes, the normal is a difference of what is nearly equal: the rounding of its lean is that of the
    // products, some units of the last place of 1.
    Twin::new("environment_tap_normal", &[Domain::Above, ALPHA, SHARE], |given| {
        normal(given.vec3(), alpha(given), given.number()).to_array().to_vec()
    })
    .limit(2e-5, 2e-6)
    .rule(Rule::Conditioned(4)),
    Twin::new(
        "environment_tap_axis",
        &[Domain::Above, Domain::Above, Domain::Uniform(-0.5, 1.0, &[-0.5, 0.0, 1.0])],
        |given| axis(given.vec3(), given.vec3(), given.number()).to_array().to_vec(),
    )
    // A mirror at the horizon of its normal: the root of a difference near 0.
    .limit(2e-5, 1e-6)
    .rule(Rule::Conditioned(4)),
];
