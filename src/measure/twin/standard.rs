//! Twin of `standard.glsl`: Lambert under GGX, coupled so that nothing is gained.
//!
//! Turquin 2019, "Practical multiple scattering compensation for microfacet models" (the specular factor);
//! Kelemen & Szirmay-Kalos 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model" (the reciprocal diffuse).

use super::albedo::{AVERAGE_ROUNDING, FIT, FRESNEL_ROUNDING, Fit, WHITE_ROUNDING};
use super::domain::{ALPHA, COSINE, Domain, RADIANCE, ROUGHNESS, UNIT};
use super::{TestInputs, Twin, ggx};
use glam::DVec3;
use std::f64::consts::PI;

/// Reflectance at normal incidence of a dielectric of index 1.5.
pub const DIELECTRIC_F0: f64 = 0.04;

/// What the BRDF needs to know of the surface.
#[derive(Debug, Clone, Copy)]
pub struct Surface {
    /// Linear, [0, 1].
    pub base_color: DVec3,
    /// [0, 1].
    pub metallic: f64,
    /// Perceptual, [0, 1].
    pub roughness: f64,
}

impl Surface {
    /// What its two lobes reflect.
    pub fn lobes(&self) -> Lobes {
        Lobes {
            f0: DVec3::splat(DIELECTRIC_F0).lerp(self.base_color, self.metallic),
            diffuse: self.base_color * (1.0 - self.metallic),
            roughness: self.roughness,
        }
    }

    /// [`Lobes::diffuse_brdf`].
    pub fn diffuse_brdf(&self, fit: &Fit, mu_v: f64, mu_l: f64) -> DVec3 {
        self.lobes().diffuse_brdf(fit, mu_v, mu_l)
    }

    /// [`Lobes::specular_compensation`].
    pub fn specular_compensation(&self, fit: &Fit, mu_v: f64) -> DVec3 {
        self.lobes().specular_compensation(fit, mu_v)
    }

    /// [`Lobes::single_scattering_times_cosine`].
    pub fn single_scattering_times_cosine(&self, v: DVec3, l: DVec3) -> DVec3 {
        self.lobes().single_scattering_times_cosine(v, l)
    }

    /// [`Lobes::brdf_times_cosine`].
    pub fn brdf_times_cosine(&self, fit: &Fit, v: DVec3, l: DVec3) -> DVec3 {
        self.lobes().brdf_times_cosine(fit, v, l)
    }

    /// [`Lobes::ambient`].
    pub fn ambient(&self, fit: &Fit, mu_v: f64) -> DVec3 {
        self.lobes().ambient(fit, mu_v)
    }
}

/// GGX over Lambert, whatever gave them their colours.
#[derive(Debug, Clone, Copy)]
pub struct Lobes {
    /// Reflectance at normal incidence, linear, [0, 1].
    pub f0: DVec3,
    /// Diffuse albedo before the coupling, linear, [0, 1].
    pub diffuse: DVec3,
    /// Perceptual, [0, 1].
    pub roughness: f64,
}

impl Lobes {
    /// The diffuse lobe alone, without its cosine: `rho / pi (1 - E(v)) (1 - E(l)) / (1 - E_average)`. Reciprocal.
    pub fn diffuse_brdf(&self, fit: &Fit, mu_v: f64, mu_l: f64) -> DVec3 {
        per_channel(|channel| {
            let f0 = self.f0[channel];
            let left = |mu| 1.0 - fit.compensated_albedo(f0, mu, self.roughness);
            let average = (1.0 - fit.average_compensated_albedo(f0, self.roughness)).max(1e-4);
            self.diffuse[channel] / PI * left(mu_v) * left(mu_l) / average
        })
    }

    /// Turquin's factor on the specular lobe, seen at the cosine `mu_v`: `1 + F0 (1 - E1(v)) / E1(v)`.
    pub fn specular_compensation(&self, fit: &Fit, mu_v: f64) -> DVec3 {
        let (white, _) = fit.terms(mu_v, self.roughness);
        per_channel(|channel| 1.0 + self.f0[channel] * (1.0 - white) / white)
    }

    /// The specular lobe before the compensation, times `mu_l`: what GGX scatters once. 0 where a direction is at or
    /// below the horizon.
    pub fn single_scattering_times_cosine(&self, v: DVec3, l: DVec3) -> DVec3 {
        let alpha = ggx::alpha_of_roughness(self.roughness);
        let h = ggx::half_vector(v, l);
        let lobe = ggx::ndf(h, alpha, alpha) * ggx::masking_shadowing_times_cosine(v, l, alpha, alpha);
        per_channel(|channel| lobe * ggx::schlick(self.f0[channel], v.dot(h)))
    }

    /// BRDF times `mu_l`; 0 where a direction is at or below the horizon.
    pub fn brdf_times_cosine(&self, fit: &Fit, v: DVec3, l: DVec3) -> DVec3 {
        if v.z <= 0.0 || l.z <= 0.0 {
            return DVec3::ZERO;
        }
        let specular = self.specular_compensation(fit, v.z) * self.single_scattering_times_cosine(v, l);
        specular + self.diffuse_brdf(fit, v.z, l.z) * l.z
    }

    /// Radiance under constant white radiance 1, by the fit.
    pub fn ambient(&self, fit: &Fit, mu_v: f64) -> DVec3 {
        per_channel(|channel| {
            let specular = fit.compensated_albedo(self.f0[channel], mu_v, self.roughness);
            specular + self.diffuse[channel] * (1.0 - specular)
        })
    }
}

fn per_channel(value: impl Fn(usize) -> f64) -> DVec3 {
    DVec3::new(value(0), value(1), value(2))
}

