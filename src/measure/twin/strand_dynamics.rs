//! Twin of `strand_dynamics.glsl`: the damped oscillator by its characteristic roots, the three cases apart.
//!
//! A step is exact in the energy norm: to 1e-6 a radian, at least one, of the norms at its start, of the root and at its
//! end together.

use super::domain::{ALMOST_ONE, Domain};
use super::{Rule, TestInputs, Twin};
use glam::DVec3;

/// Longest step, seconds.
pub const LONGEST_STEP_S: f64 = 0.1f32 as f64;

/// The tip of a strand.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct State {
    /// From where it rests, metres.
    pub lag: DVec3,
    /// Metres a second.
    pub velocity: DVec3,
}

impl State {
    /// Length of (w lag, velocity): the square root of twice the energy for each unit of mass.
    pub fn energy_norm(self, stiffness: f64) -> f64 {
        (stiffness * self.lag.length_squared() + self.velocity.length_squared()).sqrt()
    }

    fn is_finite(self) -> bool {
        self.lag.is_finite() && self.velocity.is_finite()
    }
}

/// After `dt` seconds, while the root moved evenly by `moved` metres; `stiffness` is the square of the angular frequency in
/// 1/s^2, `damping` the ratio zeta. What is not finite, and what took no time or more than [`LONGEST_STEP_S`], rests.
pub fn step(state: State, moved: DVec3, dt: f64, stiffness: f64, damping: f64) -> State {
    if !(dt > 0.0 && dt <= LONGEST_STEP_S) {
        return State::default();
    }
    let next = free_or_driven(state, moved / dt, dt, stiffness.sqrt(), damping);
    if next.is_finite() { next } else { State::default() }
}

/// The same by angular frequency and the root's velocity, without those limits. Around the particular solution the
/// equation is the free one.
pub fn free_or_driven(state: State, root_velocity: DVec3, dt: f64, w: f64, damping: f64) -> State {
    let trail = -2.0 * damping / w * root_velocity;
    let free = State { lag: state.lag - trail, velocity: state.velocity - root_velocity };
    let free = unforced(free, dt, w, damping);
    State { lag: free.lag + trail, velocity: free.velocity + root_velocity }
}

/// Mean of exp over [-x, 0].
pub fn decay_mean(x: f64) -> f64 {
    if x > 0.0 { -(-x).exp_m1() / x } else { 1.0 }
}

/// x'' + 2 zeta w x' + w^2 x = 0, from the roots of r^2 + 2 zeta w r + w^2 = 0.
fn unforced(State { lag: x, velocity: v }: State, t: f64, w: f64, zeta: f64) -> State {
    let a = zeta * w;
    // Nearer to the double root the differences below would cancel; its own error there is (w t)^2 e^(-w t) 1e-9.
    if (zeta - 1.0).abs() < 1e-9 {
        let slope = v + a * x;
        let decay = (-a * t).exp();
        return State { lag: decay * (x + slope * t), velocity: decay * (v - a * slope * t) };
    }
    if zeta < 1.0 {
        let rate = w * (1.0 - zeta * zeta).sqrt();
        let (sine, cosine) = (rate * t).sin_cos();
        let decay = (-a * t).exp();
        return State {
            lag: decay * (x * cosine + (v + a * x) / rate * sine),
            velocity: decay * (v * cosine - (a * v + w * w * x) / rate * sine),
        };
    }
    let fast = -a - w * (zeta * zeta - 1.0).sqrt();
    // Vieta: the product of the roots is w^2.
    let slow = w * w / fast;
    let (of_slow, of_fast) = ((v - fast * x) / (slow - fast), (v - slow * x) / (fast - slow));
    let (of_slow, of_fast) = (of_slow * (slow * t).exp(), of_fast * (fast * t).exp());
    State { lag: of_slow + of_fast, velocity: slow * of_slow + fast * of_fast }
}

/// Brings a tip back to at most `reach` metres; what drives it farther from its root is taken from its velocity.
pub fn limited(state: State, root_velocity: DVec3, reach: f64) -> State {
    if state.lag.length() <= reach {
        return state;
    }
    let outward = state.lag.normalize();
    let leaving = (state.velocity - root_velocity).dot(outward).max(0.0);
    State { lag: reach * outward, velocity: state.velocity - leaving * outward }
}

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

