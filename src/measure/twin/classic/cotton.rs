//! Classic cotton: two lobes of fuzz over Lambert.
//!
//! Estevez & Kulla 2017, "Production Friendly Microfacet Sheen BRDF" (distribution); Neubelt & Pettineo 2013, "Crafting
//! a Next-Gen Material Pipeline for The Order: 1886" (visibility); Lagarde & de Rousiers 2014, "Moving Frostbite to
//! Physically Based Rendering" (specular occlusion).

use super::super::domain::{self, COSINE, Domain, UNIT};
use super::super::sheen::{SheenLobe, around_two_lobes};
use super::super::{Twin, ggx, occlusion};
use crate::material::Sheen;
use glam::DVec3;
use std::f64::consts::PI;

/// Range of the roughness, of the base and of the sheen; passed on raw, as the width of the lobe.
///
/// Defect: at 0 the distribution is (2 + infinity) times 0. The range here starts where it was measured, at 0.005.
pub const ROUGHNESS: (f64, f64) = (0.005, 1.0);
/// Range of the colours.
pub const COLOR: (f64, f64) = (0.0, 1.0);

/// Charlie's distribution of normals; its integral with the cosine is 1.
pub fn ndf(h: DVec3, alpha: f64) -> f64 {
    let sine_squared = (1.0 - h.z * h.z).max(0.0);
    (2.0 + 1.0 / alpha) * sine_squared.powf(0.5 / alpha) / (2.0 * PI)
}

/// Visibility of cloth, which knows no roughness; both cosines in (0, 1].
pub fn visibility(mu_v: f64, mu_l: f64) -> f64 {
    1.0 / (4.0 * (mu_l + mu_v - mu_l * mu_v))
}

/// One lobe of fuzz with F = 1, times the cosine of `l`; 0 where a direction is at or below the horizon.
///
/// Defect: the visibility does not shrink as the distribution narrows: 1.35 times the light comes back at alpha 0.1, 5.6
/// times at 0.005.
pub fn fuzz_times_cosine(v: DVec3, l: DVec3, alpha: f64) -> f64 {
    if v.z <= 0.0 || l.z <= 0.0 {
        return 0.0;
    }
    ndf(ggx::half_vector(v, l), alpha) * visibility(v.z, l.z) * l.z
}

/// Share of the environment that a lobe sees through a crevice: all in [0, 1].
///
/// Defect: the roughness acts backwards: the widest lobe looking straight out sees all of a half open crevice.
pub fn occlusion_of_lobe(mu_v: f64, roughness: f64, occlusion: f64) -> f64 {
    let raised = if mu_v + occlusion > 0.0 { (mu_v + occlusion).powf(roughness * roughness) } else { 0.0 };
    (raised - 1.0 + occlusion).clamp(0.0, 1.0)
}

/// Cotton of one colour channel.
#[derive(Debug, Clone, Copy)]
pub struct Cotton {
    /// Albedo of the Lambert base, in [`COLOR`].
    pub base_color: f64,
    /// Largest channel and this channel of the sheen, in [`COLOR`].
    pub sheen_color: f64,
    /// Of the base's own lobe, in [`ROUGHNESS`].
    pub roughness: f64,
    /// Of the sheen, in [`ROUGHNESS`].
    pub sheen_roughness: f64,
}

impl Cotton {
    /// BRDF times the cosine of `l`; `sheen_albedo` is the table's entry for the view, the albedo of the sheen lobe
    /// saturated at 1.
    ///
    /// Defects: what the table saturates is gained; the base's own lobe is never taken from its diffuse.
    pub fn brdf_times_cosine(&self, sheen_albedo: f64, v: DVec3, l: DVec3) -> f64 {
        if v.z <= 0.0 || l.z <= 0.0 {
            return 0.0;
        }
        let fresnel = ggx::schlick(0.04, v.dot(ggx::half_vector(v, l)));
        let base = self.base_color / PI * l.z + fuzz_times_cosine(v, l, self.roughness) * fresnel;
        base * (1.0 - self.sheen_color * sheen_albedo)
            + self.sheen_color * fuzz_times_cosine(v, l, self.sheen_roughness)
    }
    /// Radiance under constant white radiance 1; `pile_albedo` is the table's entry for the base's own lobe, `occlusion` 1
    /// where the sky is open.
    pub fn ambient(&self, pile_albedo: f64, sheen_albedo: f64, mu_v: f64, occlusion: f64) -> f64 {
        let seen = |roughness, color| occlusion::bounced(occlusion_of_lobe(mu_v, roughness, occlusion), color);
        self.base_color * (1.0 - self.sheen_color * sheen_albedo) * occlusion
            + 0.04 * pile_albedo * seen(self.roughness, 0.04)
            + self.sheen_color * sheen_albedo * seen(self.sheen_roughness, self.sheen_color)
    }
}

/// What the shader's functions are held to.
pub(in crate::measure::twin) const TWINS: &[Twin] = &[
    Twin::new("cotton_classic_scale", &[UNIT, UNIT], |inputs| {
        let (sheen_color, albedo) = (inputs.vec3(), inputs.number());
        vec![1.0 - sheen_color.max_element() * albedo]
    }),
    Twin::new(
        "cotton_classic_brdf_times_cosine",
        around_two_lobes!([UNIT, UNIT], [Domain::Hemisphere, Domain::Hemisphere]),
        |inputs| {
            let (base_color, sheen_color) = (inputs.vec3(), inputs.vec3());
            let (pile, fibre) = (SheenLobe::new(inputs), SheenLobe::new(inputs));
            let (v, l) = (inputs.vec3(), inputs.vec3());
            if v.z <= 0.0 || l.z <= 0.0 {
                return vec![0.0; 3];
            }
            let lobe = |lobe: &SheenLobe| lobe.brdf_times_cosine(Sheen::Classic as u32, v, l);
            let fresnel = ggx::schlick(0.04, v.dot(ggx::half_vector(v, l)));
            let base = base_color / PI * l.z + lobe(&pile) * fresnel;
            let scale = 1.0 - sheen_color.max_element() * fibre.albedo;
            (base * scale + sheen_color * lobe(&fibre)).to_array().to_vec()
        },
    ),
    Twin::new("cotton_classic_occlusion", &[COSINE, domain::ROUGHNESS, UNIT], |inputs| {
        vec![occlusion_of_lobe(inputs.number(), inputs.number(), inputs.number())]
    }),
    Twin::new("cotton_classic_lobe_ambient", &[UNIT, UNIT, COSINE, domain::ROUGHNESS, UNIT, UNIT], |inputs| {
        let (color, albedo) = (inputs.vec3(), inputs.number());
        let seen = occlusion_of_lobe(inputs.number(), inputs.number(), inputs.number());
        let light = inputs.vec3();
        let bounced = DVec3::from(color.to_array().map(|color| occlusion::bounced(seen, color)));
        (color * albedo * bounced * light).to_array().to_vec()
    }),
];
