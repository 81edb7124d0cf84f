//! Classic satin: an anisotropic highlight without its normalisation, and a mix of the light's colour with its grey.

use super::super::domain::{self, ALPHA, Domain, UNIT};
use super::super::{Twin, ggx};
use glam::DVec3;
use std::f64::consts::PI;

/// Range of the strength of the highlight.
pub const STRENGTH: (f64, f64) = (0.0, 30.0);
/// Range of the anisotropy.
pub const ANISOTROPY: (f64, f64) = (-1.0, 1.0);
/// Range of the perceptual roughness.
pub const ROUGHNESS: (f64, f64) = (0.0, 1.0);
/// Range of the reflectance at normal incidence.
pub const F0: (f64, f64) = (0.0, 1.0);

/// The highlight of satin and gauze.
#[derive(Debug, Clone, Copy)]
pub struct Lobe {
    /// Factor on the lobe, in [`STRENGTH`].
    pub strength: f64,
    /// Perceptual, in [`ROUGHNESS`].
    pub roughness: f64,
    /// In [`ANISOTROPY`].
    pub anisotropy: f64,
    /// In [`F0`].
    pub f0: f64,
    /// Adds the lobe of the opposite anisotropy (`two_way`).
    pub two_way: bool,
}

/// `(ax, ay)` of a roughness and an anisotropy.
///
/// Defect: an axis is 0, and the distribution divides by it, at an anisotropy of 1 or -1 and at roughness 0.
pub fn widths(roughness: f64, anisotropy: f64) -> (f64, f64) {
    let alpha = roughness * roughness;
    (alpha * (1.0 + anisotropy), alpha * (1.0 - anisotropy))
}

/// The distribution: GGX without its `1 / (ax ay)`.
///
/// Defect: the integral of D cos is `ax ay`, not 1; the peak is always 1 / pi, so that a narrower lobe is only darker.
pub fn ndf(h: DVec3, ax: f64, ay: f64) -> f64 {
    let s = (h.x / ax).powi(2) + (h.y / ay).powi(2) + h.z * h.z;
    1.0 / (PI * s * s)
}

impl Lobe {
    /// Highlight times the cosine of `l`. Older manuals leave the visibility term open; ours is height-correlated Smith
    /// (Heitz 2014), which never gains anything by itself.
    ///
    /// Defect: the strength makes up for the distribution and reflects 27.6 times the light at roughness 1,
    /// seen at the cosine 0.02; 30 times at the horizon.
    pub fn times_cosine(&self, v: DVec3, l: DVec3) -> f64 {
        let h = ggx::half_vector(v, l);
        let one = |anisotropy| {
            let (ax, ay) = widths(self.roughness, anisotropy);
            ndf(h, ax, ay) * ggx::masking_shadowing_times_cosine(v, l, ax, ay)
        };
        let lobes = one(self.anisotropy) + if self.two_way { one(-self.anisotropy) } else { 0.0 };
        self.strength * lobes * ggx::schlick(self.f0, v.dot(h))
    }
}

/// Colour of the highlight under a light: halfway between the tint times the light's grey and the light.
///
/// Defect: no reflectance per channel. Red satin under pure blue light sends back red that never came.
pub fn tinted(tint: DVec3, light: DVec3) -> DVec3 {
    let gray = light.dot(DVec3::new(0.2125, 0.7154, 0.0721));
    (tint * gray).lerp(light, 0.5)
}

/// Of an anisotropy.
const SIGNED: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, -0.0, 1e-8, 1.0]);
/// Of a light: from none to the largest that stays finite.
const LIGHT: Domain = Domain::Log(1e-6, 1e6, &[0.0, 1e-40, 1e-8, 1.0, 1e38]);

/// What the shader's functions are held to.
pub(in crate::measure::twin) const TWINS: &[Twin] = &[
    Twin::new("satin_classic_alpha", &[domain::ROUGHNESS, SIGNED], |inputs| {
        let (ax, ay) = widths(inputs.number(), inputs.number());
        vec![ax.max(1e-3), ay.max(1e-3)]
    }),
    Twin::new("satin_classic_times_cosine", &[UNIT, ALPHA, Domain::Above, Domain::Above], |inputs| {
        let (f0, ax, ay) = (inputs.vec3(), inputs.number(), inputs.number());
        let (v, l) = (inputs.vec3(), inputs.vec3());
        let h = ggx::half_vector(v, l);
        // Opposed directions have no half vector, and no lobe.
        if h == DVec3::ZERO {
            return vec![0.0; 3];
        }
        let lobe = ndf(h, ax, ay) * ggx::masking_shadowing_times_cosine(v, l, ax, ay);
        f0.to_array().map(|f0| lobe * ggx::schlick(f0, v.dot(h))).to_vec()
    }),
    Twin::new("satin_classic_light", &[UNIT, LIGHT, UNIT], |inputs| {
        let (tint, light, share) = (inputs.vec3(), inputs.vec3(), inputs.number());
        let gray = light.dot(DVec3::new(0.2125, 0.7154, 0.0721));
        (tint * gray).lerp(light, share).to_array().to_vec()
    }),
];
