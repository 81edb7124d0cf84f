//! Judges `shadow.glsl`.

use super::super::domain::{ALMOST_ONE, Domain, UNIT};
use super::super::twin::{Rule, Twin};
use crate::material::reference::shadow;

/// Metres, or texels.
const REACH: Domain = Domain::Log(1e-6, 1e3, &[0.0, 1e-30, 1.0, 1e30]);
const COSINE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, -1e-7, 0.0, 1e-40, 0.5, 1.0]);
/// Texels.
const DISTANCE: Domain = Domain::Uniform(-4.0, 4.0, &[-3.0, -1.0, 0.0, 1e-40, 1.0, 2.0, 1e30]);
/// Of a map, reversed.
const DEPTH: Domain = Domain::Uniform(0.0, 1.0, &[0.0, 1e-7, 0.5, ALMOST_ONE, 1.0]);
const OPTICAL_DEPTH: Domain = Domain::Log(1e-4, 64.0, &[0.0, 1e-30, 1.0, 16.0, 6e4]);
const PLACE: Domain = Domain::Uniform(-0.5, 1.5, &[-1e6, 0.0, 0.01, 0.5, 1.0, 1e6]);

pub(super) const TWINS: &[Twin] = &[
    // 1 - c^2 loses what c is rounded by.
    Twin::new("shadow_normal_step", &[REACH, COSINE], |given| {
        vec![shadow::normal_step(given.number(), given.number())]
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("shadow_filter_weight", &[DISTANCE, Domain::Uniform(1.0, 3.0, &[1.0, 2.0, 3.0])], |given| {
        vec![shadow::filter_weight(given.number(), given.number())]
    }),
    Twin::new("shadow_passed", &[DEPTH, DEPTH], |given| vec![f64::from(u8::from(given.number() <= given.number()))]),
    Twin::new("shadow_optical_depth", &[UNIT], |given| shadow::optical_depth(given.vec3()).to_array().to_vec())
        // Vulkan has the logarithm within 2^-21 where it is near 0.
        .limit(2e-5, 2e-6),
    Twin::new("shadow_place", &[DEPTH, DEPTH, DEPTH], |given| {
        vec![shadow::place(given.number(), given.number(), given.number())]
    })
    // The difference of two depths decides.
    .rule(Rule::Conditioned(2)),
    Twin::new("shadow_layers", &[OPTICAL_DEPTH, PLACE], |given| {
        shadow::layers(given.number(), given.number()).to_vec()
    })
    .rule(Rule::Stepped(1)),
    Twin::new("shadow_crossed", &[OPTICAL_DEPTH, OPTICAL_DEPTH, PLACE], |given| {
        let depths = std::array::from_fn(|_| given.number());
        vec![shadow::crossed(depths, given.number(), given.number())]
    })
    // Steps at both ends, and differences of collected depths between them.
    .rule(Rule::Conditioned(4))
    .limit(2e-5, 2e-6),
];
