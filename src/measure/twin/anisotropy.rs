//! Twin of `anisotropy.glsl`: an anisotropic GGX lobe with its compensation, and the fit of its directional albedo.
//!
//! Turquin 2019, "Practical multiple scattering compensation for microfacet models". The mapping onto the isotropic fits
//! is our own; `tests/anisotropy.rs` holds it to quadrature.

use super::albedo::{AVERAGE_ROUNDING, FIT, FRESNEL_ROUNDING, Fit, WHITE_ROUNDING};
use super::domain::{ALPHA, Domain, UNIT};
use super::{TestInputs, Twin, ggx};
use glam::DVec3;

/// One lobe; its colour channels differ in F0 alone.
#[derive(Debug, Clone, Copy)]
pub struct Lobe {
    /// Reflectance at normal incidence, [0, 1].
    pub f0: DVec3,
    /// Reflectance at grazing incidence, from the largest of `f0` to 1.
    pub f90: f64,
    /// Widths along tangent and bitangent, [1e-3, 1].
    pub alpha: (f64, f64),
}

/// The isotropic width that loses as much seen from the front, and how anisotropic the widths are, in [0, 1].
pub fn mean_width((ax, ay): (f64, f64)) -> (f64, f64) {
    let share = (ax * ax - ay * ay).abs() / (ax * ax + ay * ay);
    let mean = ((ax * ax + ay * ay) / 2.0).sqrt();
    (mean * (1.0 + share * share * (0.08 - 0.16 * mean)), share)
}

/// `(E1, Q)` towards `w`, `w.z` in [0, 1]: the albedo with F = 1, and Schlick's share of it.
pub fn albedo_terms(fit: &Fit, w: DVec3, (ax, ay): (f64, f64)) -> (f64, f64) {
    let (mean, share) = mean_width((ax, ay));
    // Slopes in units of the mean square width.
    let slope = (ax * w.x).hypot(ay * w.y) / ((ax * ax + ay * ay) / 2.0).sqrt();
    let (white, _) = fit.terms(w.z / w.z.hypot(slope).max(1e-15), mean.sqrt());
    // Straight from the front there is no along: both are the mean.
    let front = 1e-6 * ((ax * ax + ay * ay) / 2.0).sqrt();
    let sine = w.x.hypot(w.y).hypot(1e-6);
    let along = (ax * w.x).hypot(ay * w.y).hypot(front) / sine;
    let across = (ay * w.x).hypot(ax * w.y).hypot(front) / sine;
    let lean = (across * across - along * along).max(0.0) / across;
    let (_, fresnel) = fit.terms(w.z / (1.0 + 0.15 * lean).sqrt(), (along / (1.0 + 3.6 * lean).sqrt()).sqrt());
    // Widths more than ten times apart send more to a grazing eye across the long one than any isotropic width does.
    let flatness = (1.0 - 10.0 * ax.min(ay) / ax.max(ay)).max(0.0);
    let leaning = (lean / across) * 0.03 / (0.03 + w.z);
    let fresnel = fresnel + (1.0 - fresnel) * 0.27 * flatness * leaning;
    ((white * (1.0 + 0.04 * share)).min(1.0), fresnel)
}

/// Cosine-weighted averages of (E1 Q, E1, Q) over the hemisphere.
pub fn average_terms(fit: &Fit, alpha: (f64, f64)) -> [f64; 3] {
    fit.averages(mean_width(alpha).0.sqrt())
}

impl Lobe {
    /// Turquin's factor, seen from `v`: `1 + F0 (1 - E1) / E1`.
    pub fn compensation(&self, fit: &Fit, v: DVec3) -> DVec3 {
        let (white, _) = albedo_terms(fit, v, self.alpha);
        1.0 + self.f0 * (1.0 - white) / white.max(1e-3)
    }

    /// What GGX scatters once, times the cosine of `l`; 0 where a direction is at or below the horizon.
    pub fn single_scattering_times_cosine(&self, v: DVec3, l: DVec3) -> DVec3 {
        if v.z <= 0.0 || l.z <= 0.0 {
            return DVec3::ZERO;
        }
        let (ax, ay) = self.alpha;
        let h = ggx::half_vector(v, l);
        // Between F0 and F90 as between F0 and 1.
        let weight = ggx::schlick(0.0, v.dot(h));
        self.f0.lerp(DVec3::splat(self.f90), weight)
            * (ggx::ndf(h, ax, ay) * ggx::masking_shadowing_times_cosine(v, l, ax, ay))
    }

