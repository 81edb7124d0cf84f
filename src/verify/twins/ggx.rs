//! Judges `ggx.glsl`.

use super::super::domain::{ALPHA, Domain, ROUGHNESS, UNIT};
use super::super::twin::Twin;
use super::ULP;
use crate::material::reference::ggx;

/// A cosine that rounding, or a caller, took out of [-1, 1].
const ANY_COSINE: Domain = Domain::Uniform(-1.0, 1.0, &[-1e30, -1.0, -0.0, 1e-40, 1e-7, 1.0, 1e30]);

const ANY_ANISOTROPY: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, -0.98, -0.0, 1e-40, 1e-8, 0.98, 1.0]);

pub(super) const TWINS: &[Twin] = &[
    Twin::new("ggx_alpha", &[ROUGHNESS], |given| vec![ggx::alpha_of_roughness(given.number())]).limit(2e-5, 0.0),
    Twin::new("ggx_anisotropic_alpha", &[ROUGHNESS, ANY_ANISOTROPY], |given| {
        let (ax, ay) = ggx::anisotropic_alpha(given.number(), given.number());
        vec![ax, ay]
    })
    .limit(2e-5, 0.0),
    // Relative alone: the peak of a mirror is 3e5, and what lies beside it is as small.
    Twin::new("ggx_ndf", &[Domain::DirectionOrZero, ALPHA, ALPHA], |given| {
        vec![ggx::ndf(given.vec3(), given.number(), given.number())]
    })
    .limit(2e-5, 0.0),
    Twin::new("ggx_masking_shadowing_times_cosine", &[Domain::Above, Domain::Hemisphere, ALPHA, ALPHA], |given| {
        let (v, l) = (given.vec3(), given.vec3());
        vec![ggx::masking_shadowing_times_cosine(v, l, given.number(), given.number())]
    })
    .limit(2e-5, 0.0),
    Twin::new("ggx_half_vector", &[Domain::Direction, Domain::Direction], |given| {
        ggx::half_vector(given.vec3(), given.vec3()).to_array().to_vec()
    }),
    // The subtraction rounds correctly, by Vulkan's word; what is judged is the power. Four units in the last place of a
    // number just below a power of two, where they are smallest.
    Twin::new("schlick_weight", &[ANY_COSINE], |given| {
        let f = (1.0 - given.number().clamp(0.0, 1.0)) as f32;
        vec![ggx::schlick(0.0, 1.0 - f64::from(f))]
    })
    .limit(4.0 * ULP / 2.0, 0.0),
    Twin::new("schlick", &[UNIT, ANY_COSINE], |given| {
        let (f0, v_dot_h) = (given.vec3(), given.number());
        f0.to_array().map(|f0| ggx::schlick(f0, v_dot_h)).to_vec()
    }),
];
