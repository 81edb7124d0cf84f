//! Judges `laser.glsl`.

use super::super::domain::{Domain, UNIT};
use super::super::twin::{Rule, Twin};
use crate::material::reference::laser;

/// Turns.
const PHASE: Domain = Domain::Uniform(0.0, 7.0, &[0.0, 1e-40, 1.0, 7.0]);
/// Turns from one pixel to the next.
const CHANGE: Domain = Domain::Log(1e-4, 10.0, &[0.0, 1e-40, 0.5, 1e30]);

pub(super) const TWINS: &[Twin] = &[
    Twin::new("laser_angle_along", &[Domain::Above, Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1.0])], |given| {
        laser::angle_along(given.vec3(), given.vec2()).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("laser_curve", &[UNIT, Domain::Choice(&[0, 1])], |given| {
        vec![laser::curve(given.vec2(), given.uint() != 0)]
    }),
    Twin::new("laser_wheel", &[PHASE, CHANGE, UNIT, UNIT], |given| {
        laser::wheel(given.number(), given.number(), given.number(), given.number()).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("laser_ramp", &[UNIT, Domain::Uniform(0.0, 2.0, &[0.0, 1.0, 2.0]), UNIT, UNIT], |given| {
        laser::ramp(given.vec3(), given.number(), given.number(), given.number()).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
];
