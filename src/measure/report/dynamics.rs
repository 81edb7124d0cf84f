//! Integrators of a strand that hangs on a moving root: error against step size and time.
//!
//! The strand's tip is a damped oscillator, x'' + 2 zeta w x' + w^2 (x - u(t)) = 0 with the root's path u.

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

/// Strands that one timing moves: enough for the clock.
pub const STRANDS: usize = 200;
/// Length of a run, seconds.
const RUN_S: f64 = 2.0;
/// Steps a second of the solution that errors are taken against; its own error falls with the square of the step and is
/// some 1e-5 of that of the finest step measured.
const REFERENCE_HZ: u32 = 960 * 256;
/// An integrator that is this many root amplitudes away has diverged.
const DIVERGED: f64 = 100.0;

/// A strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strand {
    /// What it is called.
    pub name: &'static str,
    /// w, radians a second.
    pub stiffness_rad_s: f64,
    /// zeta in (0, 1): below critical.
    pub damping: f64,
}

/// Long fur and a short bristle.
pub const STRAND_KINDS: [Strand; 2] = [
    Strand { name: "soft strand", stiffness_rad_s: 20.0, damping: 0.1 },
    Strand { name: "stiff strand", stiffness_rad_s: 400.0, damping: 0.3 },
];

/// A way to take a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Integrator {
    /// Both rates from before the step.
    ExplicitEuler,
    /// The velocity first, then the place with the new velocity.
    SemiImplicitEuler,
    /// Both rates from after the step.
    ImplicitEuler,
    /// The exact solution, the root standing still during the step.
    ExactHold,
    /// The exact solution, the root moving evenly during the step.
    ExactLinear,
}

impl Integrator {
    /// All, classic ones first.
    pub const ALL: [Self; 5] =
        [Self::ExplicitEuler, Self::SemiImplicitEuler, Self::ImplicitEuler, Self::ExactHold, Self::ExactLinear];

    /// Name in tables and plots.
    pub fn name(self) -> &'static str {
        match self {
            Self::ExplicitEuler => "explicit Euler",
            Self::SemiImplicitEuler => "semi-implicit Euler",
            Self::ImplicitEuler => "implicit Euler",
            Self::ExactHold => "exact, root held",
            Self::ExactLinear => "exact, root linear",
        }
    }

    /// Whether it is what others do.
    pub fn is_classic(self) -> bool {
        !matches!(self, Self::ExactHold | Self::ExactLinear)
    }

    /// One step of `dt_s` seconds while the root goes from `root[0]` to `root[1]`; state is (place, velocity).
    pub fn step(self, strand: &Strand, [x, v]: [f64; 2], root: [f64; 2], dt_s: f64) -> [f64; 2] {
        let (w, drag) = (strand.stiffness_rad_s, 2.0 * strand.damping * strand.stiffness_rad_s);
        match self {
            Self::ExplicitEuler => [x + dt_s * v, v + dt_s * (w * w * (root[0] - x) - drag * v)],
            Self::SemiImplicitEuler => {
                let v = v + dt_s * (w * w * (root[0] - x) - drag * v);
                [x + dt_s * v, v]
            }
            Self::ImplicitEuler => {
                let v = (v + dt_s * w * w * (root[1] - x)) / (1.0 + dt_s * drag + dt_s * dt_s * w * w);
                [x + dt_s * v, v]
            }
            Self::ExactHold => exact(strand, [x, v], root[0], 0.0, dt_s),
            Self::ExactLinear => exact(strand, [x, v], root[0], (root[1] - root[0]) / dt_s, dt_s),
        }
    }
}

/// The damped oscillator solved for a root at `root` that moves at `speed`: it trails by 2 zeta speed / w, and around
/// that the motion is free. In one dimension, so that its time compares with that of the other steps; a test holds it to
/// the twin of the shader, [`crate::measure::twin::strand_dynamics`].
fn exact(strand: &Strand, [x, v]: [f64; 2], root: f64, speed: f64, dt_s: f64) -> [f64; 2] {
    let (w, decay) = (strand.stiffness_rad_s, strand.damping * strand.stiffness_rad_s);
    let trail = 2.0 * strand.damping * speed / w;
    let (y, dy) = (x - root + trail, v - speed);
    let ringing = w * (1.0 - strand.damping * strand.damping).sqrt();
    let (sin, cos) = (ringing * dt_s).sin_cos();
    let left = (-decay * dt_s).exp();
    let place = left * (y * cos + (dy + decay * y) / ringing * sin);
    let velocity = left * (dy * cos - (w * w * y + decay * dy) / ringing * sin);
    [root + speed * dt_s - trail + place, speed + velocity]
}

/// Path of the root, in its own amplitude: a walk's sway that sets in smoothly, with a quicker shake on top.
fn root(time_s: f64) -> f64 {
    let onset = 1.0 - (-4.0 * time_s * time_s).exp();
    onset * ((TAU * 1.5 * time_s).sin() + 0.25 * (TAU * 4.0 * time_s).sin())
}

/// The tip's places after each step of a run.
fn run(integrator: Integrator, strand: &Strand, steps_hz: u32) -> Vec<f64> {
    let dt_s = 1.0 / f64::from(steps_hz);
    let steps = (RUN_S * f64::from(steps_hz)).round() as u32;
    let mut state = [0.0; 2];
    (0..steps)
        .map(|step| {
            let ends = [step, step + 1].map(|step| root(f64::from(step) * dt_s));
            state = integrator.step(strand, state, ends, dt_s);
            state[0]
        })
        .collect()
}

/// Error of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunError {
    /// Largest distance from the exact place, root amplitudes.
    pub max: f64,
    /// Mean of (x - r)^2 / (r^2 + 0.01) over the steps.
    pub relmse: f64,
}