    /// The lobe, times the cosine of `l`.
    pub fn times_cosine(&self, fit: &Fit, v: DVec3, l: DVec3) -> DVec3 {
        self.compensation(fit, v) * self.single_scattering_times_cosine(v, l)
    }

    /// Its albedo towards `w`, by the fit.
    pub fn albedo(&self, fit: &Fit, w: DVec3) -> DVec3 {
        let (white, fresnel) = albedo_terms(fit, w, self.alpha);
        self.f0.lerp(DVec3::splat(self.f90), fresnel) * self.f0.lerp(DVec3::ONE, white)
    }

    /// The cosine-weighted average of the albedo.
    pub fn average_albedo(&self, fit: &Fit) -> DVec3 {
        let [both, white, fresnel] = average_terms(fit, self.alpha);
        // The product of the two factors of `albedo`, averaged term by term.
        let (f0, rest) = (self.f0, self.f90 - self.f0);
        f0 * f0 + f0 * (1.0 - f0) * white + rest * f0 * fresnel + rest * (1.0 - f0) * both
    }
}

/// Members of `AnisotropicLobe`.
pub(super) struct Seen {
    pub(super) lobe: Lobe,
    compensation: DVec3,
}

impl Seen {
    pub(super) fn new(inputs: &mut TestInputs<'_>) -> Self {
        let (f0, f90, compensation) = (inputs.vec3(), inputs.number(), inputs.vec3());
        Self { lobe: Lobe { f0, f90, alpha: (inputs.number(), inputs.number()) }, compensation }
    }

    /// The compensated lobe times the cosine of `l`.
    pub(super) fn times_cosine(&self, v: DVec3, l: DVec3) -> DVec3 {
        self.compensation * self.lobe.single_scattering_times_cosine(v, l)
    }
}

/// Of the compensation: 1 / E1 of the roughest white surface is 3.3.
pub(super) const COMPENSATION: Domain = Domain::Uniform(1.0, 3.3, &[1.0, 3.3]);

fn alpha(inputs: &mut TestInputs<'_>) -> (f64, f64) {
    (inputs.number(), inputs.number())
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("anisotropic_mean", &[ALPHA], |inputs| {
        let (mean, share) = mean_width(alpha(inputs));
        vec![mean, share]
    }),
    Twin::new("anisotropic_albedo_terms", &[Domain::Hemisphere, ALPHA], |inputs| {
        let (white, fresnel) = albedo_terms(&FIT, inputs.vec3(), alpha(inputs));
        vec![white, fresnel]
    })
    .limit(2e-5, WHITE_ROUNDING + FRESNEL_ROUNDING),
    Twin::new("anisotropic_average_terms", &[ALPHA], |inputs| average_terms(&FIT, alpha(inputs)).to_vec())
        .limit(2e-5, AVERAGE_ROUNDING),
    Twin::new("anisotropic_lobe", &[Domain::Hemisphere, ALPHA, UNIT, UNIT], |inputs| {
        let (v, (ax, ay), f0, f90) = (inputs.vec3(), alpha(inputs), inputs.vec3(), inputs.number());
        let compensation = Lobe { f0, f90, alpha: (ax, ay) }.compensation(&FIT, v);
        let mut words = f0.to_array().to_vec();
        words.push(f90);
        words.extend(compensation.to_array());
        words.extend([ax, ay]);
        words
    })
    .limit(2e-5, WHITE_ROUNDING),
    Twin::new(
        "anisotropic_lobe_times_cosine",
        &[UNIT, UNIT, COMPENSATION, ALPHA, ALPHA, Domain::Hemisphere, Domain::Direction],
        |inputs| {
            let (seen, v, l) = (Seen::new(inputs), inputs.vec3(), inputs.vec3());
            seen.times_cosine(v, l).to_array().to_vec()
        },
    ),
    Twin::new("anisotropic_lobe_albedo", &[UNIT, UNIT, COMPENSATION, ALPHA, ALPHA, Domain::Hemisphere], |inputs| {
        Seen::new(inputs).lobe.albedo(&FIT, inputs.vec3()).to_array().to_vec()
    })
    .limit(2e-5, WHITE_ROUNDING + FRESNEL_ROUNDING),
    Twin::new("anisotropic_lobe_average_albedo", &[UNIT, UNIT, COMPENSATION, ALPHA, ALPHA], |inputs| {
        Seen::new(inputs).lobe.average_albedo(&FIT).to_array().to_vec()
    })
    .limit(2e-5, AVERAGE_ROUNDING),
];
