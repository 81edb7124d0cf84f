//! Integrals over directions that settle by themselves: a rule of twice as many points a side is tried until nothing changes.
//!
//! A product rule sees a lobe as narrow as 1e-3 only in variables that follow it, so each integral names its own: visible
//! normals for GGX, a cube of the cosine for what sits at the horizon, the fibre's own angles for strands.

use crate::measure::twin::albedo::gauss_legendre;
use crate::measure::twin::ggx;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Change between two rules at which an integral counts as settled, relative where it exceeds 1. A fifth of what the
/// furnace must tell; of a converging pair, the finer rule, which is returned, errs by less than they differ.
const SETTLED: f64 = 2e-4;

/// Nodes and weights on [0, 1].
type Rule = [(f64, f64)];

static RULES: LazyLock<[Vec<(f64, f64)>; 5]> = LazyLock::new(|| [12, 24, 48, 96, 192].map(gauss_legendre));

/// The integral, by the first rule that agrees with the one before. One that never settles counts with its last change on
/// top, so that what is not resolved cannot pass for small.
pub fn settled(integral: impl Fn(&Rule) -> f64) -> f64 {
    let [first, finer @ ..] = &*RULES;
    let (mut value, mut change) = (integral(first), 0.0f64);
    for rule in finer {
        let now = integral(rule);
        change = (now - value).abs();
        value = now;
        // Not finite is settled, too: it will not get better.
        if !change.is_finite() || change <= SETTLED * value.abs().max(1.0) {
            return value;
        }
    }
    value + change
}

/// Integral of `value(u, turn)` over u in [0, 1] and one turn, in radians.
pub fn over_turns(value: impl Fn(f64, f64) -> f64) -> f64 {
    settled(|rule| {
        let step = 2.0 * PI / rule.len() as f64;
        let ring = |u| (0..rule.len()).map(|index| value(u, step * (index as f64 + 0.5))).sum::<f64>();
        rule.iter().map(|&(u, weight)| weight * step * ring(u)).sum()
    })
}

/// The direction at a cosine from z and a turn around it.
pub fn direction(cosine: f64, turn: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    let (y, x) = turn.sin_cos();
    DVec3::new(sine * x, sine * y, cosine)
}

/// Integral over all directions, in a fibre's own angles: along `axis`, and around it from the far side of `eye` to the far
/// side again, as fibres scatter by half that angle, which has an edge there.
pub fn over_sphere(axis: DVec3, eye: DVec3, value: impl Fn(DVec3) -> f64) -> f64 {
    let x = (eye - eye.dot(axis) * axis).try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector());
    let y = axis.cross(x);
    settled(|rule| {
        let at = |u: f64, turn: f64| {
            let along = direction(2.0 * u - 1.0, 2.0 * PI * (turn - 0.5));
            value(along.x * x + along.y * y + along.z * axis)
        };
        let ring = |u| rule.iter().map(|&(turn, weight)| weight * at(u, turn)).sum::<f64>();
        4.0 * PI * rule.iter().map(|&(u, weight)| weight * ring(u)).sum::<f64>()
    })
}

/// Integral over the upper hemisphere, crowded towards the horizon.
pub fn over_hemisphere(value: impl Fn(DVec3) -> f64) -> f64 {
    over_turns(|u, turn| 3.0 * u * u * value(direction(u * u * u, turn)))
}

/// Integral over the upper hemisphere of what depends on the cosine alone.
pub fn over_cosines(value: impl Fn(f64) -> f64) -> f64 {
    settled(|rule| rule.iter().map(|&(u, weight)| weight * 2.0 * PI * 3.0 * u * u * value(u * u * u)).sum())
}

/// The same by the finest rule alone, for limits that are narrower than what counts as settled.
pub fn over_cosines_finely(value: impl Fn(f64) -> f64) -> f64 {
    let [.., finest] = &*RULES;
    finest.iter().map(|&(u, weight)| weight * 2.0 * PI * 3.0 * u * u * value(u * u * u)).sum()
}

