//! Twin of `gauze.glsl`, and the whole of gauze: what a sheet of threads reflects, lets through and absorbs.
//!
//! Wang et al. 2022, "SpongeCake: A Layered Microfacet Appearance Model" (single scattering in a thin layer); Kelemen &
//! Szirmay-Kalos 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model" (the product that is reciprocal and
//! scatters all that is met). `classic/gauze.rs` has the opacity of older engines, and its defects.

use super::albedo::{Fit, gauss_legendre};
use super::anisotropy::Lobe;
use super::classic::gauze::half_opacity_cosine;
use super::domain::{COSINE, Domain, RADIANCE, UNIT};
use super::{TestInputs, Twin, ULP};
use glam::DVec3;
use std::f64::consts::{LN_2, PI};

/// Largest optical depth: nothing is seen through it.
pub const LARGEST_DEPTH: f64 = 60.0;

/// `(1 - e^-x) / x`; `x` >= 0.
pub fn phi1(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { -(-x).exp_m1() / x }
}

/// How the threads lie, and how densely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Weave {
    /// Yarn lies every way; its optical depth from the front.
    Matted(f64),
    /// A grid of round threads; their diameter over their pitch, [0, 1].
    Crossed(f64),
}

impl Weave {
    /// Matted yarn that is half opaque at the angle at which classic gauze of that density in [0, 200] is; 0 is opaque.
    pub fn matted(density: f64) -> Self {
        Self::Matted(if density > 0.0 { half_opacity_cosine(density) * LN_2 } else { LARGEST_DEPTH })
    }

    /// A grid that is half opaque at that angle, seen along its threads: the smaller root of
    /// `(1 - w) (1 - w / mu) = 1 / 2`.
    pub fn crossed(density: f64) -> Self {
        let mu = half_opacity_cosine(density);
        Self::Crossed(if density > 0.0 { mu / (1.0 + mu + (1.0 + mu * mu).sqrt()) } else { 1.0 })
    }

    /// Share of light along `w` that meets no thread; `w.z` in [0, 1].
    pub fn transmittance(self, w: DVec3) -> f64 {
        let z = w.z.max(1e-7);
        match self {
            Self::Matted(depth) => (-depth / z).exp(),
            // Seen aslant along x, a round thread along y spans sqrt(1 + (x / z)^2) of its diameter.
            Self::Crossed(cover) => {
                let open = |slope: f64| (1.0 - cover * 1f64.hypot(slope)).max(0.0);
                open(w.x / z) * open(w.y / z)
            }
        }
    }

    /// Optical depth along `w`, at most [`LARGEST_DEPTH`].
    pub fn depth(self, w: DVec3) -> f64 {
        match self {
            Self::Matted(depth) => (depth / w.z.max(1e-7)).min(LARGEST_DEPTH),
            Self::Crossed(_) => (-self.transmittance(w).ln()).min(LARGEST_DEPTH),
        }
    }

    /// Share of light along `w` that meets a thread.
    pub fn opacity(self, w: DVec3) -> f64 {
        opacity(self.depth(w))
    }

    /// Cosine-weighted mean of [`Self::opacity`] over the hemisphere, by quadrature.
    pub fn mean_opacity(self) -> f64 {
        let is_matted = matches!(self, Self::Matted(_));
        // Where threads close, the opacity of a grid has an edge.
        let rule = gauss_legendre(if is_matted { 64 } else { 128 });
        // A grid repeats itself every quarter turn and is even within it.
        let turns = if is_matted { &[(0.0, 1.0)][..] } else { &rule };
        let at = |mu: f64, turn: f64| {
            let (y, x) = (turn * PI / 4.0).sin_cos();
            let sine = (1.0 - mu * mu).max(0.0).sqrt();
            self.opacity(DVec3::new(sine * x, sine * y, mu))
        };
        let ring = |mu| turns.iter().map(|&(turn, weight)| weight * at(mu, turn)).sum::<f64>();
        rule.iter().map(|&(u, weight)| weight * 4.0 * u.powi(3) * ring(u * u)).sum()
    }
}

