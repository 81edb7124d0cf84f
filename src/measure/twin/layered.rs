//! Twin of `layered.glsl`: the standard surface with the lobes of glTF's material extensions.
//!
//! Khronos, KHR_materials_{specular, ior, anisotropy, clearcoat, sheen, diffuse_transmission}. From the top: varnish,
//! sheen, base. What a layer takes towards the eye or the light, whichever is more, is missing under it.

use super::albedo::{FIT, FRESNEL_ROUNDING, Fit, WHITE_ROUNDING};
use super::anisotropy::{COMPENSATION, Lobe, Seen};
use super::domain::{ALPHA, COSINE, Domain, RADIANCE, ROUGHNESS, UNIT};
use super::{TestInputs, Twin, ggx, sheen};
use crate::material::{Sheen, SheenTable};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Reflectance at normal incidence of varnish, a dielectric of index 1.5.
pub const CLEARCOAT_F0: f64 = 0.04;

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

/// The lobe of a clearcoat that covers everything.
pub fn clearcoat(roughness: f64) -> Lobe {
    let alpha = ggx::alpha_of_roughness(roughness);
    Lobe { f0: DVec3::splat(CLEARCOAT_F0), f90: 1.0, alpha: (alpha, alpha) }
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
        (sheen_albedo(self.fuzz().entry(mu).albedo), clearcoat(self.clearcoat_roughness).albedo(fit, w.with_z(mu)).x)
    }

    /// What fuzz and varnish leave between two directions: of what lies under the varnish, and under both.
    pub fn left(&self, fit: &Fit, v: DVec3, l: DVec3) -> (f64, f64) {
        let ((fuzz_v, varnish_v), (fuzz_l, varnish_l)) = (self.albedos(fit, v), self.albedos(fit, l));
        let under_clearcoat = under(self.clearcoat, DVec2::new(varnish_v, varnish_l));
        (under_clearcoat, under_clearcoat * under(self.sheen_color, DVec2::new(fuzz_v, fuzz_l)))
    }

    /// The fuzz times the cosine of `l`, as if nothing lay on it.
    pub fn fuzz_times_cosine(&self, v: DVec3, l: DVec3) -> f64 {
        self.sheen_color * self.fuzz().times_cosine(v, l)
    }

    /// The varnish times the cosine of `l`.
    pub fn clearcoat_times_cosine(&self, fit: &Fit, v: DVec3, l: DVec3) -> f64 {
        self.clearcoat * clearcoat(self.clearcoat_roughness).times_cosine(fit, v, l).x
    }

    /// BSDF of the whole times the cosine of `l`.
    pub fn times_cosine(&self, fit: &Fit, v: DVec3, l: DVec3) -> f64 {
        let (under_clearcoat, under_both) = self.left(fit, v, l);
        self.clearcoat_times_cosine(fit, v, l)
            + under_clearcoat * self.fuzz_times_cosine(v, l)
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

/// Index of refraction: 0, or from that of air to beyond any that there is.
const IOR: Domain = Domain::Uniform(1.0, 4.0, &[0.0, 1.0, 1.0 + f32::EPSILON, 1.5, 1e30]);
/// Diffuse albedo of one side.
const HALF: Domain = Domain::Uniform(0.0, 0.5, &[0.0, 1e-40, 0.5]);
/// Diffuse albedo coupled to a lobe and divided by pi; the divisor is 1 - E_average, which no lobe that leaves light has
/// below 0.1.
const COUPLED: Domain = Domain::Uniform(0.0, 3.0, &[0.0, 1e-40, 3.0]);

/// E = (F0 + (F90 - F0) Q) (E1 + F0 (1 - E1)).
fn albedo(f0: DVec3, f90: f64, terms: DVec2) -> DVec3 {
    f0.lerp(DVec3::splat(f90), terms.y) * f0.lerp(DVec3::ONE, terms.x)
}

/// The average of the product of the two factors of [`albedo`], term by term.
fn average(f0: DVec3, f90: f64, averages: DVec3) -> DVec3 {
    let (both, white, fresnel) = (averages.x, averages.y, averages.z);
    let rest = f90 - f0;
    f0 * f0 + f0 * (1.0 - f0) * white + rest * f0 * fresnel + rest * (1.0 - f0) * both
}

fn vec2(inputs: &mut TestInputs<'_>) -> (f64, f64) {
    (inputs.number(), inputs.number())
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("layered_f0_of_ior", &[IOR], |inputs| vec![f0_of_ior(inputs.number())]).rule(super::Rule::Conditioned(1)),
    Twin::new("layered_widths", &[ROUGHNESS, UNIT], |inputs| {
        let (along, across) = widths(inputs.number(), inputs.number());
        vec![along, across]
    })
    .limit(2e-5, 0.0),
    Twin::new("layered_left", &[UNIT, UNIT, UNIT], |inputs| {
        let (f0, f90, terms) = (inputs.vec3(), inputs.number(), inputs.vec2());
        (1.0 - albedo(f0, f90, terms)).to_array().to_vec()
    }),
    Twin::new("layered_average_left", &[UNIT, UNIT, UNIT], |inputs| {
        let (f0, f90, terms) = (inputs.vec3(), inputs.number(), inputs.vec3());
        (1.0 - average(f0, f90, terms)).to_array().to_vec()
    }),
    Twin::new("layered_base", &[UNIT, UNIT, ALPHA, UNIT, UNIT, HALF, HALF], |inputs| {
        let (f0, f90, (ax, ay), terms, averages) =
            (inputs.vec3(), inputs.number(), vec2(inputs), inputs.vec2(), inputs.vec3());
        let (reflected, transmitted) = (inputs.vec3(), inputs.vec3());
        let albedo = albedo(f0, f90, terms);
        let coupling = (1.0 - albedo) / (PI * (1.0 - average(f0, f90, averages)).max(DVec3::splat(1e-4)));
        let mut words = f0.to_array().to_vec();
        words.push(f90);
        words.extend((1.0 + f0 * (1.0 - terms.x) / terms.x.max(1e-3)).to_array());
        words.extend([ax, ay]);
        let rest = [albedo, reflected, transmitted, reflected * coupling, transmitted * coupling];
        words.extend(rest.iter().flat_map(|value| value.to_array()));
        words
    })
    // Where a lobe takes all the light, what it leaves is a difference.
    .rule(super::Rule::Conditioned(2)),
    Twin::new(
        "layered_base_times_cosine",
        &[
            UNIT,
            UNIT,
            COMPENSATION,
            ALPHA,
            ALPHA,
            UNIT,
            HALF,
            HALF,
            COUPLED,
            COUPLED,
            Domain::Hemisphere,
            Domain::Direction,
            UNIT,
        ],
        |inputs| {
            let seen = Seen::new(inputs);
            let _albedos = [inputs.vec3(), inputs.vec3(), inputs.vec3()];
            let (reflected, transmitted) = (inputs.vec3(), inputs.vec3());
            let (v, l, terms) = (inputs.vec3(), inputs.vec3(), inputs.vec2());
            if v.z <= 0.0 {
                return vec![0.0; 3];
            }
            let left = 1.0 - albedo(seen.lobe.f0, seen.lobe.f90, terms);
            let scattered = if l.z < 0.0 { transmitted } else { reflected } * left * l.z.abs();
            (seen.times_cosine(v, l) + scattered).to_array().to_vec()
        },
    ),
    Twin::new(
        "layered_base_ambient",
        &[UNIT, UNIT, COMPENSATION, ALPHA, ALPHA, UNIT, HALF, HALF, COUPLED, COUPLED, RADIANCE, RADIANCE, RADIANCE],
        |inputs| {
            let _ = Seen::new(inputs);
            let (albedo, reflected, transmitted) = (inputs.vec3(), inputs.vec3(), inputs.vec3());
            let _coupled = [inputs.vec3(), inputs.vec3()];
            let (mirrored, before, behind) = (inputs.vec3(), inputs.vec3(), inputs.vec3());
            let scattered = reflected * before + transmitted * behind;
            (albedo * mirrored + (1.0 - albedo) * scattered).to_array().to_vec()
        },
    ),
    Twin::new("layered_coat_albedo", &[COSINE, ROUGHNESS], |inputs| {
        vec![FIT.compensated_albedo(CLEARCOAT_F0, inputs.number(), inputs.number())]
    })
    .limit(2e-5, WHITE_ROUNDING + FRESNEL_ROUNDING),
    Twin::new("layered_coat_compensation", &[COSINE, ROUGHNESS], |inputs| {
        let (white, _) = FIT.terms(inputs.number(), inputs.number());
        vec![1.0 + CLEARCOAT_F0 * (1.0 - white) / white.max(1e-3)]
    })
    .limit(2e-5, WHITE_ROUNDING),
    Twin::new("layered_coat_times_cosine", &[ROUGHNESS, Domain::Hemisphere, Domain::Direction], |inputs| {
        let (lobe, v, l) = (clearcoat(inputs.number()), inputs.vec3(), inputs.vec3());
        vec![lobe.single_scattering_times_cosine(v, l).x]
    }),
    Twin::new("layered_sheen_albedo", &[UNIT], |inputs| vec![sheen_albedo(inputs.number())]),
    Twin::new("layered_under", &[UNIT, UNIT, UNIT], |inputs| vec![under(inputs.number(), inputs.vec2())]),
    Twin::new("layered_through", &[UNIT, UNIT, UNIT, UNIT], |inputs| {
        through(inputs.number(), inputs.number(), inputs.vec3(), inputs.vec3()).to_array().to_vec()
    }),
];
