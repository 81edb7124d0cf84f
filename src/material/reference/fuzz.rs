//! Twin of `fuzz.glsl`: a Lambert base under the fuzz of its pile and of standing fibres.
//!
//! Kelemen & Szirmay-Kalos 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model" (the base).

use super::occlusion;
use super::sheen::Lobe;
use glam::DVec3;
use std::f64::consts::PI;

/// Reflectance of the pile of cotton, a dielectric of index 1.5; Schlick's rise is a mirror's, and pile is none.
pub const COTTON_F0: f64 = 0.04;

/// A cloth with fuzz; both lobes are of one model.
#[derive(Debug, Clone, Copy)]
pub struct Surface<'a> {
    /// Albedo of the base, linear, [0, 1].
    pub diffuse: DVec3,
    /// Reflectance of the pile, linear, [0, 1].
    pub pile_color: DVec3,
    /// Reflectance of the standing fibres, linear, [0, 1].
    pub fibre_color: DVec3,
    /// Lobe of the pile.
    pub pile: Lobe<'a>,
    /// Lobe of the standing fibres.
    pub fibre: Lobe<'a>,
}

impl Surface<'_> {
    /// Weight of the pile: what the standing fibres do not cover.
    fn seen(&self) -> DVec3 {
        self.pile_color * (1.0 - self.fibre_color)
    }

    /// Albedo of all fuzz, as the table has it.
    pub fn fuzz_albedo(&self, mu: f64) -> DVec3 {
        self.seen() * self.pile.entry(mu).albedo + self.fibre_color * self.fibre.entry(mu).albedo
    }

    /// Both lobes times the cosine of `l`.
    pub fn fuzz_times_cosine(&self, v: DVec3, l: DVec3) -> DVec3 {
        self.seen() * self.pile.times_cosine(v, l) + self.fibre_color * self.fibre.times_cosine(v, l)
    }

    /// The base alone, without its cosine: reciprocal.
    pub fn base_brdf(&self, mu_v: f64, mu_l: f64) -> DVec3 {
        let average = self.seen() * self.pile.entry(0.0).average + self.fibre_color * self.fibre.entry(0.0).average;
        let left = |mu| 1.0 - self.fuzz_albedo(mu);
        self.diffuse / PI * left(mu_v) * left(mu_l) / (1.0 - average).max(DVec3::splat(1e-4))
    }

    /// BRDF times the cosine of `l`; 0 where a direction is at or below the horizon.
    pub fn brdf_times_cosine(&self, v: DVec3, l: DVec3) -> DVec3 {
        if v.z <= 0.0 || l.z <= 0.0 {
            return DVec3::ZERO;
        }
        self.fuzz_times_cosine(v, l) + self.base_brdf(v.z, l.z) * l.z
    }

    /// Radiance under constant white radiance 1 in a crevice that leaves `occlusion` of the sky.
    pub fn ambient(&self, mu_v: f64, occlusion: f64) -> DVec3 {
        let bounced = |share: f64, color: DVec3| DVec3::from(color.to_array().map(|c| occlusion::bounced(share, c)));
        // Fuzz scatters as widely as the roughest highlight.
        let seen = occlusion::of_lobe(mu_v, 1.0, occlusion);
        let of_lobe = |lobe: &Lobe<'_>, color: DVec3| color * lobe.entry(mu_v).albedo * bounced(seen, color);
        of_lobe(&self.pile, self.seen())
            + of_lobe(&self.fibre, self.fibre_color)
            + self.diffuse * (1.0 - self.fuzz_albedo(mu_v)) * bounced(occlusion, self.diffuse)
    }
}