/// Share of light along a depth that meets a thread.
pub fn opacity(depth: f64) -> f64 {
    -(-depth).exp_m1()
}

/// Share of scattered light that goes through, in single scattering.
pub fn through(depth_v: f64, depth_l: f64) -> f64 {
    let through = (-depth_v.min(depth_l)).exp() * phi1((depth_v - depth_l).abs());
    through / (phi1(depth_v + depth_l) + through)
}

/// Share of the sheet that both eye and light meet.
pub fn met_by_both(opacity_v: f64, opacity_l: f64) -> f64 {
    if opacity_v * opacity_l == 0.0 { 0.0 } else { 1.0 / (1.0 / opacity_v + 1.0 / opacity_l - 1.0) }
}

/// A sheet of gauze without its maps.
#[derive(Debug, Clone, Copy)]
pub struct Gauze {
    /// Albedo of the threads below their highlight, linear.
    pub diffuse: DVec3,
    /// The threads.
    pub weave: Weave,
    /// Their highlight; of F0 = F90 = 0, none.
    pub lobe: Lobe,
}

impl Gauze {
    /// Diffuse scattering alone, without the cosine; `l.z` is negative for light from behind. Reciprocal.
    pub fn diffuse_bsdf(&self, fit: &Fit, mean_opacity: f64, v: DVec3, l: DVec3) -> DVec3 {
        let l_on_eyes_side = DVec3::new(l.x, l.y, l.z.abs());
        let met = |w| self.weave.opacity(w) * (1.0 - self.lobe.albedo(fit, w));
        let average = (mean_opacity * (1.0 - self.lobe.average_albedo(fit))).max(DVec3::splat(1e-6));
        let through = through(self.weave.depth(v), self.weave.depth(l_on_eyes_side));
        let side = if l.z > 0.0 { 1.0 - through } else { through };
        self.diffuse / PI * met(v) * met(l_on_eyes_side) / average * side
    }

    /// The highlight, times the cosine of `l`.
    pub fn highlight_times_cosine(&self, fit: &Fit, v: DVec3, l: DVec3) -> DVec3 {
        if l.z <= 0.0 {
            return DVec3::ZERO;
        }
        self.lobe.times_cosine(fit, v, l) * met_by_both(self.weave.opacity(v), self.weave.opacity(l))
    }

    /// BSDF times the cosine of `l`, of either side; premultiplied: what the holes let through is not in it.
    pub fn bsdf_times_cosine(&self, fit: &Fit, mean_opacity: f64, v: DVec3, l: DVec3) -> DVec3 {
        self.diffuse_bsdf(fit, mean_opacity, v, l) * l.z.abs() + self.highlight_times_cosine(fit, v, l)
    }

    /// Radiance under constant white radiance 1 from both sides, that through the holes not counted.
    pub fn ambient(&self, fit: &Fit, v: DVec3) -> DVec3 {
        let (met, highlight) = (self.weave.opacity(v), self.lobe.albedo(fit, v));
        highlight * met_by_both(met, met) + self.diffuse * (1.0 - highlight) * met
    }
}

/// Of a weave from the front: density 1000 down to 0, which is opaque.
const DEPTH: Domain = Domain::Log(1e-3, 60.0, &[0.0, 1e-40, 1e-8, 0.999, 1.0, 60.0]);
const MEAN_OPACITY: Domain = Domain::Uniform(0.01, 1.0, &[0.01, 1.0]);
const SIGNED: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, -1e-7, 0.0, 1e-40, 1e-7, 1.0]);

/// Members of `GauzeSurface`.
struct GauzeSurface {
    diffuse: DVec3,
    depth: f64,
    coupled: DVec3,
    opacity: f64,
}

impl GauzeSurface {
    fn new(inputs: &mut TestInputs<'_>) -> Self {
        Self { diffuse: inputs.vec3(), depth: inputs.number(), coupled: inputs.vec3(), opacity: inputs.number() }
    }