/// Integral over the directions in which visible GGX normals of these widths reflect the eye `v` (Dupuy & Benyoub 2023,
/// "Sampling Visible GGX Normals with Spherical Caps"); `value` must be 0 below the horizon.
pub fn over_reflections(v: DVec3, (ax, ay): (f64, f64), value: impl Fn(DVec3) -> f64) -> f64 {
    let stretched = DVec3::new(ax * v.x, ay * v.y, v.z);
    let length = stretched.length();
    let pole = stretched / length;
    // Smith's G1 over 4 v.z: with D, the density of the reflections.
    let visible = 0.5 / (v.z + length);
    over_turns(|u, turn| {
        // The share of the cap, as a cube: grazing normals, where the lobe turns within its width, get most points.
        let z = u * u * u * (1.0 + pole.z) - pole.z;
        let radius = (1.0 - z * z).max(0.0).sqrt();
        let (y, x) = turn.sin_cos();
        let cap = DVec3::new(radius * x, radius * y, z) + pole;
        let h = DVec3::new(ax * cap.x, ay * cap.y, cap.z.max(1e-12)).normalize();
        let l = 2.0 * v.dot(h) * h - v;
        if l.z <= 0.0 {
            return 0.0;
        }
        3.0 * u * u / (2.0 * PI) * value(l) / (ggx::ndf(h, ax, ay) * visible)
    })
}

/// Integral over all half vectors of `value(h)`, in slopes stretched by the widths of the lobe: slope = alpha u / (1 - u).
pub fn over_normals((ax, ay): (f64, f64), value: impl Fn(DVec3) -> f64) -> f64 {
    over_turns(|u, turn| {
        let slope = u / (1.0 - u);
        let h = DVec3::new(ax * slope * turn.cos(), ay * slope * turn.sin(), 1.0).normalize();
        ax * ay * slope / (1.0 - u).powi(2) * h.z.powi(3) * value(h)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::twin::albedo::directional_albedo;

    #[test]
    fn known_integrals() {
        let near = |found: f64, expected: f64| assert!((found - expected).abs() <= SETTLED, "{found} for {expected}");
        near(over_sphere(DVec3::X, DVec3::Y, |_| 1.0), 4.0 * PI);
        near(over_hemisphere(|l| l.z), PI);
        near(over_cosines(|mu| mu * mu), 2.0 * PI / 3.0);
        near(over_normals((1e-3, 1.0), |h| ggx::ndf(h, 1e-3, 1.0) * h.z), 1.0);
    }

    #[test]
    fn reflections_give_the_albedo_of_ggx() {
        let rule = gauss_legendre(200);
        for (mu, alpha) in [(1e-3, 1e-3), (1e-3, 0.3), (0.05, 1.0), (0.3, 0.1), (0.7, 0.03), (1.0, 1e-3), (1.0, 1.0)] {
            let v = direction(mu, 0.0);
            let lobe = |l| {
                let h = ggx::half_vector(v, l);
                ggx::ndf(h, alpha, alpha) * ggx::masking_shadowing_times_cosine(v, l, alpha, alpha)
            };
            let (scale, bias) = directional_albedo(mu, alpha, &rule);
            let found = over_reflections(v, (alpha, alpha), lobe);
            assert!((found - scale - bias).abs() <= SETTLED, "mu {mu} alpha {alpha}: {found} for {}", scale + bias);
        }
    }

    #[test]
    fn what_does_not_settle_counts_for_more() {
        // No two rules in a row agree.
        let rules = std::cell::Cell::new(0);
        let restless = settled(|_| {
            rules.set(rules.get() + 1);
            f64::from(rules.get() % 2)
        });
        assert_eq!((restless, rules.get()), (2.0, 5));
        assert!(settled(|_| f64::NAN).is_nan());
    }
}
