//! Judges `satin.glsl`.

use super::super::domain::{ALPHA, Domain, ROUGHNESS, UNIT};
use super::super::twin::Twin;
use crate::material::reference::classic::satin as classic;
use crate::material::reference::{ggx, satin};
use glam::DVec3;

/// 0.04 times the largest strength.
const REFLECTANCE: Domain = Domain::Uniform(0.0, 1.2, &[0.0, 1e-40, 1e-8, 0.04, 1.0, 1.2]);
const STRENGTH: Domain = Domain::Uniform(0.0, 30.0, &[0.0, 1e-40, 1.0, 30.0]);
const ANISOTROPY: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, -0.0, 1e-8, 1.0]);
/// Of a light: from none to the largest that stays finite.
const LIGHT: Domain = Domain::Log(1e-6, 1e6, &[0.0, 1e-40, 1e-8, 1.0, 1e38]);

pub(super) const TWINS: &[Twin] = &[
    Twin::new("satin_largest", &[UNIT], |given| vec![given.vec3().max_element()]),
    Twin::new("satin_reflectance", &[UNIT, STRENGTH, UNIT], |given| {
        satin::reflectance(given.vec3(), given.number(), given.number()).to_array().to_vec()
    }),
    Twin::new("satin_share", &[REFLECTANCE, REFLECTANCE], |given| vec![satin::share(given.vec3(), given.vec3())]),
    Twin::new("satin_f0", &[REFLECTANCE, UNIT], |given| satin::f0(given.vec3(), given.number()).to_array().to_vec()),
    Twin::new("satin_metal", &[REFLECTANCE], |given| satin::metal(given.vec3()).to_array().to_vec()),
    Twin::new("satin_f90", &[UNIT], |given| vec![satin::f90(given.vec3())]),
    Twin::new("satin_noise", &[UNIT], |given| vec![0.5 + 0.5 * given.number()]),
    Twin::new("satin_classic_alpha", &[ROUGHNESS, ANISOTROPY], |given| {
        let (ax, ay) = classic::widths(given.number(), given.number());
        vec![ax.max(1e-3), ay.max(1e-3)]
    }),
    Twin::new("satin_classic_times_cosine", &[UNIT, ALPHA, Domain::Above, Domain::Above], |given| {
        let (f0, ax, ay) = (given.vec3(), given.number(), given.number());
        let (v, l) = (given.vec3(), given.vec3());
        let h = ggx::half_vector(v, l);
        // Opposed directions have no half vector, and no lobe.
        if h == DVec3::ZERO {
            return vec![0.0; 3];
        }
        let lobe = classic::ndf(h, ax, ay) * ggx::masking_shadowing_times_cosine(v, l, ax, ay);
        f0.to_array().map(|f0| lobe * ggx::schlick(f0, v.dot(h))).to_vec()
    }),
    Twin::new("satin_classic_light", &[UNIT, LIGHT, UNIT], |given| {
        let (tint, light, share) = (given.vec3(), given.vec3(), given.number());
        let gray = light.dot(DVec3::new(0.2125, 0.7154, 0.0721));
        (tint * gray).lerp(light, share).to_array().to_vec()
    }),
];