    fn words(&self) -> Vec<f64> {
        let mut words = self.diffuse.to_array().to_vec();
        words.push(self.depth);
        words.extend(self.coupled.to_array());
        words.push(self.opacity);
        words
    }
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("gauze_phi1", &[Domain::Log(1e-10, 100.0, &[0.0, 1e-40, 1e-10, 1.0, 100.0, 1e30])], |inputs| {
        vec![phi1(inputs.number())]
    })
    .limit(1e-6, 0.0),
    Twin::new("gauze_matted_depth", &[DEPTH, COSINE], |inputs| {
        let (depth, mu) = (inputs.number(), inputs.number());
        vec![(depth / mu.max(1e-7)).min(LARGEST_DEPTH)]
    }),
    Twin::new("gauze_crossed_depth", &[UNIT, Domain::Hemisphere], |inputs| {
        vec![Weave::Crossed(inputs.number()).depth(inputs.vec3())]
    })
    // 1 - cover s is as good as the product, and its logarithm relative to it.
    .rule(super::Rule::Conditioned(2)),
    Twin::new("gauze_opacity", &[DEPTH], |inputs| vec![opacity(inputs.number())]).limit(2e-6, 0.0),
    Twin::new("gauze_through", &[DEPTH, DEPTH], |inputs| vec![through(inputs.number(), inputs.number())]),
    Twin::new("gauze_met_by_both", &[UNIT, UNIT], |inputs| vec![met_by_both(inputs.number(), inputs.number())]),
    Twin::new("gauze_surface", &[UNIT, DEPTH, MEAN_OPACITY, UNIT, UNIT], |inputs| {
        let (diffuse, depth, mean, albedo, average) =
            (inputs.vec3(), inputs.number(), inputs.number(), inputs.vec3(), inputs.vec3());
        let opacity = opacity(depth);
        let average = (mean * (1.0 - average)).max(DVec3::splat(1e-6));
        GauzeSurface { diffuse, depth, coupled: diffuse * (1.0 - albedo) * opacity / PI / average, opacity }.words()
    })
    // 1 - average is as good as the average, 1 - albedo as the albedo: of a few units of 1, over the least average.
    .allowance(|inputs| {
        let (_, depth, mean, _, average) =
            (inputs.vec3(), inputs.number(), inputs.number(), inputs.vec3(), inputs.vec3());
        let coupled = |average: f64| {
            let average = (mean * (1.0 - average)).max(1e-6);
            opacity(depth) / PI / average * ULP * (1.0 + mean / average)
        };
        let [x, y, z] = average.to_array().map(coupled);
        vec![0.0, 0.0, 0.0, 0.0, x, y, z, 0.0]
    }),
    Twin::new("gauze_diffuse_times_cosine", &[UNIT, DEPTH, UNIT, UNIT, DEPTH, SIGNED, UNIT], |inputs| {
        let (surface, depth_l, mu_l, albedo_l) =
            (GauzeSurface::new(inputs), inputs.number(), inputs.number(), inputs.vec3());
        let through = through(surface.depth, depth_l);
        let side = if mu_l > 0.0 { 1.0 - through } else { through };
        let value = surface.coupled * (1.0 - albedo_l) * opacity(depth_l) * side * mu_l.abs();
        value.to_array().to_vec()
    }),
    Twin::new("gauze_ambient", &[UNIT, DEPTH, UNIT, UNIT, UNIT, RADIANCE, RADIANCE, RADIANCE, UNIT], |inputs| {
        let (surface, albedo) = (GauzeSurface::new(inputs), inputs.vec3());
        let (mirrored, before, behind, through) = (inputs.vec3(), inputs.vec3(), inputs.vec3(), inputs.number());
        let highlight = albedo * met_by_both(surface.opacity, surface.opacity) * mirrored;
        let scattered = before * (1.0 - through) + behind * through;
        (highlight + surface.diffuse * (1.0 - albedo) * surface.opacity * scattered).to_array().to_vec()
    }),
];
