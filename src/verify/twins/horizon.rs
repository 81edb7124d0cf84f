//! Judges `horizon.glsl`.

use super::super::domain::Domain;
use super::super::twin::{Rule, Twin};
use crate::material::reference::horizon;
use std::f32::consts::{FRAC_PI_2, PI};

/// Radians.
const NORMAL_ANGLE: Domain = Domain::Uniform(-FRAC_PI_2, FRAC_PI_2, &[-FRAC_PI_2, -1e-4, 0.0, 1e-40, FRAC_PI_2]);
const ELEVATION: Domain = Domain::Uniform(0.0, PI, &[0.0, 1e-40, 1e-4, FRAC_PI_2, PI]);
/// A coordinate, in any unit.
const PLACE: Domain = Domain::Uniform(-10.0, 10.0, &[-10.0, -1e-7, 0.0, 1.0, 1e15]);
/// Of a slice that is not seen edge on.
const WEIGHT: Domain = Domain::Log(1e-6, 1.0, &[1e-6, 1.0]);

pub(super) const TWINS: &[Twin] = &[
    // Vulkan 1.3, "Precision of core SPIR-V Instructions", leaves
    // atan 4096 units in the last place; the angle feeds sines that are as smooth as it.
    Twin::new("horizon_slice", &[Domain::Direction, Domain::Direction, Domain::Direction], |given| {
        let slice = horizon::slice(given.vec3(), given.vec3(), given.vec3());
        [&slice.tangent.to_array()[..], &[slice.normal_angle, slice.weight]].concat()
    })
    .limit(1e-5, 1e-5)
    .rule(Rule::Conditioned(4)),
    // What lies beyond the eye's direction steps from all to nothing where it crosses the tangent plane.
    Twin::new("horizon_elevation", &[PLACE, Domain::Direction, Domain::Direction, WEIGHT, ELEVATION], |given| {
        let (to_sample, normal, tangent) = (given.vec3(), given.vec3(), given.vec3());
        vec![horizon::elevation(to_sample, normal, tangent, given.number(), given.number())]
    })
    .limit(1e-5, 1e-5)
    .rule(Rule::Stepped(4)),
    Twin::new("horizon_arc", &[ELEVATION, NORMAL_ANGLE], |given| vec![horizon::arc(given.number(), given.number())]),
    Twin::new(
        "horizon_falloff",
        &[Domain::Log(1e-9, 1e9, &[0.0, 1e-30, 1.0, 1e30]), Domain::Log(1e-3, 1e3, &[1e-3, 1.0, 1e3])],
        |given| vec![horizon::falloff(given.number(), given.number())],
    ),
];
