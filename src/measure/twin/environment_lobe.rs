//! Twin of `environment_lobe.glsl`: taps by which an anisotropic lobe reads a prefiltered environment.
//!
//! Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs" (visible normals, here of a profile
//! in a plane). `tests/environment_lobe.rs` holds them to quadrature of the lobe.

use super::domain::{ALPHA, Domain};
use super::{Rule, TestInputs, Twin, ggx};
use glam::DVec3;

/// One look-up: where, and its share of the light.
#[derive(Debug, Clone, Copy)]
pub struct Tap {
    /// Unit, in the tangent frame.
    pub direction: DVec3,
    /// Those of all taps add up to 1.
    pub weight: f64,
}

/// Width of the taps' profile.
pub fn spread((ax, ay): (f64, f64)) -> f64 {
    let (narrow, wide) = (ax.min(ay), ax.max(ay));
    ((wide * wide - narrow * narrow).max(0.0).sqrt() + (wide - narrow)) / 2.0
}

/// Perceptual roughness of the taps' lobes.
pub fn roughness(alpha: (f64, f64), taps: u32) -> f64 {
    (alpha.0.min(alpha.1) + 0.4 * spread(alpha) / f64::from(taps.max(1))).min(1.0).sqrt()
}

/// Normal of the tap at a share, in (0, 1), of the normals that `v` sees, in the order of their lean.
pub fn normal(v: DVec3, alpha: (f64, f64), share: f64) -> DVec3 {
    let axis = if alpha.0 >= alpha.1 { DVec3::X } else { DVec3::Y };
    let spread = spread(alpha);
    // Angles of the eye and of the normal in the plane, in units of the spread. The density of slopes times their
    // projected area integrates to the sine of the angle between the two.
    let eye = (spread * v.dot(axis)).atan2(v.z);
    let (low, high) = if eye >= 0.0 { (-1.0, eye.cos()) } else { (-eye.cos(), 1.0) };
    let angle = eye + (low + (high - low) * share).asin();
    (spread * angle.sin() * axis + angle.cos() * DVec3::Z).normalize()
}

/// Where a tap reads: the mirrored `v` with its sine from `h` times `mirror`.
pub fn axis(v: DVec3, h: DVec3, mirror: f64) -> DVec3 {
    let across = -mirror * v.reject_from_normalized(h);
    across + (1.0 - across.length_squared()).max(0.0).sqrt() * h
}

/// All taps of a lobe seen from `v`; `mirror` is that of a round lobe of their roughness.
pub fn taps(v: DVec3, alpha: (f64, f64), count: u32, mirror: f64) -> Vec<Tap> {
    let tap = |index| {
        let h = normal(v, alpha, (f64::from(index) + 0.5) / f64::from(count));
        let mirrored = 2.0 * v.dot(h) * h - v;
        let weight =
            if mirrored.z > 0.0 { ggx::masking_shadowing_times_cosine(v, mirrored, alpha.0, alpha.1) } else { 0.0 };
        Tap { direction: axis(v, h, mirror), weight }
    };
    let taps: Vec<Tap> = (0..count).map(tap).collect();
    let sum: f64 = taps.iter().map(|tap| tap.weight).sum();
    taps.into_iter().map(|tap| Tap { weight: tap.weight / sum, ..tap }).collect()
}

/// Middles of shares, of up to a hundred taps.
const SHARE: Domain = Domain::Uniform(0.005, 0.995, &[0.005, 0.5, 0.995]);

fn alpha(inputs: &mut TestInputs<'_>) -> (f64, f64) {
    (inputs.number(), inputs.number())
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("environment_tap_spread", &[ALPHA], |inputs| vec![spread(alpha(inputs))]).rule(Rule::Conditioned(2)),
    Twin::new("environment_tap_roughness", &[ALPHA, Domain::Choice(&[0, 1, 3, 7, 64])], |inputs| {
        vec![roughness(alpha(inputs), inputs.uint())]
    }),
    // Where the eye grazes, the normal is a difference of what is nearly equal: the rounding of its lean is that of the
    // products, some units of the last place of 1.
    Twin::new("environment_tap_normal", &[Domain::Above, ALPHA, SHARE], |inputs| {
        normal(inputs.vec3(), alpha(inputs), inputs.number()).to_array().to_vec()
    })
    .limit(2e-5, 2e-6)
    .rule(Rule::Conditioned(4)),
    Twin::new(
        "environment_tap_axis",
        &[Domain::Above, Domain::Above, Domain::Uniform(-0.5, 1.0, &[-0.5, 0.0, 1.0])],
        |inputs| axis(inputs.vec3(), inputs.vec3(), inputs.number()).to_array().to_vec(),
    )
    // A mirror at the horizon of its normal: the root of a difference near 0.
    .limit(2e-5, 1e-6)
    .rule(Rule::Conditioned(4)),
];
