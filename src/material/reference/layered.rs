//! Twin of `layered.glsl`: the standard surface with the lobes of glTF's material extensions.
//!
//! Khronos, KHR_materials_{specular, ior, anisotropy, clearcoat, sheen, diffuse_transmission}. From the top: varnish,
//! sheen, base. What a layer takes towards the eye or the light, whichever is more, is missing under it.

use super::albedo::Fit;
use super::anisotropy::Lobe;
use super::{ggx, sheen};
use crate::material::{Sheen, SheenTable};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Reflectance at normal incidence of varnish, a dielectric of index 1.5.
pub const COAT_F0: f64 = 0.04;

/// Reflectance at normal incidence of a dielectric in air; index 0 reflects everything.
pub fn f0_of_ior(ior: f64) -> f64 {
    ((ior - 1.0) / (ior + 1.0)).powi(2)
}

/// GGX widths along and across the direction of anisotropy.
pub fn widths(roughness: f64, anisotropy: f64) -> (f64, f64) {
    let alpha = ggx::alpha_of_roughness(roughness);
    (alpha * (1.0 - anisotropy * anisotropy) + anisotropy * anisotropy, alpha)
}

/// The base: a lobe over what is scattered to both sides.
#[derive(Debug, Clone, Copy)]
pub struct Base {
    /// The highlight.
    pub lobe: Lobe,
    /// Albedo of what is scattered to this side, before the coupling.
    pub reflected: DVec3,
    /// And to the other side; both together at most 1.
    pub transmitted: DVec3,
}

/// What a material says of a grey base.
#[derive(Debug, Clone, Copy)]
pub struct Parameters {
    /// Linear, [0, 1].
    pub base_color: f64,
    /// [0, 1].
    pub metallic: f64,
    /// Perceptual, [0, 1].
    pub roughness: f64,
    /// [0, 1].
    pub anisotropy: f64,
    /// Index of refraction, 0 or at least 1.
    pub ior: f64,
    /// Strength of the dielectric's reflection, [0, 1].
    pub specular: f64,
    /// Factor on its reflectance at normal incidence, at least 0.
    pub specular_color: f64,
    /// Share of the scattered light that goes through, [0, 1].
    pub diffuse_transmission: f64,
}

impl Base {
    /// The base of a material.
    pub fn new(parameters: &Parameters) -> Self {
        let Parameters { base_color, metallic, .. } = *parameters;
        let dielectric = (f0_of_ior(parameters.ior) * parameters.specular_color).min(1.0) * parameters.specular;
        let mix = |dielectric: f64, metal: f64| dielectric * (1.0 - metallic) + metal * metallic;
        let lobe = Lobe {
            f0: DVec3::splat(mix(dielectric, base_color)),
            f90: mix(parameters.specular, 1.0),
            alpha: widths(parameters.roughness, parameters.anisotropy),
        };
        let through = parameters.diffuse_transmission;
        Self {
            lobe,
            reflected: DVec3::splat(base_color * (1.0 - metallic) * (1.0 - through)),
            transmitted: DVec3::splat((1.0 - metallic) * through),
        }
    }

    /// What is scattered towards `v` of light from `l`, of either side, without its cosine: reciprocal.
    pub fn scattered(&self, fit: &Fit, v: DVec3, l: DVec3) -> DVec3 {
        let left = |w: DVec3| 1.0 - self.lobe.albedo(fit, w.with_z(w.z.abs()));
        let albedo = if l.z < 0.0 { self.transmitted } else { self.reflected };
        albedo / PI * left(v) * left(l) / (1.0 - self.lobe.average_albedo(fit)).max(DVec3::splat(1e-4))
    }

    /// BSDF times the cosine of `l`.
    pub fn times_cosine(&self, fit: &Fit, v: DVec3, l: DVec3) -> DVec3 {
        self.lobe.times_cosine(fit, v, l) + self.scattered(fit, v, l) * l.z.abs()
    }

    /// Radiance under constant white radiance 1 from both sides.
    pub fn ambient(&self, fit: &Fit, v: DVec3) -> DVec3 {
        let specular = self.lobe.albedo(fit, v);
        specular + (self.reflected + self.transmitted) * (1.0 - specular)
    }
}

