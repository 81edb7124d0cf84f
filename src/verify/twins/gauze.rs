//! Judges `gauze.glsl`.

use super::super::domain::{COSINE, Domain, RADIANCE, UNIT};
use super::super::twin::{Given, Twin};
use super::ULP;
use crate::material::reference::classic::gauze as classic;
use crate::material::reference::gauze::{LARGEST_DEPTH, Weave, met_by_both, opacity, phi1, through};
use glam::DVec3;
use std::f64::consts::PI;

/// Of a weave from the front: density 1000 down to 0, which is opaque.
const DEPTH: Domain = Domain::Log(1e-3, 60.0, &[0.0, 1e-40, 1e-8, 0.999, 1.0, 60.0]);
const MEAN_OPACITY: Domain = Domain::Uniform(0.01, 1.0, &[0.01, 1.0]);
const SIGNED: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, -1e-7, 0.0, 1e-40, 1e-7, 1.0]);

/// Members of `GauzeSurface`.
struct Surface {
    diffuse: DVec3,
    depth: f64,
    coupled: DVec3,
    opacity: f64,
}

impl Surface {
    fn new(given: &mut Given<'_>) -> Self {
        Self { diffuse: given.vec3(), depth: given.number(), coupled: given.vec3(), opacity: given.number() }
    }

    fn words(&self) -> Vec<f64> {
        let mut words = self.diffuse.to_array().to_vec();
        words.push(self.depth);
        words.extend(self.coupled.to_array());
        words.push(self.opacity);
        words
    }
}

pub(super) const TWINS: &[Twin] = &[
    Twin::new("gauze_phi1", &[Domain::Log(1e-10, 100.0, &[0.0, 1e-40, 1e-10, 1.0, 100.0, 1e30])], |given| {
        vec![phi1(given.number())]
    })
    .limit(1e-6, 0.0),
    Twin::new("gauze_matted_depth", &[DEPTH, COSINE], |given| {
        let (depth, mu) = (given.number(), given.number());
        vec![(depth / mu.max(1e-7)).min(LARGEST_DEPTH)]
    }),
    Twin::new("gauze_crossed_depth", &[UNIT, Domain::Hemisphere], |given| {
        vec![Weave::Crossed(given.number()).depth(given.vec3())]
    })
    // 1 - cover s is as good as the product, and its logarithm relative to it.
    .rule(super::super::twin::Rule::Conditioned(2)),
    Twin::new("gauze_opacity", &[DEPTH], |given| vec![opacity(given.number())]).limit(2e-6, 0.0),
    Twin::new("gauze_classic_opacity", &[Domain::Uniform(0.0, 2000.0, &[0.0, 1.0, 200.0, 2000.0]), COSINE], |given| {
        vec![classic::opacity(given.number(), given.number())]
    })
    // Vulkan has the logarithm within 2^-21 where it is near 0; the power multiplies it by its exponent.
    .allowance(|given| {
        let (exponent, mu) = (given.number(), given.number());
        vec![classic::opacity(exponent, mu) * 0.5 * exponent * 2f64.powi(-21)]
    }),
    Twin::new("gauze_through", &[DEPTH, DEPTH], |given| vec![through(given.number(), given.number())]),
    Twin::new("gauze_met_by_both", &[UNIT, UNIT], |given| vec![met_by_both(given.number(), given.number())]),
    Twin::new("gauze_surface", &[UNIT, DEPTH, MEAN_OPACITY, UNIT, UNIT], |given| {
        let (diffuse, depth, mean, albedo, average) =
            (given.vec3(), given.number(), given.number(), given.vec3(), given.vec3());
        let opacity = opacity(depth);
        let average = (mean * (1.0 - average)).max(DVec3::splat(1e-6));
        Surface { diffuse, depth, coupled: diffuse * (1.0 - albedo) * opacity / PI / average, opacity }.words()
    })
    // 1 - average is as good as the average, 1 - albedo as the albedo: of a few units of 1, over the least average.
    .allowance(|given| {
        let (_, depth, mean, _, average) = (given.vec3(), given.number(), given.number(), given.vec3(), given.vec3());
        let coupled = |average: f64| {
            let average = (mean * (1.0 - average)).max(1e-6);
            opacity(depth) / PI / average * ULP * (1.0 + mean / average)
        };
        let [x, y, z] = average.to_array().map(coupled);
        vec![0.0, 0.0, 0.0, 0.0, x, y, z, 0.0]
    }),
    Twin::new("gauze_diffuse_times_cosine", &[UNIT, DEPTH, UNIT, UNIT, DEPTH, SIGNED, UNIT], |given| {
        let (surface, depth_l, mu_l, albedo_l) = (Surface::new(given), given.number(), given.number(), given.vec3());
        let through = through(surface.depth, depth_l);
        let side = if mu_l > 0.0 { 1.0 - through } else { through };
        let value = surface.coupled * (1.0 - albedo_l) * opacity(depth_l) * side * mu_l.abs();
        value.to_array().to_vec()
    }),
    Twin::new("gauze_ambient", &[UNIT, DEPTH, UNIT, UNIT, UNIT, RADIANCE, RADIANCE, RADIANCE, UNIT], |given| {
        let (surface, albedo) = (Surface::new(given), given.vec3());
        let (mirrored, before, behind, through) = (given.vec3(), given.vec3(), given.vec3(), given.number());
        let highlight = albedo * met_by_both(surface.opacity, surface.opacity) * mirrored;
        let scattered = before * (1.0 - through) + behind * through;
        (highlight + surface.diffuse * (1.0 - albedo) * surface.opacity * scattered).to_array().to_vec()
    }),
];