fn state(inputs: &mut TestInputs) -> State {
    State { lag: inputs.vec3(), velocity: inputs.vec3() }
}

fn flat(state: State) -> Vec<f64> {
    [state.lag.to_array(), state.velocity.to_array()].concat()
}

/// By angular frequency and the root's velocity.
fn one_branch(inputs: &mut TestInputs) -> Vec<f64> {
    let (state, root_velocity): (State, DVec3) = (state(inputs), inputs.vec3());
    let (dt, w, zeta) = (inputs.number(), inputs.number(), inputs.number());
    flat(free_or_driven(state, root_velocity, dt, w, zeta))
}

/// What the energy norm allows of a lag and of a velocity.
fn in_norm(state: State, root_velocity: DVec3, dt: f64, w: f64, zeta: f64) -> Vec<f64> {
    let end = free_or_driven(state, root_velocity, dt, w, zeta);
    let norm = state.energy_norm(w * w) + root_velocity.length() + end.energy_norm(w * w);
    let error = 1e-6 * (w * dt).max(1.0) * norm;
    [[error / w; 3], [error; 3]].concat()
}

fn of_branch(inputs: &mut TestInputs) -> Vec<f64> {
    let (state, root_velocity) = (state(inputs), inputs.vec3());
    in_norm(state, root_velocity, inputs.number(), inputs.number(), inputs.number())
}

