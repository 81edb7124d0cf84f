//! The fit of an anisotropic lobe's albedo stays beside quadrature, on the side that gains nothing; the lobe turns with the
//! sign of its anisotropy and is isotropic without it.

use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};
use vair::measure::twin::albedo::{Fit, gauss_legendre};
use vair::measure::twin::anisotropy::{Lobe, albedo_terms, average_terms};
use vair::measure::twin::ggx;

fn direction(cosine: f64, turn: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    DVec3::new(sine * turn.cos(), sine * turn.sin(), cosine)
}

/// `(E1, Q)` by quadrature over the visible normals (Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical
/// Caps").
fn truth(v: DVec3, (ax, ay): (f64, f64), rule: &[(f64, f64)]) -> (f64, f64) {
    let pole = DVec3::new(ax * v.x, ay * v.y, v.z).normalize();
    let lambda = |w: DVec3| 0.5 * ((1.0 + ((ax * w.x).powi(2) + (ay * w.y).powi(2)) / (w.z * w.z)).sqrt() - 1.0);
    let turns = 2 * rule.len();
    let (mut white, mut fresnel) = (0.0, 0.0);
    for &(u, weight) in rule {
        let z = u * u * u * (1.0 + pole.z) - pole.z;
        let radius = (1.0 - z * z).max(0.0).sqrt();
        for turn in 0..turns {
            let (y, x) = (2.0 * PI * (turn as f64 + 0.5) / turns as f64).sin_cos();
            let cap = DVec3::new(radius * x, radius * y, z) + pole;
            let h = DVec3::new(ax * cap.x, ay * cap.y, cap.z.max(1e-12)).normalize();
            let l = 2.0 * v.dot(h) * h - v;
            if l.z > 0.0 {
                let shadowing = (1.0 + lambda(v)) / (1.0 + lambda(v) + lambda(l));
                let share = 3.0 * u * u * weight / turns as f64 * shadowing;
                white += share;
                fresnel += share * (1.0 - v.dot(h)).clamp(0.0, 1.0).powi(5);
            }
        }
    }
    (white, fresnel / white)
}

/// Widths, cosines and turns over all of their ranges.
fn points() -> impl Iterator<Item = ((f64, f64), DVec3)> {
    let widths = [1e-3, 4e-3, 0.016, 0.063, 0.25, 0.5, 1.0];
    let pairs = widths.into_iter().flat_map(move |ax| widths.map(|ay| (ax, ay)));
    pairs.flat_map(|alpha| {
        let directions = [1e-3, 0.01, 0.1, 0.2, 0.4, 0.7, 1.0].into_iter();
        let turns = [0.0, 22.5, 45.0, 67.5, 78.0, 84.0, 87.0, 90.0f64];
        directions.flat_map(move |mu| turns.map(move |turn| (alpha, direction(mu, turn.to_radians()))))
    })
}

fn compensated(f0: f64, (white, fresnel): (f64, f64), by: f64) -> f64 {
    (f0 + (1.0 - f0) * fresnel) * white * (1.0 + f0 * (1.0 - by) / by)
}

#[test]
fn ggx_furnace_ms_of_anisotropic_lobes() {
    let (fit, rule) = (Fit::shipped(), gauss_legendre(56));
    let (mut most, mut least) = (f64::NEG_INFINITY, f64::INFINITY);
    for (alpha, v) in points() {
        let (found, fitted) = (truth(v, alpha, &rule), albedo_terms(&fit, v, alpha));
        for f0 in [0.0, 0.04, 0.2, 0.5, 1.0] {
            let off = compensated(f0, found, fitted.0) - compensated(f0, fitted, fitted.0);
            assert!(off <= 1e-3, "{alpha:?} {v} F0 {f0}: {found:?}, fit {fitted:?} gains {off}");
            most = most.max(off);
            least = least.min(off);
        }
    }
    assert!(least >= -0.21, "what the header of anisotropy.glsl says: {least}");
    assert!(most >= -1e-3, "the fit touches the truth somewhere: {most}");
}

#[test]
fn the_average_is_at_most_a_little_too_small() {
    let (fit, rule) = (Fit::shipped(), gauss_legendre(32));
    for (ax, ay) in points().map(|(alpha, _)| alpha).step_by(35) {
        for f0 in [0.0, 0.04, 0.3, 0.7] {
            let lobe = Lobe { f0: DVec3::splat(f0), f90: 1.0, alpha: (ax, ay) };
            let ring = |mu: f64| {
                let turn = |turn: i32| direction(mu, FRAC_PI_2 * (f64::from(turn) + 0.5) / 24.0);
                (0..24).map(|index| lobe.albedo(&fit, turn(index)).x).sum::<f64>() / 24.0
            };
            let average: f64 = rule.iter().map(|&(mu, weight)| weight * 2.0 * mu * ring(mu)).sum();
            let off = average - lobe.average_albedo(&fit).x;
            assert!((-2e-4..=0.016).contains(&off), "{ax} {ay} F0 {f0}: {average} less {off}");
        }
    }
}

#[test]
fn aniso_swap_and_aniso_zero() {
    let fit = Fit::shipped();
    for (roughness, anisotropy) in [(0.2, 0.3), (0.5, -0.98), (1.0, 1.0), (0.03, 0.7), (0.7, 0.0)] {
        let (ax, ay) = ggx::anisotropic_alpha(roughness, anisotropy);
        let swapped = ggx::anisotropic_alpha(roughness, -anisotropy);
        assert!((ay - swapped.0).abs() <= 1e-12 && (ax - swapped.1).abs() <= 1e-12, "{swapped:?}");
        for mu in [1e-7, 0.1, 0.8, 1.0] {
            let (w, turned) = (direction(mu, 0.4), direction(mu, 0.4 + FRAC_PI_2));
            let (here, there) = (albedo_terms(&fit, w, (ax, ay)), albedo_terms(&fit, turned, (ay, ax)));
            assert!(
                (here.0 - there.0).abs() <= 1e-5 * here.0 && (here.1 - there.1).abs() <= 1e-5,
                "{here:?} {there:?}"
            );
            if anisotropy == 0.0 {
                let plain = fit.terms(mu, roughness);
                assert!((here.0 - plain.0).abs() <= 1e-6 && (here.1 - plain.1).abs() <= 1e-6, "{here:?} {plain:?}");
                let averages = average_terms(&fit, (ax, ay)).into_iter().zip(fit.averages(roughness));
                assert!(averages.into_iter().all(|(here, plain)| (here - plain).abs() <= 1e-6));
            }
        }
    }
}
