//! Classic gauze: opacity by the angle of view alone, and the satin highlight under a colour of up to ten.

use super::super::Twin;
use super::super::domain::{COSINE, Domain};
use super::satin;

/// Range of the weave density.
pub const DENSITY: (f64, f64) = (0.0, 200.0);
/// Range of the strength of the highlight.
pub const STRENGTH: (f64, f64) = (0.0, 20.0);
/// Range of the strength of the scatter colour.
pub const SCATTER_STRENGTH: (f64, f64) = (0.0, 10.0);

/// Opacity `sin(theta)^density`; `mu` = cosine of the view angle in [0, 1].
///
/// Defect: every weave is invisible from the front, and a dense one but for a rim: at density 200 it is half opaque
/// only at 85.2 degrees.
pub fn opacity(density: f64, mu: f64) -> f64 {
    (1.0 - mu * mu).max(0.0).sqrt().powf(density)
}

/// Cosine of the angle at which [`opacity`] is one half; `density` > 0.
pub fn half_opacity_cosine(density: f64) -> f64 {
    // The form of 1 - 4^(-1/density) that does not cancel.
    (-(-(4f64.ln()) / density).exp_m1()).sqrt()
}

/// Transmittance from the front of a real weave, one whose opacity grows with the yarn in the way as
/// `1 - T^(1 / mu)`, that is half opaque at the same angle.
pub fn facing_transmittance_of_a_weave(density: f64) -> f64 {
    0.5f64.powf(half_opacity_cosine(density))
}

/// The highlight: that of satin, times the strength of the scatter colour.
///
/// Defect: two strengths, up to 20 and up to 10, multiply a lobe that is not normalised.
pub fn highlight(satin: satin::Lobe, scatter_strength: f64) -> satin::Lobe {
    satin::Lobe { strength: satin.strength * scatter_strength, ..satin }
}

/// What the shader's function is held to.
pub(in crate::measure::twin) const TWINS: &[Twin] = &[Twin::new(
    "gauze_classic_opacity",
    &[Domain::Uniform(0.0, 2000.0, &[0.0, 1.0, 200.0, 2000.0]), COSINE],
    |inputs| vec![opacity(inputs.number(), inputs.number())],
)
// Vulkan has the logarithm within 2^-21 where it is near 0; the power multiplies it by its exponent.
.allowance(|inputs| {
    let (exponent, mu) = (inputs.number(), inputs.number());
    vec![opacity(exponent, mu) * 0.5 * exponent * 2f64.powi(-21)]
})];