/// The lobe of a whole coat of varnish.
pub fn coat(roughness: f64) -> Lobe {
    let alpha = ggx::alpha_of_roughness(roughness);
    Lobe { f0: DVec3::splat(COAT_F0), f90: 1.0, alpha: (alpha, alpha) }
}

/// By how much a lobe of fuzz may exceed the straight lines between the nodes of its table.
pub const SHEEN_TABLE_MARGIN: f64 = 1.018;

/// Albedo of fuzz that dims what is under it, from that of its table.
pub fn sheen_albedo(table_albedo: f64) -> f64 {
    (SHEEN_TABLE_MARGIN * table_albedo).min(1.0)
}

/// What a layer of that strength leaves under it; `albedo` towards the eye and the light.
pub fn under(strength: f64, albedo: DVec2) -> f64 {
    (1.0 - strength * albedo.max_element()).clamp(0.0, 1.0)
}

/// A base with all that lies on it, everything grey.
#[derive(Debug, Clone, Copy)]
pub struct Stack<'a> {
    /// What lies below.
    pub base: Base,
    /// Of the fuzz, [0, 1].
    pub sheen_color: f64,
    /// Perceptual, [0, 1].
    pub sheen_roughness: f64,
    /// Share of the varnish, [0, 1].
    pub clearcoat: f64,
    /// Perceptual, [0, 1].
    pub clearcoat_roughness: f64,
    /// Albedos of the fuzz.
    pub table: &'a SheenTable,
}

impl Stack<'_> {
    fn fuzz(&self) -> sheen::Lobe<'_> {
        sheen::Lobe { table: self.table, sheet: Sheen::Charlie, roughness: self.sheen_roughness }
    }

    /// What the whole fuzz and the whole varnish take towards `w`.
    fn albedos(&self, fit: &Fit, w: DVec3) -> (f64, f64) {
        let mu = w.z.abs();
        (sheen_albedo(self.fuzz().entry(mu).albedo), coat(self.clearcoat_roughness).albedo(fit, w.with_z(mu)).x)
    }

    /// What fuzz and varnish leave between two directions: of what lies under the varnish, and under both.
    pub fn left(&self, fit: &Fit, v: DVec3, l: DVec3) -> (f64, f64) {
        let ((fuzz_v, coat_v), (fuzz_l, coat_l)) = (self.albedos(fit, v), self.albedos(fit, l));
        let under_coat = under(self.clearcoat, DVec2::new(coat_v, coat_l));
        (under_coat, under_coat * under(self.sheen_color, DVec2::new(fuzz_v, fuzz_l)))
    }

    /// The fuzz times the cosine of `l`, as if nothing lay on it.
    pub fn fuzz_times_cosine(&self, v: DVec3, l: DVec3) -> f64 {
        self.sheen_color * self.fuzz().times_cosine(v, l)
    }

    /// The varnish times the cosine of `l`.
    pub fn coat_times_cosine(&self, fit: &Fit, v: DVec3, l: DVec3) -> f64 {
        self.clearcoat * coat(self.clearcoat_roughness).times_cosine(fit, v, l).x
    }

    /// BSDF of the whole times the cosine of `l`.
    pub fn times_cosine(&self, fit: &Fit, v: DVec3, l: DVec3) -> f64 {
        let (under_coat, under_both) = self.left(fit, v, l);
        self.coat_times_cosine(fit, v, l)
            + under_coat * self.fuzz_times_cosine(v, l)
            + under_both * self.base.times_cosine(fit, v, l).x
    }

    /// Radiance of the whole under constant white radiance 1: layers dim what is under them by the eye's side alone.
    pub fn ambient(&self, fit: &Fit, v: DVec3) -> f64 {
        let (fuzz, varnish) = self.albedos(fit, v);
        let (left, varnish) = (under(self.sheen_color, DVec2::splat(fuzz)), self.clearcoat * varnish);
        let fuzz = self.sheen_color * self.fuzz().entry(v.z).albedo;
        varnish + (1.0 - varnish) * (fuzz + left * self.base.ambient(fit, v).x)
    }
}

/// Share of the light from straight behind that comes through: what the base does not reflect, tinted by its colour.
pub fn through(transmission: f64, metallic: f64, base_color: DVec3, albedo: DVec3) -> DVec3 {
    transmission * (1.0 - metallic) * base_color * (1.0 - albedo)
}
