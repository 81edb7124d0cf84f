//! Judges `cotton.glsl`: the classic form.

use super::super::domain::{COSINE, Domain, ROUGHNESS, UNIT};
use super::super::twin::Twin;
use super::sheen::{Lobe, around_two_lobes};
use crate::material::Sheen;
use crate::material::reference::{fuzz, ggx};
use std::f64::consts::PI;

pub(super) const TWINS: &[Twin] = &[
    Twin::new("cotton_classic_scale", &[UNIT, UNIT], |given| {
        let (sheen_color, albedo) = (given.vec3(), given.number());
        vec![1.0 - sheen_color.max_element() * albedo]
    }),
    Twin::new(
        "cotton_classic_brdf_times_cosine",
        around_two_lobes!([UNIT, UNIT], [Domain::Hemisphere, Domain::Hemisphere]),
        |given| {
            let (base_color, sheen_color) = (given.vec3(), given.vec3());
            let (pile, fibre) = (Lobe::new(given), Lobe::new(given));
            let (v, l) = (given.vec3(), given.vec3());
            if v.z <= 0.0 || l.z <= 0.0 {
                return vec![0.0; 3];
            }
            let lobe = |lobe: &Lobe| lobe.brdf_times_cosine(Sheen::Classic as u32, v, l);
            let fresnel = ggx::schlick(0.04, v.dot(ggx::half_vector(v, l)));
            let base = base_color / PI * l.z + lobe(&pile) * fresnel;
            let scale = 1.0 - sheen_color.max_element() * fibre.albedo;
            (base * scale + sheen_color * lobe(&fibre)).to_array().to_vec()
        },
    ),
    Twin::new("cotton_classic_ambient", around_two_lobes!([UNIT, UNIT], [COSINE, ROUGHNESS, UNIT]), |given| {
        let (base_color, sheen_color) = (given.vec3(), given.vec3());
        let (pile, fibre) = (Lobe::new(given), Lobe::new(given));
        let (mu_v, roughness, occlusion) = (given.number(), given.vec2(), given.number());
        let scale = 1.0 - sheen_color.max_element() * fibre.albedo;
        let seen = |roughness| fuzz::specular_occlusion(mu_v, roughness, occlusion);
        let channel = |at: usize| {
            base_color[at] * scale * occlusion
                + 0.04 * pile.albedo * fuzz::bounced_occlusion(seen(roughness.x), 0.04)
                + sheen_color[at] * fibre.albedo * fuzz::bounced_occlusion(seen(roughness.y), sheen_color[at])
        };
        vec![channel(0), channel(1), channel(2)]
    }),
];
