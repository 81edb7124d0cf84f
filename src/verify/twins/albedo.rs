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
    .limit(2e-5, WHITE_ROUNDING),
    Twin::new("ggx_directional_albedo", &[COSINE, ROUGHNESS], |given| {
        let (scale, bias) = FIT.directional_albedo(given.number(), given.number());
        vec![scale, bias]
    })
    .limit(2e-5, WHITE_ROUNDING),
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
    Twin::new("compensated_albedo", &[UNIT, UNIT, UNIT], |given| {
        let (f0, f90, terms) = (given.vec3(), given.number(), given.vec2());
        (f0.lerp(DVec3::splat(f90), terms.y) * f0.lerp(DVec3::ONE, terms.x)).to_array().to_vec()
    }),
    Twin::new("average_compensated_albedo", &[UNIT, UNIT, UNIT], |given| {
        let (f0, f90, terms) = (given.vec3(), given.number(), given.vec3());
        let (both, white, fresnel) = (terms.x, terms.y, terms.z);
        // The average of (F0 + (F90 - F0) Q) (F0 + (1 - F0) E1), term by term.
        let rest = f90 - f0;
        (f0 * f0 + f0 * (1.0 - f0) * white + rest * f0 * fresnel + rest * (1.0 - f0) * both).to_array().to_vec()
    }),
];

// A polynomial is as good as if each of its terms had been rounded once: half a unit in the last place of the sum of
// their magnitudes, all variables at their largest.

/// E1.
pub(super) const WHITE_ROUNDING: f64 = 118.0 * ULP / 2.0;
/// The root of Q.
const ROOT_ROUNDING: f64 = 1304.0 * ULP / 2.0;
/// Q = root^5, which multiplies the root's error by 5 root^4: the root is small where the terms cancel most.
pub(super) const FRESNEL_ROUNDING: f64 = 68.0 * ULP / 2.0;
/// The averages.
pub(super) const AVERAGE_ROUNDING: f64 = 173.0 * ULP / 2.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::reference::albedo::{fitted_roughness, scaled_cosine};

    #[test]
    fn the_magnitudes_are_those_of_the_fit() {
        let near = |rounding: f64, sum: f64| assert!((0.98..=1.0).contains(&(sum / (rounding * 2.0 / ULP))), "{sum}");
        near(WHITE_ROUNDING, FIT.white.iter().flatten().map(|c| c.abs()).sum());
        near(ROOT_ROUNDING, FIT.fresnel.iter().map(|c| c.abs()).sum());
        near(AVERAGE_ROUNDING, FIT.averages.iter().map(|row| row[1].abs()).sum());
        let mut most: f64 = 0.0;
        for index in 0..250_000 {
            let (mu, roughness) = (f64::from(index % 500) / 499.0, f64::from(index / 500) / 499.0);
            let r = fitted_roughness(roughness);
            let basis = fresnel_basis(mu, scaled_cosine(mu, r * r), r);
            let terms = basis.into_iter().zip(FIT.fresnel).map(|(term, c)| c * term);
            let root = terms.clone().sum::<f64>().clamp(0.0, 1.0);
            most = most.max(5.0 * root.powi(4) * terms.map(f64::abs).sum::<f64>());
        }
        near(FRESNEL_ROUNDING, most);
    }
}
