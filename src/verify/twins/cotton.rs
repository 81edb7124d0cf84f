//! Judges `cotton.glsl`: the classic form.

use super::super::domain::{COSINE, Domain, ROUGHNESS, UNIT};
use super::super::twin::Twin;
use super::sheen::{Lobe, around_two_lobes};
use crate::material::Sheen;
use crate::material::reference::classic::cotton;
use crate::material::reference::{ggx, occlusion};
use glam::DVec3;
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
    Twin::new("cotton_classic_occlusion", &[COSINE, ROUGHNESS, UNIT], |given| {
        vec![cotton::occlusion_of_lobe(given.number(), given.number(), given.number())]
    }),
    Twin::new("cotton_classic_lobe_ambient", &[UNIT, UNIT, COSINE, ROUGHNESS, UNIT, UNIT], |given| {
        let (color, albedo) = (given.vec3(), given.number());
        let seen = cotton::occlusion_of_lobe(given.number(), given.number(), given.number());
        let light = given.vec3();
        let bounced = DVec3::from(color.to_array().map(|color| occlusion::bounced(seen, color)));
        (color * albedo * bounced * light).to_array().to_vec()
    }),
];