fn of_step(inputs: &mut TestInputs) -> Vec<f64> {
    let (state, moved) = (state(inputs), inputs.vec3());
    let (dt, stiffness, zeta) = (inputs.number(), inputs.number(), inputs.number());
    in_norm(state, moved / dt, dt, stiffness.sqrt(), zeta)
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("sway_decay_mean", &[Domain::Log(1e-6, 1e4, &[0.0, 1e-40, 1.0, 1e30])], |inputs| {
        vec![decay_mean(inputs.number())]
    }),
    Twin::new("sway_tangent", &[Domain::Uniform(-0.786, 0.786, &[-0.785, 0.0, 1e-40, 1e-7, 0.785])], |inputs| {
        vec![inputs.number().tan()]
    }),
    Twin::new("sway_under_damped", &[VECTOR, VECTOR, VECTOR, STEP_S, FREQUENCY, UNDER], one_branch)
        .limit(0.0, 1e-12)
        .allowance(of_branch),
    Twin::new("sway_over_damped", &[VECTOR, VECTOR, VECTOR, STEP_S, FREQUENCY, OVER], one_branch)
        .limit(0.0, 1e-12)
        .allowance(of_branch),
    Twin::new("sway_is_finite", &[NUMBERS], |inputs| {
        let numbers = [inputs.number(), inputs.number(), inputs.number()];
        vec![f64::from(u8::from(numbers.iter().all(|number| number.is_finite())))]
    })
    .limit(0.0, 0.0),
    Twin::new("sway_step", &[VECTOR, VECTOR, VECTOR, STEP_S, STIFFNESS, ANY], |inputs| {
        let (state, moved) = (state(inputs), inputs.vec3());
        flat(step(state, moved, inputs.number(), inputs.number(), inputs.number()))
    })
    .limit(0.0, 1e-12)
    .allowance(of_step),
    Twin::new("sway_limited", &[VECTOR, VECTOR, VECTOR, REACH], |inputs| {
        flat(limited(state(inputs), inputs.vec3(), inputs.number()))
    })
    .rule(Rule::Conditioned(4)),
];

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn along_x(lag: f64, velocity: f64) -> State {
        State { lag: DVec3::X * lag, velocity: DVec3::X * velocity }
    }

    /// Classical Runge-Kutta, which knows no cases: Kutta 1901.
    fn integrated(state: State, root_velocity: DVec3, dt: f64, stiffness: f64, damping: f64, pieces: u32) -> State {
        let slope = |at: State| State {
            lag: at.velocity - root_velocity,
            velocity: -2.0 * damping * stiffness.sqrt() * at.velocity - stiffness * at.lag,
        };
        let plus = |at: State, slope: State, t: f64| State {
            lag: at.lag + t * slope.lag,
            velocity: at.velocity + t * slope.velocity,
        };
        let h = dt / f64::from(pieces);
        (0..pieces).fold(state, |at, _| {
            let first = slope(at);
            let second = slope(plus(at, first, 0.5 * h));
            let third = slope(plus(at, second, 0.5 * h));
            let fourth = slope(plus(at, third, h));
            let ends = plus(plus(at, first, h / 6.0), fourth, h / 6.0);
            plus(plus(ends, second, h / 3.0), third, h / 3.0)
        })
    }

    #[test]
    fn it_solves_the_equation() {
        for damping in [0.0, 0.3, 0.999_999, 1.0 - 1e-10, 1.0, 1.000_001, 1.5, 4.0] {
            for stiffness in [1.0, 400.0, 3000.0] {
                let start = State { lag: DVec3::new(0.02, -0.01, 0.0), velocity: DVec3::new(-0.4, 0.0, 0.7) };
                let moved = DVec3::new(0.05, 0.03, -0.02);
                let found = step(start, moved, 0.1, stiffness, damping);
                let expected = integrated(start, moved / 0.1, 0.1, stiffness, damping, 4000);
                let error = State { lag: found.lag - expected.lag, velocity: found.velocity - expected.velocity };
                assert!(error.energy_norm(stiffness) < 1e-8, "zeta {damping}, w^2 {stiffness}: {error:?}");
            }
        }
    }

    /// Largest difference of the tip's way over two seconds between two frame rates, the root swinging by a metre.
    fn difference(rates: [u32; 2], damping: f64) -> f64 {
        let root = |t: f64| DVec3::X * (1.5 * t).sin();
        let mut ends = [Vec::new(), Vec::new()];
        for (rate, ends) in rates.into_iter().zip(&mut ends) {
            let mut state = State { velocity: DVec3::X * 1.5, ..State::default() };
            for frame in 1..=2 * rate {
                let (from, to) = (f64::from(frame - 1) / f64::from(rate), f64::from(frame) / f64::from(rate));
                state = step(state, root(to) - root(from), to - from, 400.0, damping);
                if (frame * 10).is_multiple_of(rate) {
                    ends.push(state.lag + root(to));
                }
            }
        }
        assert_eq!((ends[0].len(), ends[1].len()), (20, 20));
        ends[0].iter().zip(&ends[1]).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max)
    }

    #[test]
    fn frame_rates_agree() {
        for damping in [0.1, 0.25, 1.0, 3.0] {
            let coarse = difference([30, 240], damping);
            assert!(coarse <= 5e-4, "zeta {damping}: {coarse:e}");
            // Linear hold is of second order.
            let ratio = coarse / difference([60, 240], damping);
            assert!((3.5..5.0).contains(&ratio), "zeta {damping}: halving the step divides the error by {ratio}");
        }
    }

    #[test]
    fn a_free_strand_swings_at_its_frequency_and_a_dragged_one_trails() {
        let period = TAU / 20.0;
        let quarter = step(along_x(1.0, 0.0), DVec3::ZERO, 0.25 * period, 400.0, 0.0);
        assert!((quarter.velocity.x + 20.0).abs() < 1e-12 && quarter.lag.x.abs() < 1e-12, "{quarter:?}");
        let dragged = (0..100).fold(State::default(), |at, _| step(at, DVec3::X * 0.05, 0.05, 400.0, 0.25));
        assert!((dragged.lag.x + 2.0 * 0.25 / 20.0).abs() < 1e-9, "{dragged:?}");
    }

    #[test]
    fn what_is_out_of_reach_comes_back_and_follows_its_root() {
        let inside = along_x(0.9, 5.0);
        assert_eq!(limited(inside, DVec3::ZERO, 1.0), inside);
        let state = State { lag: DVec3::new(-3.0, 4.0, 0.0), velocity: DVec3::ZERO };
        let root_velocity = DVec3::new(10.0, 0.0, 0.0);
        let held = limited(state, root_velocity, 1.0);
        assert!((held.lag - DVec3::new(-0.6, 0.8, 0.0)).length() < 1e-15);
        assert!((held.velocity - root_velocity).dot(held.lag).abs() < 1e-12, "{held:?}");
    }
}
