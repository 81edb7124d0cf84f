//! Twin of `satin.glsl`, and the whole of satin: a mixture of anisotropic lobes over a coupled diffuse base.
//!
//! `classic/satin.rs` has the formula of older engines, and its defects.

use super::albedo::Fit;
use super::anisotropy::Lobe;
use super::domain::{Domain, UNIT};
use super::standard::DIELECTRIC_F0;
use super::{Twin, ggx};
use glam::DVec3;
use std::f64::consts::PI;

/// What satin needs to know of a surface; ranges as [`Satin`](crate::material::Satin) declares them.
#[derive(Debug, Clone, Copy)]
pub struct Satin {
    /// Linear.
    pub base_color: DVec3,
    /// Tints the highlight with the base colour and takes the diffuse away.
    pub metallic: f64,
    /// Perceptual, of the narrow lobe.
    pub roughness: f64,
    /// Positive: stretched along the tangent.
    pub anisotropy: f64,
    /// In units of a dielectric's reflectance.
    pub specular_strength: f64,
    /// Of the narrow lobe.
    pub specular_color: DVec3,
    /// Of the wide lobe.
    pub secondary_color: DVec3,
    /// Roughness of the wide lobe, in that of the narrow one.
    pub secondary_width: f64,
    /// Half of each lobe is that of the opposite anisotropy.
    pub two_way: bool,
    /// How much of the light's own colour stays.
    pub light_tint: f64,
}

/// Reflectance that a lobe asks for, may exceed 1.
pub fn reflectance(color: DVec3, strength: f64, light_tint: f64) -> DVec3 {
    DIELECTRIC_F0 * strength * (color * (1.0 - light_tint) + color.max_element() * light_tint)
}

/// Share of the surface that a lobe has beside another; 0 of nothing.
pub fn share(reflectance: DVec3, other: DVec3) -> f64 {
    let sum = reflectance.max_element() + other.max_element();
    if sum < 1e-30 { 0.0 } else { reflectance.max_element() / sum }
}

/// Reflectance at normal incidence on that share.
pub fn f0(reflectance: DVec3, share: f64) -> DVec3 {
    (reflectance / share.max(1e-6)).min(DVec3::ONE)
}

/// What a lobe takes of a metal's own reflectance: all of it from the reflectance of plain plastic on.
pub fn metal(reflectance: DVec3) -> DVec3 {
    (reflectance / DIELECTRIC_F0).min(DVec3::ONE)
}

/// Reflectance at grazing incidence: a black lobe has none.
pub fn f90(f0: DVec3) -> f64 {
    (50.0 * f0.max_element()).min(1.0)
}

impl Satin {
    /// The lobes that are not black, with their shares, which add up to 1.
    pub fn lobes(&self) -> Vec<(f64, Lobe)> {
        let narrow = reflectance(self.specular_color, self.specular_strength, self.light_tint);
        let wide = reflectance(self.secondary_color, self.specular_strength, self.light_tint);
        let wide_roughness = (self.roughness * self.secondary_width).min(1.0);
        let mut lobes = Vec::new();
        for (own, other, roughness) in [(narrow, wide, self.roughness), (wide, narrow, wide_roughness)] {
            let share = share(own, other);
            if share == 0.0 {
                continue;
            }
            let f0 = f0(own, share).lerp(self.base_color * metal(own), self.metallic);
            let (ax, ay) = ggx::anisotropic_alpha(roughness, self.anisotropy);
            let lobe = Lobe { f0, f90: f90(f0), alpha: (ax, ay) };
            if self.two_way {
                lobes.push((share / 2.0, lobe));
                lobes.push((share / 2.0, Lobe { alpha: (ay, ax), ..lobe }));
            } else {
                lobes.push((share, lobe));
            }
        }
        lobes
    }

    /// Albedo of the highlight towards `w`, by the fit.
    pub fn highlight_albedo(&self, fit: &Fit, w: DVec3) -> DVec3 {
        self.lobes().iter().map(|(share, lobe)| *share * lobe.albedo(fit, w)).sum()
    }

    /// Diffuse albedo before the coupling.
    fn diffuse(&self) -> DVec3 {
        self.base_color * (1.0 - self.metallic)
    }

    /// The diffuse lobe alone, without its cosine. Reciprocal.
    pub fn diffuse_brdf(&self, fit: &Fit, v: DVec3, l: DVec3) -> DVec3 {
        let average: DVec3 = self.lobes().iter().map(|(share, lobe)| *share * lobe.average_albedo(fit)).sum();
        let left = |w| 1.0 - self.highlight_albedo(fit, w);
        self.diffuse() / PI * left(v) * left(l) / (1.0 - average).max(DVec3::splat(1e-4))
    }

    /// BRDF times the cosine of `l`; 0 where a direction is at or below the horizon.
    pub fn brdf_times_cosine(&self, fit: &Fit, v: DVec3, l: DVec3) -> DVec3 {
        if v.z <= 0.0 || l.z <= 0.0 {
            return DVec3::ZERO;
        }
        let highlight: DVec3 = self.lobes().iter().map(|(share, lobe)| *share * lobe.times_cosine(fit, v, l)).sum();
        highlight + self.diffuse_brdf(fit, v, l) * l.z
    }

    /// Radiance under constant white radiance 1, by the fit.
    pub fn ambient(&self, fit: &Fit, v: DVec3) -> DVec3 {
        let highlight = self.highlight_albedo(fit, v);
        highlight + self.diffuse() * (1.0 - highlight)
    }
}

/// 0.04 times the largest strength.
const REFLECTANCE: Domain = Domain::Uniform(0.0, 1.2, &[0.0, 1e-40, 1e-8, 0.04, 1.0, 1.2]);
const STRENGTH: Domain = Domain::Uniform(0.0, 30.0, &[0.0, 1e-40, 1.0, 30.0]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("satin_largest", &[UNIT], |inputs| vec![inputs.vec3().max_element()]),
    Twin::new("satin_reflectance", &[UNIT, STRENGTH, UNIT], |inputs| {
        reflectance(inputs.vec3(), inputs.number(), inputs.number()).to_array().to_vec()
    }),
    Twin::new("satin_share", &[REFLECTANCE, REFLECTANCE], |inputs| vec![share(inputs.vec3(), inputs.vec3())]),
    Twin::new("satin_f0", &[REFLECTANCE, UNIT], |inputs| f0(inputs.vec3(), inputs.number()).to_array().to_vec()),
    Twin::new("satin_metal", &[REFLECTANCE], |inputs| metal(inputs.vec3()).to_array().to_vec()),
    Twin::new("satin_f90", &[UNIT], |inputs| vec![f90(inputs.vec3())]),
    Twin::new("satin_noise", &[UNIT], |inputs| vec![0.5 + 0.5 * inputs.number()]),
];
