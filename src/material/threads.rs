//! What the threads of gauze cover: what the shader needs of the weave and its density, evaluated once a material.

use super::{Gauze, Weave};
use crate::math::gauss_legendre;
use glam::DVec3;
use std::f64::consts::{LN_2, PI};

/// Optical depth through which nothing is seen.
const LARGEST_DEPTH: f64 = 60.0;
/// Smallest cosine of a view: the horizon is not divided by.
const SMALLEST_COSINE: f64 = 1e-7;

/// How the threads lie, and how densely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Threads {
    /// Yarn lies every way; its optical depth from the front.
    Matted(f64),
    /// A grid of round threads; their diameter over their pitch, [0, 1].
    Crossed(f64),
}

impl Gauze {
    /// Threads that make the cloth half opaque where `sin(angle)^weave_density = 1/2`; a grid, seen along its threads.
    pub fn threads(&self) -> Threads {
        let density = f64::from(self.weave_density);
        let is_opaque = density <= 0.0;
        // Cosine of that angle, sqrt(1 - 4^(-1 / density)), in the form that does not cancel.
        let mu = (-(-(4f64.ln()) / density).exp_m1()).sqrt();
        match self.weave {
            Weave::Matted if is_opaque => Threads::Matted(LARGEST_DEPTH),
            Weave::Matted => Threads::Matted(mu * LN_2),
            Weave::Crossed if is_opaque => Threads::Crossed(1.0),
            // The smaller root of (1 - w) (1 - w / mu) = 1 / 2.
            Weave::Crossed => Threads::Crossed(mu / (1.0 + mu + (1.0 + mu * mu).sqrt())),
        }
    }
}

impl Threads {
    /// The number that the weave is told by: [`Self::Matted`]'s or [`Self::Crossed`]'s.
    pub fn density(self) -> f64 {
        let (Self::Matted(density) | Self::Crossed(density)) = self;
        density
    }

    /// Share of light that meets a thread: its mean over the hemisphere, weighted by the cosine. By quadrature.
    pub fn mean_opacity(self) -> f64 {
        // Where threads close, the opacity of a grid has an edge: more points. It is even and repeats every quarter turn.
        let (rule, turns) = match self {
            Self::Matted(_) => (gauss_legendre(64), vec![(0.0, 1.0)]),
            Self::Crossed(_) => (gauss_legendre(128), gauss_legendre(128)),
        };
        let ring = |mu: f64| -> f64 {
            let sine = (1.0 - mu * mu).max(0.0).sqrt();
            let at = |turn: f64| {
                let (y, x) = (turn * PI / 4.0).sin_cos();
                self.opacity(DVec3::new(sine * x, sine * y, mu))
            };
            turns.iter().map(|&(turn, weight)| weight * at(turn)).sum()
        };
        rule.iter().map(|&(u, weight)| weight * 4.0 * u.powi(3) * ring(u * u)).sum()
    }

    /// Share of light along a unit vector, z along the normal, that meets a thread.
    fn opacity(self, along: DVec3) -> f64 {
        let z = along.z.max(SMALLEST_COSINE);
        let depth = match self {
            Self::Matted(depth) => depth / z,
            // Seen aslant along x, a round thread along y spans sqrt(1 + (x / z)^2) of its diameter.
            Self::Crossed(cover) => {
                let open = |slope: f64| (1.0 - cover * 1f64.hypot(slope)).max(0.0);
                -(open(along.x / z) * open(along.y / z)).ln()
            }
        };
        -(-depth.min(LARGEST_DEPTH)).exp_m1()
    }
}
