//! Twin of `fuzz.glsl`: a Lambert base under the fuzz of its pile and of standing fibres.
//!
//! Kelemen & Szirmay-Kalos 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model" (the base).

use super::domain::{Domain, UNIT};
use super::sheen::{Lobe, MODEL, SheenLobe, around_two_lobes};
use super::{TestInputs, Twin, occlusion};
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

/// Members of `FuzzSurface`.
struct FuzzSurface {
    diffuse: DVec3,
    coupled_diffuse: DVec3,
    pile_color: DVec3,
    fibre_color: DVec3,
    pile: SheenLobe,
    fibre: SheenLobe,
}

impl FuzzSurface {
    fn new(inputs: &mut TestInputs<'_>) -> Self {
        Self {
            diffuse: inputs.vec3(),
            coupled_diffuse: inputs.vec3(),
            pile_color: inputs.vec3(),
            fibre_color: inputs.vec3(),
            pile: SheenLobe::new(inputs),
            fibre: SheenLobe::new(inputs),
        }
    }

    fn words(&self) -> Vec<f64> {
        let colors = [self.diffuse, self.coupled_diffuse, self.pile_color, self.fibre_color];
        let colors = colors.iter().flat_map(DVec3::to_array);
        colors.chain(self.pile.words()).chain(self.fibre.words()).collect()
    }
}

/// Of `has_fibre`.
const FLAG: Domain = Domain::Choice(&[0, 1]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("fuzz_surface", around_two_lobes!([UNIT, UNIT, UNIT], []), |inputs| {
        let (diffuse, pile_color, fibre_color) = (inputs.vec3(), inputs.vec3(), inputs.vec3());
        let (pile, fibre) = (SheenLobe::new(inputs), SheenLobe::new(inputs));
        let seen = pile_color * (1.0 - fibre_color);
        let of_both = |pile: f64, fibre: f64| seen * pile + fibre_color * fibre;
        let left = 1.0 - of_both(pile.albedo, fibre.albedo);
        let average = 1.0 - of_both(pile.average, fibre.average);
        let coupled_diffuse = diffuse / PI * left / average.max(DVec3::splat(1e-4));
        FuzzSurface { diffuse, coupled_diffuse, pile_color: seen, fibre_color, pile, fibre }.words()
    }),
    Twin::new(
        "fuzz_brdf_times_cosine",
        around_two_lobes!([MODEL, FLAG, UNIT, UNIT, UNIT, UNIT], [Domain::Hemisphere, Domain::Hemisphere, UNIT]),
        |inputs| {
            let (model, has_fibre, surface) = (inputs.uint(), inputs.uint() != 0, FuzzSurface::new(inputs));
            let (v, l, albedo_l) = (inputs.vec3(), inputs.vec3(), inputs.vec2());
            if v.z <= 0.0 || l.z <= 0.0 {
                return vec![0.0; 3];
            }
            let fibre_color = if has_fibre { surface.fibre_color } else { DVec3::ZERO };
            let lobes = surface.pile_color * surface.pile.brdf_times_cosine(model, v, l)
                + fibre_color * surface.fibre.brdf_times_cosine(model, v, l);
            let left = 1.0 - surface.pile_color * albedo_l.x - fibre_color * albedo_l.y;
            (lobes + surface.coupled_diffuse * left * l.z).to_array().to_vec()
        },
    ),
    Twin::new("fuzz_ambient", around_two_lobes!([UNIT, UNIT, UNIT, UNIT], [UNIT, UNIT, UNIT]), |inputs| {
        let surface = FuzzSurface::new(inputs);
        let (pile_light, fibre_light, base_light) = (inputs.vec3(), inputs.vec3(), inputs.vec3());
        let pile = surface.pile_color * surface.pile.albedo;
        let fibre = surface.fibre_color * surface.fibre.albedo;
        let base = surface.diffuse * (1.0 - pile - fibre);
        (pile * pile_light + fibre * fibre_light + base * base_light).to_array().to_vec()
    }),
];
