//! Twin of `environment_lobe.glsl`: taps by which an anisotropic lobe reads a prefiltered environment.
//!
//! Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs" (visible normals, here of a profile
//! in a plane). `tests/environment_lobe.rs` holds them to quadrature of the lobe.

use super::ggx;
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
    (alpha.0.min(alpha.1) + 0.2 * spread(alpha) / f64::from(taps.max(1))).min(1.0).sqrt()
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
