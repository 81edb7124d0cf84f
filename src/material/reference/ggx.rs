//! Twin of `ggx.glsl`: the anisotropic GGX microfacet model.
//!
//! Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces" (distribution); Heitz 2014,
//! "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs" (height-correlated Smith, section 5.3).

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