/// Members of `StandardSurface`.
struct StandardSurface {
    f0: DVec3,
    roughness: f64,
    diffuse: DVec3,
    alpha_x: f64,
    coupled_diffuse: DVec3,
    alpha_y: f64,
    specular_compensation: DVec3,
    specular_albedo: DVec3,
}

impl StandardSurface {
    fn new(inputs: &mut TestInputs<'_>) -> Self {
        Self {
            f0: inputs.vec3(),
            roughness: inputs.number(),
            diffuse: inputs.vec3(),
            alpha_x: inputs.number(),
            coupled_diffuse: inputs.vec3(),
            alpha_y: inputs.number(),
            specular_compensation: inputs.vec3(),
            specular_albedo: inputs.vec3(),
        }
    }

    fn coupled(f0: DVec3, diffuse: DVec3, roughness: f64, mu_v: f64) -> Self {
        let of_each = |value: &dyn Fn(f64) -> f64| DVec3::from_array(f0.to_array().map(value));
        let specular_albedo = of_each(&|f0| FIT.compensated_albedo(f0, mu_v, roughness));
        let average = of_each(&|f0| FIT.average_compensated_albedo(f0, roughness));
        let (white, _) = FIT.terms(mu_v, roughness);
        let alpha = ggx::alpha_of_roughness(roughness);
        Self {
            f0,
            roughness,
            diffuse,
            alpha_x: alpha,
            coupled_diffuse: diffuse / PI * (1.0 - specular_albedo) / (1.0 - average).max(DVec3::splat(1e-4)),
            alpha_y: alpha,
            specular_compensation: 1.0 + f0 * (1.0 - white) / white.max(1e-3),
            specular_albedo,
        }
    }

    fn words(&self) -> Vec<f64> {
        let mut words = Vec::with_capacity(18);
        words.extend(self.f0.to_array());
        words.push(self.roughness);
        words.extend(self.diffuse.to_array());
        words.push(self.alpha_x);
        words.extend(self.coupled_diffuse.to_array());
        words.push(self.alpha_y);
        words.extend(self.specular_compensation.to_array());
        words.extend(self.specular_albedo.to_array());
        words
    }
}

/// Of the compensation: 1 / E1 of the roughest white surface is 3.3.
const COMPENSATION: Domain = Domain::Uniform(1.0, 3.3, &[1.0, 3.3]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("standard_coupled", &[UNIT, UNIT, ROUGHNESS, COSINE], |inputs| {
        let (f0, diffuse, roughness, mu_v) = (inputs.vec3(), inputs.vec3(), inputs.number(), inputs.number());
        StandardSurface::coupled(f0, diffuse, roughness, mu_v).words()
    })
    .limit(2e-5, WHITE_ROUNDING + FRESNEL_ROUNDING)
    // Under a white mirror next to nothing is left for the diffuse lobe: the quotient of what is left of both albedos
    // carries their errors, and is multiplied by as little again.
    .allowance(|inputs| {
        let (f0, diffuse, roughness, _) = (inputs.vec3(), inputs.vec3(), inputs.number(), inputs.number());
        let quotient = |at: usize| {
            let left = (1.0 - FIT.average_compensated_albedo(f0[at], roughness)).max(1e-4);
            diffuse[at] / PI * (WHITE_ROUNDING + FRESNEL_ROUNDING + AVERAGE_ROUNDING) / left
        };
        let mut allowed = vec![0.0; 18];
        (0..3).for_each(|at| allowed[8 + at] = quotient(at));
        allowed
    }),
    Twin::new("standard_surface", &[UNIT, UNIT, ROUGHNESS, COSINE], |inputs| {
        let (base_color, metallic, roughness, mu_v) =
            (inputs.vec3(), inputs.number(), inputs.number(), inputs.number());
        let f0 = DVec3::splat(0.04).lerp(base_color, metallic);
        StandardSurface::coupled(f0, base_color * (1.0 - metallic), roughness, mu_v).words()
    })
    // Errors of E1 and Q add up in the albedo, the largest of what follows from them.
    .limit(2e-5, WHITE_ROUNDING + FRESNEL_ROUNDING),
    Twin::new(
        "standard_brdf_times_cosine",
        &[UNIT, ROUGHNESS, UNIT, ALPHA, UNIT, ALPHA, COMPENSATION, UNIT, Domain::Hemisphere, Domain::Hemisphere],
        |inputs| {
            let (surface, v, l) = (StandardSurface::new(inputs), inputs.vec3(), inputs.vec3());
            if v.z <= 0.0 || l.z <= 0.0 {
                return vec![0.0; 3];
            }
            let h = ggx::half_vector(v, l);
            let lobe = ggx::ndf(h, surface.alpha_x, surface.alpha_y)
                * ggx::masking_shadowing_times_cosine(v, l, surface.alpha_x, surface.alpha_y);
            let channel = |at: usize| {
                let fresnel = ggx::schlick(surface.f0[at], v.dot(h));
                let left = 1.0 - FIT.compensated_albedo(surface.f0[at], l.z, surface.roughness);
                fresnel * surface.specular_compensation[at] * lobe + surface.coupled_diffuse[at] * left * l.z
            };
            vec![channel(0), channel(1), channel(2)]
        },
    ),
    Twin::new(
        "standard_ambient",
        &[UNIT, ROUGHNESS, UNIT, ALPHA, UNIT, ALPHA, COMPENSATION, UNIT, RADIANCE, RADIANCE],
        |inputs| {
            let (surface, mirrored, scattered) = (StandardSurface::new(inputs), inputs.vec3(), inputs.vec3());
            let left = 1.0 - surface.specular_albedo;
            (surface.specular_albedo * mirrored + surface.diffuse * left * scattered).to_array().to_vec()
        },
    ),
];