/// Exact places of a strand over a run.
pub struct Reference(Vec<f64>);

impl Reference {
    /// Solves finely.
    pub fn new(strand: &Strand) -> Self {
        Self(run(Integrator::ExactLinear, strand, REFERENCE_HZ))
    }

    /// How far a run is off; `None` where it diverges. `steps_hz` divides the reference's rate.
    pub fn error(&self, integrator: Integrator, strand: &Strand, steps_hz: u32) -> Option<RunError> {
        let every = (REFERENCE_HZ / steps_hz) as usize;
        let places = run(integrator, strand, steps_hz);
        let pairs = || places.iter().zip(self.0.iter().skip(every - 1).step_by(every));
        let max = pairs().map(|(x, r)| (x - r).abs()).fold(0.0, f64::max);
        let sum: f64 = pairs().map(|(x, r)| (x - r).powi(2) / (r * r + 0.01)).sum();
        // f64::max drops NaN: the last place tells whether there was one.
        let stays = max < DIVERGED && places.last().is_some_and(|place| place.is_finite());
        stays.then_some(RunError { max, relmse: sum / places.len() as f64 })
    }
}

/// Milliseconds of this thread for one second of [`STRANDS`] strands. Coefficients are made anew for every strand and
/// step, as strands of differing length ask for.
pub fn time_ms(integrator: Integrator, strand: &Strand, steps_hz: u32) -> f64 {
    let dt_s = 1.0 / f64::from(steps_hz);
    let mut states = vec![[0.0; 2]; STRANDS];
    let start = Instant::now();
    for step in 0..steps_hz {
        let ends = [step, step + 1].map(|step| root(f64::from(step) * dt_s));
        for state in &mut states {
            *state = integrator.step(black_box(strand), *state, ends, dt_s);
        }
    }
    black_box(&states);
    start.elapsed().as_secs_f64() * 1e3
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::twin::strand_dynamics::{self, State};
    use Integrator::{ExactHold, ExactLinear, ExplicitEuler, ImplicitEuler, SemiImplicitEuler};
    use glam::DVec3;

    const SOFT: &Strand = &STRAND_KINDS[0];
    const STIFF: &Strand = &STRAND_KINDS[1];

    #[test]
    fn the_exact_step_does_not_depend_on_its_length() {
        let (root, speed) = (0.3, 2.0);
        let whole = exact(SOFT, [0.1, -1.0], root, speed, 0.2);
        let half = exact(SOFT, [0.1, -1.0], root, speed, 0.1);
        let halves = exact(SOFT, half, root + 0.1 * speed, speed, 0.1);
        assert!(whole.iter().zip(halves).all(|(a, b)| (a - b).abs() < 1e-12), "{whole:?} {halves:?}");
    }

    #[test]
    fn the_exact_step_is_that_of_the_shaders_twin() {
        let (root, speed, dt_s) = (0.3, 2.0, 0.03);
        for strand in [SOFT, STIFF] {
            let [x, v] = exact(strand, [0.5, 1.0], root, speed, dt_s);
            let state = State { lag: DVec3::X * (0.5 - root), velocity: DVec3::X };
            let w = strand.stiffness_rad_s;
            let twin = strand_dynamics::step(state, DVec3::X * (speed * dt_s), dt_s, w * w, strand.damping);
            assert!((x - (root + speed * dt_s) - twin.lag.x).abs() < 1e-12, "{x} {twin:?}");
            assert!((v - twin.velocity.x).abs() < 1e-10, "{v} {twin:?}");
        }
    }

    #[test]
    fn the_exact_step_solves_the_equation() {
        // x'' by central differences of the solution, at rest and on a moving root.
        for speed in [0.0, 2.0] {
            let at = |time_s| exact(SOFT, [0.5, 1.0], 0.3, speed, time_s);
            let (time_s, h) = (0.07, 1e-4);
            let [before, [x, v], after] = [at(time_s - h), at(time_s), at(time_s + h)];
            let acceleration = (after[1] - before[1]) / (2.0 * h);
            let w = SOFT.stiffness_rad_s;
            let rest = acceleration + 2.0 * SOFT.damping * w * v + w * w * (x - 0.3 - speed * time_s);
            // h^2 / 6 x'''' is about w^4 h^2 / 6.
            assert!(rest.abs() < w.powi(4) * h * h, "{rest}");
            assert!(((after[0] - before[0]) / (2.0 * h) - v).abs() < w.powi(3) * h * h);
        }
    }

    #[test]
    fn integrators_converge_with_their_order() {
        let reference = Reference::new(SOFT);
        for (integrator, order) in
            [(ExplicitEuler, 1.0), (SemiImplicitEuler, 1.0), (ImplicitEuler, 1.0), (ExactHold, 1.0), (ExactLinear, 2.0)]
        {
            let error = |steps_hz| reference.error(integrator, SOFT, steps_hz).unwrap().max;
            let found = (error(480) / error(960)).log2();
            assert!((found - order).abs() < 0.15, "{}: order {found} instead of {order}", integrator.name());
        }
    }

    #[test]
    fn what_diverges_is_said_to() {
        // Stable below w dt = 2 zeta = 0.6 (explicit) and 2 (sqrt(1 + zeta^2) - zeta) = 1.49 (semi-implicit).
        let reference = Reference::new(STIFF);
        let stays = |integrator, steps_hz| reference.error(integrator, STIFF, steps_hz).is_some();
        assert!(!stays(ExplicitEuler, 480) && stays(ExplicitEuler, 960));
        assert!(!stays(SemiImplicitEuler, 240) && stays(SemiImplicitEuler, 480));
        assert!(stays(ImplicitEuler, 30) && stays(ExactHold, 30) && stays(ExactLinear, 30));
    }
}
