//! Judges `sway.glsl`. A step is exact in the energy norm: to 1e-6 a radian, at least one, of the norms at its start, of
//! the root and at its end together.

use super::super::domain::{ALMOST_ONE, Domain};
use super::super::twin::{Given, Rule, Twin};
use crate::material::reference::sway::{self, State};
use glam::DVec3;

/// A component of a lag, metres, or of a velocity, metres a second.
const VECTOR: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-40, 1e-7, 1.0]);
const STEP_S: Domain = Domain::Log(1e-4, 0.1, &[1e-4, 0.1]);
const STIFFNESS: Domain = Domain::Log(1e-2, 1e8, &[1e-2, 400.0, 1e8]);
/// Length of a strand, metres.
const REACH: Domain = Domain::Log(1e-3, 1.0, &[1e-3, 1.0]);
/// And what is none.
const NUMBERS: Domain = Domain::Uniform(-1.0, 1.0, &[0.0, 1e-40, f32::MAX, f32::INFINITY, f32::NEG_INFINITY, f32::NAN]);
/// Angular frequency, the root of the stiffness.
const FREQUENCY: Domain = Domain::Log(0.1, 1e4, &[0.1, 20.0, 1e4]);
const UNDER: Domain = Domain::Uniform(0.0, ALMOST_ONE, &[0.0, 1e-40, 1e-7, 0.5, ALMOST_ONE]);
const OVER: Domain = Domain::Log(1.0, 1e4, &[1.0, 1.0 + f32::EPSILON, 1e4]);
const ANY: Domain = Domain::Log(1e-2, 1e4, &[0.0, 1e-40, 0.25, ALMOST_ONE, 1.0, 1.0 + f32::EPSILON, 1e4]);

fn state(given: &mut Given) -> State {
    State { lag: given.vec3(), velocity: given.vec3() }
}

fn flat(state: State) -> Vec<f64> {
    [state.lag.to_array(), state.velocity.to_array()].concat()
}

/// By angular frequency and the root's velocity.
fn one_branch(given: &mut Given) -> Vec<f64> {
    let (state, root_velocity): (State, DVec3) = (state(given), given.vec3());
    let (dt, w, zeta) = (given.number(), given.number(), given.number());
    flat(sway::free_or_driven(state, root_velocity, dt, w, zeta))
}

/// What the energy norm allows of a lag and of a velocity.
fn in_norm(state: State, root_velocity: DVec3, dt: f64, w: f64, zeta: f64) -> Vec<f64> {
    let end = sway::free_or_driven(state, root_velocity, dt, w, zeta);
    let norm = state.energy_norm(w * w) + root_velocity.length() + end.energy_norm(w * w);
    let error = 1e-6 * (w * dt).max(1.0) * norm;
    [[error / w; 3], [error; 3]].concat()
}

fn of_branch(given: &mut Given) -> Vec<f64> {
    let (state, root_velocity) = (state(given), given.vec3());
    in_norm(state, root_velocity, given.number(), given.number(), given.number())
}

fn of_step(given: &mut Given) -> Vec<f64> {
    let (state, moved) = (state(given), given.vec3());
    let (dt, stiffness, zeta) = (given.number(), given.number(), given.number());
    in_norm(state, moved / dt, dt, stiffness.sqrt(), zeta)
}

pub(super) const TWINS: &[Twin] = &[
    Twin::new("sway_decay_mean", &[Domain::Log(1e-6, 1e4, &[0.0, 1e-40, 1.0, 1e30])], |given| {
        vec![sway::decay_mean(given.number())]
    }),
    Twin::new("sway_tangent", &[Domain::Uniform(-0.786, 0.786, &[-0.785, 0.0, 1e-40, 1e-7, 0.785])], |given| {
        vec![given.number().tan()]
    }),
    Twin::new("sway_under_damped", &[VECTOR, VECTOR, VECTOR, STEP_S, FREQUENCY, UNDER], one_branch)
        .limit(0.0, 1e-12)
        .allowance(of_branch),
    Twin::new("sway_over_damped", &[VECTOR, VECTOR, VECTOR, STEP_S, FREQUENCY, OVER], one_branch)
        .limit(0.0, 1e-12)
        .allowance(of_branch),
    Twin::new("sway_is_finite", &[NUMBERS], |given| {
        let numbers = [given.number(), given.number(), given.number()];
        vec![f64::from(u8::from(numbers.iter().all(|number| number.is_finite())))]
    })
    .limit(0.0, 0.0),
    Twin::new("sway_step", &[VECTOR, VECTOR, VECTOR, STEP_S, STIFFNESS, ANY], |given| {
        let (state, moved) = (state(given), given.vec3());
        flat(sway::step(state, moved, given.number(), given.number(), given.number()))
    })
    .limit(0.0, 1e-12)
    .allowance(of_step),
    Twin::new("sway_limited", &[VECTOR, VECTOR, VECTOR, REACH], |given| {
        flat(sway::limited(state(given), given.vec3(), given.number()))
    })
    .rule(Rule::Conditioned(4)),
];
