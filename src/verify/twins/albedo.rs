//! Judges `albedo.glsl`.

use super::super::domain::{ALPHA, COSINE, Domain, ROUGHNESS, UNIT};
use super::super::twin::Twin;
use super::ULP;
use crate::material::reference::albedo::{Fit, fresnel_basis};
use glam::DVec3;
use std::sync::LazyLock;

pub(super) static FIT: LazyLock<Fit> = LazyLock::new(Fit::shipped);

/// t of the fits.
const SCALED_COSINE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-7, 1.0]);
/// Roughness where the fits take it: from the square root of the smallest alpha.
const FITTED_ROUGHNESS: Domain = Domain::Uniform(0.0316228, 1.0, &[0.0316228, 1.0]);

pub(super) const TWINS: &[Twin] = &[
    Twin::new("ggx_fit_white", &[SCALED_COSINE, ALPHA], |given| {
        let (t, alpha) = (given.number(), given.number());
        let powers = FIT.white.iter().enumerate().flat_map(|(i, row)| row.iter().enumerate().map(move |at| (i, at)));
        let sum: f64 = powers.map(|(i, (j, c))| c * t.powi(i as i32) * alpha.powi(j as i32)).sum();
        vec![sum.clamp(0.0, 1.0)]
    })
    .limit(2e-5, WHITE_ROUNDING),
    Twin::new("ggx_fit_fresnel_root", &[COSINE, SCALED_COSINE, FITTED_ROUGHNESS], |given| {
        let basis = fresnel_basis(given.number(), given.number(), given.number());
        let sum: f64 = basis.iter().zip(&FIT.fresnel).map(|(term, c)| term * c).sum();
        vec![sum.clamp(0.0, 1.0)]
    })
    .limit(2e-5, ROOT_ROUNDING),
    Twin::new("ggx_fit_averages", &[FITTED_ROUGHNESS], |given| FIT.averages(given.number()).to_vec())
        .limit(2e-5, AVERAGE_ROUNDING),
    Twin::new("ggx_albedo_terms", &[COSINE, ROUGHNESS], |given| {
        let (white, fresnel) = FIT.terms(given.number(), given.number());
        vec![white, fresnel]
    })
    .limit(2e-5, TERMS_ROUNDING),
    Twin::new("ggx_directional_albedo", &[COSINE, ROUGHNESS], |given| {
        let (scale, bias) = FIT.directional_albedo(given.number(), given.number());
        vec![scale, bias]
    })
    .limit(2e-5, TERMS_ROUNDING),
    Twin::new("ggx_average_terms", &[ROUGHNESS], |given| FIT.averages(given.number()).to_vec())
        .limit(2e-5, AVERAGE_ROUNDING),
    Twin::new("ggx_average_albedo", &[ROUGHNESS], |given| {
        let [both, white, _] = FIT.averages(given.number());
        vec![white - both, both]
    })
    .limit(2e-5, AVERAGE_ROUNDING),
    Twin::new("standard_specular_compensation", &[UNIT, UNIT], |given| {
        let (f0, white) = (given.vec3(), given.number());
        (1.0 + f0 * (1.0 - white) / white.max(1e-3)).to_array().to_vec()
    }),
    Twin::new("standard_compensated_albedo", &[UNIT, UNIT], |given| {
        let (f0, terms) = (given.vec3(), given.vec2());
        // (F0 + (1 - F0) Q) E1 (1 + F0 (1 - E1) / E1)
        (f0.lerp(DVec3::ONE, terms.y) * f0.lerp(DVec3::ONE, terms.x)).to_array().to_vec()
    }),
    Twin::new("standard_average_compensated_albedo", &[UNIT, UNIT], |given| {
        let (f0, terms) = (given.vec3(), given.vec3());
        let average = |f0: f64| {
            // The average of (Q + F0 (1 - Q)) (E1 + F0 (1 - E1)), term by term.
            let (both, white, fresnel) = (terms.x, terms.y, terms.z);
            both + f0 * (fresnel - both) + f0 * (white - both) + f0 * f0 * (1.0 - white - fresnel + both)
        };
        f0.to_array().map(average).to_vec()
    }),
];

// A polynomial's rounding: every coefficient passes through a handful of operations, each rounding its running sum by
// half a unit in the last place of at most the sum of the magnitudes. Those sums, with all variables at 1:

/// E1: magnitudes up to 85 where alpha = 1, doubled by the dot products that make each row.
const WHITE_ROUNDING: f64 = 85.0 * ULP;
/// The root of Q: magnitudes up to 1790.
const ROOT_ROUNDING: f64 = 1790.0 * ULP / 4.0;
/// The averages: magnitudes up to 173.
const AVERAGE_ROUNDING: f64 = 173.0 * ULP;
/// Q = root^5 multiplies an error of the root by at most 5.
const TERMS_ROUNDING: f64 = 5.0 * ROOT_ROUNDING;
