//! Judges `standard.glsl`.

use super::super::domain::{ALPHA, COSINE, Domain, RADIANCE, ROUGHNESS, UNIT};
use super::super::twin::{Given, Twin};
use super::albedo::{AVERAGE_ROUNDING, FIT, FRESNEL_ROUNDING, WHITE_ROUNDING};
use crate::material::reference::ggx;
use glam::DVec3;
use std::f64::consts::PI;

/// Members of `StandardSurface`.
struct Surface {
    f0: DVec3,
    roughness: f64,
    diffuse: DVec3,
    alpha_x: f64,
    coupled_diffuse: DVec3,
    alpha_y: f64,
    specular_compensation: DVec3,
    specular_albedo: DVec3,
}

impl Surface {
    fn new(given: &mut Given<'_>) -> Self {
        Self {
            f0: given.vec3(),
            roughness: given.number(),
            diffuse: given.vec3(),
            alpha_x: given.number(),
            coupled_diffuse: given.vec3(),
            alpha_y: given.number(),
            specular_compensation: given.vec3(),
            specular_albedo: given.vec3(),
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

pub(super) const TWINS: &[Twin] = &[
    Twin::new("standard_coupled", &[UNIT, UNIT, ROUGHNESS, COSINE], |given| {
        let (f0, diffuse, roughness, mu_v) = (given.vec3(), given.vec3(), given.number(), given.number());
        Surface::coupled(f0, diffuse, roughness, mu_v).words()
    })
    .limit(2e-5, WHITE_ROUNDING + FRESNEL_ROUNDING)
    // Under a white mirror next to nothing is left for the diffuse lobe: the quotient of what is left of both albedos
    // carries their errors, and is multiplied by as little again.
    .allowance(|given| {
        let (f0, diffuse, roughness, _) = (given.vec3(), given.vec3(), given.number(), given.number());
        let quotient = |at: usize| {
            let left = (1.0 - FIT.average_compensated_albedo(f0[at], roughness)).max(1e-4);
            diffuse[at] / PI * (WHITE_ROUNDING + FRESNEL_ROUNDING + AVERAGE_ROUNDING) / left
        };
        let mut allowed = vec![0.0; 18];
        (0..3).for_each(|at| allowed[8 + at] = quotient(at));
        allowed
    }),
    Twin::new("standard_surface", &[UNIT, UNIT, ROUGHNESS, COSINE], |given| {
        let (base_color, metallic, roughness, mu_v) = (given.vec3(), given.number(), given.number(), given.number());
        let f0 = DVec3::splat(0.04).lerp(base_color, metallic);
        Surface::coupled(f0, base_color * (1.0 - metallic), roughness, mu_v).words()
    })
    // Errors of E1 and Q add up in the albedo, the largest of what follows from them.
    .limit(2e-5, WHITE_ROUNDING + FRESNEL_ROUNDING),
    Twin::new(
        "standard_brdf_times_cosine",
        &[UNIT, ROUGHNESS, UNIT, ALPHA, UNIT, ALPHA, COMPENSATION, UNIT, Domain::Hemisphere, Domain::Hemisphere],
        |given| {
            let (surface, v, l) = (Surface::new(given), given.vec3(), given.vec3());
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
        |given| {
            let (surface, mirrored, scattered) = (Surface::new(given), given.vec3(), given.vec3());
            let left = 1.0 - surface.specular_albedo;
            (surface.specular_albedo * mirrored + surface.diffuse * left * scattered).to_array().to_vec()
        },
    ),
];
