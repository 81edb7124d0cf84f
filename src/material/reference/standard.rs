//! Twin of `standard.glsl`: Lambert under GGX, coupled so that nothing is gained.
//!
//! Turquin 2019, "Practical multiple scattering compensation for microfacet models" (the specular factor);
//! Kelemen & Szirmay-Kalos 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model" (the reciprocal diffuse).

use super::albedo::Fit;
use super::ggx;
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
