//! Twin of `occlusion.glsl`: what a crevice leaves of the environment.
//!
//! Jimenez et al. 2016, "Practical Real-Time Strategies for Accurate Indirect Occlusion" (light that bounces within a
//! crevice). What a lobe sees through the opening is our own fit; `tests/occlusion.rs` holds it to quadrature.

use super::domain::{COSINE, ROUGHNESS, UNIT};
use super::{Rule, Twin};

/// Share of the light of a GGX lobe of that perceptual roughness that comes through the opening; all in [0, 1].
pub fn of_lobe(mu_v: f64, roughness: f64, occlusion: f64) -> f64 {
    if occlusion <= 0.0 {
        return 0.0;
    }
    let alpha = (roughness * roughness).clamp(0.01, 1.0);
    let sine = (1.0 - mu_v * mu_v).max(0.0).sqrt();
    let wide = alpha * alpha / (alpha * alpha + 0.09);
    let middle = (sine * sine * (1.0 - wide) + 0.55 * wide).clamp(1e-4, 0.9999);
    let rise = 1f64.hypot(0.4 * sine * mu_v / alpha);
    // A logistic curve of the logarithm of the odds.
    let logit = |share: f64| (share / (1.0 - share)).ln();
    1.0 / (1.0 + (rise * (logit(middle) - logit(occlusion))).exp())
}

/// Occlusion of a crevice whose walls reflect that share of the light: all in [0, 1].
pub fn bounced(x: f64, color: f64) -> f64 {
    let (a, b, c) = (2.0404 * color - 0.3324, -4.7951 * color + 0.6417, 2.7552 * color + 0.6903);
    x.max(((x * a + b) * x + c) * x).clamp(0.0, 1.0)
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    // A power of up to 20 stretches the rounding of its base.
    Twin::new("occlusion_of_lobe", &[COSINE, ROUGHNESS, UNIT], |inputs| {
        vec![of_lobe(inputs.number(), inputs.number(), inputs.number())]
    })
    .limit(2e-5, 1e-5)
    .rule(Rule::Conditioned(8)),
    Twin::new("occlusion_bounced", &[UNIT, UNIT], |inputs| {
        let (x, color) = (inputs.number(), inputs.vec3());
        color.to_array().map(|color| bounced(x, color)).to_vec()
    }),
];
