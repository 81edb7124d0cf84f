//! Twin of `ggx.glsl`: the anisotropic GGX microfacet model.
//!
//! Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces" (distribution); Heitz 2014,
//! "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs" (height-correlated Smith, section 5.3).

use super::domain::{ALPHA, Domain, ROUGHNESS, UNIT};
use super::{Twin, ULP};
use glam::DVec3;
use std::f64::consts::PI;

/// Smallest `alpha` that is evaluated: below it the lobe is narrower than single precision resolves.
pub const SMALLEST_ALPHA: f64 = 1e-3;

/// `alpha = roughness^2`, clamped to [[`SMALLEST_ALPHA`], 1].
pub fn alpha_of_roughness(roughness: f64) -> f64 {
    (roughness * roughness).clamp(SMALLEST_ALPHA, 1.0)
}

/// `(alpha_x, alpha_y)` of a roughness in [0, 1] and an anisotropy in [-1, 1]: the axis ratio of the classic
/// `(1 + a) : (1 - a)` with the product `alpha^2`, until an axis reaches its limit.
pub fn anisotropic_alpha(roughness: f64, anisotropy: f64) -> (f64, f64) {
    let a = anisotropy.clamp(-0.98, 0.98);
    let stretch = ((1.0 + a) / (1.0 - a)).sqrt();
    let alpha = roughness * roughness;
    ((alpha * stretch).clamp(SMALLEST_ALPHA, 1.0), (alpha / stretch).clamp(SMALLEST_ALPHA, 1.0))
}

/// Distribution of normals D(h), per steradian; `alpha_x`, `alpha_y` in (0, 1]. 0 for a zero-length `h`.
pub fn ndf(h: DVec3, alpha_x: f64, alpha_y: f64) -> f64 {
    if h == DVec3::ZERO {
        return 0.0;
    }
    let s = (h.x / alpha_x).powi(2) + (h.y / alpha_y).powi(2) + h.z * h.z;
    1.0 / (PI * alpha_x * alpha_y * s * s)
}

/// Smith's Lambda of a direction above the horizon.
fn lambda(w: DVec3, alpha_x: f64, alpha_y: f64) -> f64 {
    let slope2 = ((alpha_x * w.x).powi(2) + (alpha_y * w.y).powi(2)) / (w.z * w.z);
    0.5 * ((1.0 + slope2).sqrt() - 1.0)
}

/// `G2 / (4 mu_v mu_l) * mu_l`: everything of the BRDF times cosine but D and F. 0 where either direction is at or
/// below the horizon.
pub fn masking_shadowing_times_cosine(v: DVec3, l: DVec3, alpha_x: f64, alpha_y: f64) -> f64 {
    if v.z <= 0.0 || l.z <= 0.0 {
        return 0.0;
    }
    let g2 = 1.0 / (1.0 + lambda(v, alpha_x, alpha_y) + lambda(l, alpha_x, alpha_y));
    g2 / (4.0 * v.z)
}

/// Half vector; zero where `v` and `l` are opposed (|v + l| < 1e-6), as there is none.
pub fn half_vector(v: DVec3, l: DVec3) -> DVec3 {
    let sum = v + l;
    if sum.length() < 1e-6 { DVec3::ZERO } else { sum.normalize() }
}

/// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering": Fresnel reflectance with F90 = 1.
pub fn schlick(f0: f64, v_dot_h: f64) -> f64 {
    f0 + (1.0 - f0) * (1.0 - v_dot_h.clamp(0.0, 1.0)).powi(5)
}

/// A cosine that rounding, or a caller, took out of [-1, 1].
const ANY_COSINE: Domain = Domain::Uniform(-1.0, 1.0, &[-1e30, -1.0, -0.0, 1e-40, 1e-7, 1.0, 1e30]);

const ANY_ANISOTROPY: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, -0.98, -0.0, 1e-40, 1e-8, 0.98, 1.0]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("ggx_alpha", &[ROUGHNESS], |inputs| vec![alpha_of_roughness(inputs.number())]).limit(2e-5, 0.0),
    Twin::new("ggx_anisotropic_alpha", &[ROUGHNESS, ANY_ANISOTROPY], |inputs| {
        let (ax, ay) = anisotropic_alpha(inputs.number(), inputs.number());
        vec![ax, ay]
    })
    .limit(2e-5, 0.0),
    // Relative alone: the peak of a mirror is 3e5, and what lies beside it is as small.
    Twin::new("ggx_ndf", &[Domain::DirectionOrZero, ALPHA, ALPHA], |inputs| {
        vec![ndf(inputs.vec3(), inputs.number(), inputs.number())]
    })
    .limit(2e-5, 0.0),
    Twin::new("ggx_masking_shadowing_times_cosine", &[Domain::Above, Domain::Hemisphere, ALPHA, ALPHA], |inputs| {
        let (v, l) = (inputs.vec3(), inputs.vec3());
        vec![masking_shadowing_times_cosine(v, l, inputs.number(), inputs.number())]
    })
    .limit(2e-5, 0.0),
    Twin::new("ggx_half_vector", &[Domain::Direction, Domain::Direction], |inputs| {
        half_vector(inputs.vec3(), inputs.vec3()).to_array().to_vec()
    }),
    // The subtraction rounds correctly, by Vulkan's word; what is judged is the power. Four units in the last place of a
    // number just below a power of two, where they are smallest.
    Twin::new("schlick_weight", &[ANY_COSINE], |inputs| {
        let f = (1.0 - inputs.number().clamp(0.0, 1.0)) as f32;
        vec![schlick(0.0, 1.0 - f64::from(f))]
    })
    .limit(4.0 * ULP / 2.0, 0.0),
    Twin::new("schlick", &[UNIT, ANY_COSINE], |inputs| {
        let (f0, v_dot_h) = (inputs.vec3(), inputs.number());
        f0.to_array().map(|f0| schlick(f0, v_dot_h)).to_vec()
    }),
];
