//! Judges `anisotropy.glsl`.

use super::super::domain::{ALPHA, Domain, UNIT};
use super::super::twin::{Given, Twin};
use super::albedo::{AVERAGE_ROUNDING, FIT, FRESNEL_ROUNDING, WHITE_ROUNDING};
use crate::material::reference::anisotropy::{Lobe, albedo_terms, average_terms, mean_width};
use glam::DVec3;

/// Members of `AnisotropicLobe`.
pub(super) struct Seen {
    pub(super) lobe: Lobe,
    compensation: DVec3,
}

impl Seen {
    pub(super) fn new(given: &mut Given<'_>) -> Self {
        let (f0, f90, compensation) = (given.vec3(), given.number(), given.vec3());
        Self { lobe: Lobe { f0, f90, alpha: (given.number(), given.number()) }, compensation }
    }

    /// The compensated lobe times the cosine of `l`.
    pub(super) fn times_cosine(&self, v: DVec3, l: DVec3) -> DVec3 {
        self.compensation * self.lobe.single_scattering_times_cosine(v, l)
    }
}

/// Of the compensation: 1 / E1 of the roughest white surface is 3.3.
pub(super) const COMPENSATION: Domain = Domain::Uniform(1.0, 3.3, &[1.0, 3.3]);

fn alpha(given: &mut Given<'_>) -> (f64, f64) {
    (given.number(), given.number())
}

pub(super) const TWINS: &[Twin] = &[
    Twin::new("anisotropic_mean", &[ALPHA], |given| {
        let (mean, share) = mean_width(alpha(given));
        vec![mean, share]
    }),
    Twin::new("anisotropic_albedo_terms", &[Domain::Hemisphere, ALPHA], |given| {
        let (white, fresnel) = albedo_terms(&FIT, given.vec3(), alpha(given));
        vec![white, fresnel]
    })
    .limit(2e-5, WHITE_ROUNDING + FRESNEL_ROUNDING),
    Twin::new("anisotropic_average_terms", &[ALPHA], |given| average_terms(&FIT, alpha(given)).to_vec())
        .limit(2e-5, AVERAGE_ROUNDING),
    Twin::new("anisotropic_lobe", &[Domain::Hemisphere, ALPHA, UNIT, UNIT], |given| {
        let (v, (ax, ay), f0, f90) = (given.vec3(), alpha(given), given.vec3(), given.number());
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
        |given| {
            let (seen, v, l) = (Seen::new(given), given.vec3(), given.vec3());
            seen.times_cosine(v, l).to_array().to_vec()
        },
    ),
    Twin::new("anisotropic_lobe_albedo", &[UNIT, UNIT, COMPENSATION, ALPHA, ALPHA, Domain::Hemisphere], |given| {
        Seen::new(given).lobe.albedo(&FIT, given.vec3()).to_array().to_vec()
    })
    .limit(2e-5, WHITE_ROUNDING + FRESNEL_ROUNDING),
    Twin::new("anisotropic_lobe_average_albedo", &[UNIT, UNIT, COMPENSATION, ALPHA, ALPHA], |given| {
        Seen::new(given).lobe.average_albedo(&FIT).to_array().to_vec()
    })
    .limit(2e-5, AVERAGE_ROUNDING),
];
