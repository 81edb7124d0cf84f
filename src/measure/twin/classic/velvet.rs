//! Classic velvet, and the fabric table that shares its lighting: an inverted lobe, Fresnel to the fourth power, and
//! scatter that owes nothing to the light.

use super::super::domain::{self, COSINE, Domain, UNIT};
use super::super::{Twin, ggx};
use glam::DVec3;
use std::f64::consts::PI;

/// Range of the perceptual roughness.
pub const ROUGHNESS: (f64, f64) = (0.0, 1.0);
/// Range of the colours and of the reflectance at normal incidence.
pub const COLOR: (f64, f64) = (0.0, 1.0);
/// Range of the blend between the two falloffs of the scatter.
pub const SCATTER_SCALE: (f64, f64) = (0.0, 1.0);

/// Distribution of normals.
///
/// Defects: the integral with the cosine is 0.6817, not 1, and no roughness enters.
pub fn ndf(h: DVec3) -> f64 {
    0.96 * (1.0 - h.z).powi(2) + 0.057
}

/// Fresnel reflectance with the power 4.
///
/// Defect: the mean over the hemisphere at F0 = 0.04 is 0.104, where Schlick's fifth power gives 0.0857.
pub fn fresnel(f0: f64, v_dot_h: f64) -> f64 {
    f0 + (1.0 - f0) * (1.0 - v_dot_h.clamp(0.0, 1.0)).powi(4)
}

/// Velvet of one colour channel.
#[derive(Debug, Clone, Copy)]
pub struct Velvet {
    /// Albedo of the Lambert base, in [`COLOR`].
    pub base_color: f64,
    /// Reflectance at normal incidence, in [`COLOR`].
    pub f0: f64,
    /// Perceptual, in [`ROUGHNESS`].
    pub roughness: f64,
    /// In [`COLOR`].
    pub scatter_color: f64,
    /// In [`SCATTER_SCALE`].
    pub scatter_scale: f64,
}

impl Velvet {
    /// The highlight times the cosine of `l`, visibility by height-correlated Smith (Heitz 2014).
    ///
    /// Defect: the visibility knows the roughness and the distribution does not: at grazing view and F = 1, up to 139 times
    /// the light comes back at roughness 0.1.
    pub fn highlight_times_cosine(&self, v: DVec3, l: DVec3) -> f64 {
        let alpha = self.roughness * self.roughness;
        let h = ggx::half_vector(v, l);
        ndf(h) * ggx::masking_shadowing_times_cosine(v, l, alpha, alpha) * fresnel(self.f0, v.dot(h))
    }

    /// Radiance of the scatter under a light that lights a facing white surface to 1; cosines in [0, 1].
    ///
    /// Defects: it is added whether the light is on or not, half of it where the light does not reach; taken times the
    /// light, its albedo is up to 1.5.
    pub fn scatter(&self, mu_v: f64, mu_l: f64) -> f64 {
        let (steep, flat) = ((1.0 - mu_v).powi(4), 0.4 * (1.0 - mu_v));
        self.scatter_color * (0.5 * mu_l.max(0.0) + 0.5) * (steep + (flat - steep) * self.scatter_scale)
    }

    /// BRDF times the cosine of `l` if the scatter were times the light; 0 where a direction is at or below the horizon.
    pub fn brdf_times_cosine(&self, v: DVec3, l: DVec3) -> f64 {
        if v.z <= 0.0 || l.z <= 0.0 {
            return 0.0;
        }
        self.base_color / PI * l.z + self.highlight_times_cosine(v, l) + self.scatter(v.z, l.z) / PI
    }

    /// Radiance under a light of irradiance `light`, as the classic formula has it: the scatter does not ask for one.
    pub fn radiance(&self, v: DVec3, l: DVec3, light: f64) -> f64 {
        let lit = if l.z > 0.0 { self.base_color / PI * l.z + self.highlight_times_cosine(v, l) } else { 0.0 };
        light * lit + self.scatter(v.z, l.z)
    }
}

/// A cosine on either side of the horizon.
const SIGNED_COSINE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-7, 1.0]);

/// What the shader's functions are held to.
pub(in crate::measure::twin) const TWINS: &[Twin] = &[
    Twin::new("velvet_classic_ndf", &[Domain::Hemisphere], |inputs| vec![ndf(inputs.vec3())]),
    Twin::new(
        "velvet_classic_highlight_times_cosine",
        &[UNIT, domain::ROUGHNESS, Domain::Hemisphere, Domain::Hemisphere],
        |inputs| {
            let (f0, roughness, v, l) = (inputs.vec3(), inputs.number(), inputs.vec3(), inputs.vec3());
            let roughness = roughness.max(ggx::SMALLEST_ALPHA.sqrt());
            let none = Velvet { base_color: 0.0, f0: 0.0, roughness, scatter_color: 0.0, scatter_scale: 0.0 };
            f0.to_array().map(|f0| Velvet { f0, ..none }.highlight_times_cosine(v, l)).to_vec()
        },
    ),
    Twin::new("velvet_classic_scatter", &[UNIT, UNIT, COSINE, SIGNED_COSINE], |inputs| {
        let (scatter_color, scatter_scale) = (inputs.vec3(), inputs.number());
        let (mu_v, mu_l) = (inputs.number(), inputs.number());
        let none = Velvet { base_color: 0.0, f0: 0.0, roughness: 1.0, scatter_color: 0.0, scatter_scale };
        scatter_color.to_array().map(|scatter_color| Velvet { scatter_color, ..none }.scatter(mu_v, mu_l)).to_vec()
    }),
];
