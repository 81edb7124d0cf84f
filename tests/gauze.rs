//! A sheet of gauze hides what its threads cover, and gives back, lets through or absorbs all that they meet.
#![cfg(feature = "measure")]

use glam::DVec3;
use std::f64::consts::PI;
use vair::measure::twin::albedo::{Fit, gauss_legendre};
use vair::measure::twin::anisotropy::Lobe;
use vair::measure::twin::classic::gauze::{half_opacity_cosine, opacity as classic_opacity};
use vair::measure::twin::gauze::{Gauze, Weave, met_by_both, phi1 as phi1_of, through};
use vair::measure::twin::twins;

fn direction(cosine: f64, turn: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    DVec3::new(sine * turn.cos(), sine * turn.sin(), cosine)
}

/// Share of rays along `w` that pass two layers of parallel round threads, one along y and one along x, of diameter
/// `cover` and pitch 1, by ray casting from quasi-random origins (the R2 sequence, Roberts 2018, "The Unreasonable
/// Effectiveness of Quasirandom Sequences").
fn cast(cover: f64, w: DVec3) -> f64 {
    /// Whether a line through (x, 0) with that slope in the plane across the threads passes them all.
    fn passes(x: f64, direction: [f64; 2], radius: f64) -> bool {
        let [dx, dz] = direction;
        // Threads beyond the line's closest approach are farther off by its slope.
        let reach = 2.0 + radius * dx.hypot(dz) / dz;
        let mut thread = (x - reach).floor();
        while thread <= x + reach {
            // Distance of the thread's axis from the line.
            if ((thread - x) * dz).abs() / dx.hypot(dz) < radius {
                return false;
            }
            thread += 1.0;
        }
        true
    }
    let samples = 1 << 16;
    let passed = (0..samples).filter(|&index| {
        let at = |step: f64| (0.5 + step * f64::from(index)).fract();
        let (x, y) = (at(0.754_877_666_246_692_8), at(0.569_840_290_998_053_3));
        passes(x, [w.x, w.z], 0.5 * cover) && passes(y, [w.y, w.z], 0.5 * cover)
    });
    passed.count() as f64 / f64::from(samples)
}

#[test]
fn gauze_mc() {
    let mut worst: f64 = 0.0;
    for cover in [0.1, 0.3, 0.6] {
        for (mu, turn) in [(1.0, 0.0), (0.8, 0.3), (0.5, 0.0), (0.5, PI / 4.0), (0.3, 1.2), (0.15, 0.7)] {
            let w = direction(mu, turn);
            let (found, expected) = (Weave::Crossed(cover).transmittance(w), cast(cover, w));
            worst = worst.max((found - expected).abs());
            assert!((found - expected).abs() <= 3e-3, "cover {cover} mu {mu} turn {turn}: {found}, cast {expected}");
        }
    }
    assert!(worst > 0.0, "two different ways do not agree to the last bit");
}

#[test]
fn gauze_monotone() {
    for density in [0.0, 1e-6, 0.5, 1.0, 10.0, 200.0, 1000.0] {
        for weave in [Weave::matted(density), Weave::crossed(density)] {
            for turn in [0.0, 0.4, PI / 4.0] {
                let mut before = 1.0;
                for step in 0..=1000 {
                    let theta = PI / 2.0 * f64::from(step) / 1000.0;
                    let found = weave.transmittance(direction(theta.cos().max(0.0), turn));
                    assert!(
                        found.is_finite() && (0.0..=before).contains(&found),
                        "{weave:?} {theta}: {found} {before}"
                    );
                    before = found;
                }
            }
            let mean = weave.mean_opacity();
            assert!(mean > 0.0 && mean <= 1.0 + 1e-12, "{weave:?}: {mean}");
        }
    }
}

#[test]
fn the_slider_keeps_the_angle_of_half_opacity() {
    for (density, facing) in [(1.0, 0.451), (10.0, 0.221), (200.0, 0.056), (1000.0, 0.026)] {
        let half = direction(half_opacity_cosine(density), 0.0);
        assert!((classic_opacity(density, half.z) - 0.5).abs() < 1e-9);
        assert!((Weave::matted(density).opacity(half) - 0.5).abs() < 1e-9);
        assert!((Weave::crossed(density).opacity(half) - 0.5).abs() < 1e-9);
        assert!((Weave::matted(density).opacity(DVec3::Z) - facing).abs() < 1e-3);
    }
    for weave in [Weave::matted(0.0), Weave::crossed(0.0)] {
        assert!((weave.opacity(DVec3::Z) - 1.0).abs() < 1e-12, "0 is opaque");
    }
}

#[test]
fn gauze_split() {
    let (fit, rule) = (Fit::shipped(), gauss_legendre(128));
    let dark = Lobe { f0: DVec3::ZERO, f90: 0.0, alpha: (0.2, 0.2) };
    for weave in [0.0, 1.0, 10.0, 200.0].into_iter().flat_map(|d| [Weave::matted(d), Weave::crossed(d)]) {
        for albedo in [1.0, 0.3].into_iter().take(if matches!(weave, Weave::Matted(_)) { 2 } else { 1 }) {
            let gauze = Gauze { diffuse: DVec3::splat(albedo), weave, lobe: dark };
            let mean = weave.mean_opacity();
            for v in [direction(1.0, 0.0), direction(0.4, 0.3), direction(0.02, 0.7)] {
                let (mut reflected, mut shone_through) = (0.0, 0.0);
                for &(u, weight) in &rule {
                    // Crowded towards the horizon, where threads close.
                    let mu = u * u;
                    for &(turn, share) in &rule {
                        let l = direction(mu, turn * PI / 4.0);
                        let behind = DVec3::new(l.x, l.y, -l.z);
                        let at = weight * share * 4.0 * PI * u * mu;
                        // A grid looks the same from each of its eight turns; only v.l could tell, and nothing asks it.
                        reflected += at * gauze.diffuse_bsdf(&fit, mean, v, l).x;
                        shone_through += at * gauze.diffuse_bsdf(&fit, mean, v, behind).x;
                    }
                }
                let (met, between) = (weave.opacity(v), weave.transmittance(v));
                let absorbed = (1.0 - albedo) * met;
                let sum = reflected + shone_through + between + absorbed;
                assert!(
                    (sum - 1.0).abs() <= 1e-5,
                    "{weave:?} {v}: R {reflected} T {shone_through} + {between} A {absorbed}"
                );
                assert!(reflected >= shone_through, "light comes back rather than through");
            }
        }
    }
}

#[test]
fn phi1() {
    for step in 0..=1200 {
        let x = 10f64.powf(-10.0 + 12.0 * f64::from(step) / 1200.0);
        if x <= 1.0 {
            // sum (-x)^n / (n + 1)!
            let (mut sum, mut term) = (0.0, 1.0);
            for n in 1..30 {
                sum += term;
                term *= -x / f64::from(n + 1);
            }
            assert!((phi1_of(x) / sum - 1.0).abs() <= 1e-12, "{x}");
        }
        let same = through(x, x);
        assert!(same.is_finite() && (0.0..=0.5 + 1e-12).contains(&same), "Li = Lo at {x}: {same}");
    }
    // On the device by its judge.
    let judge = twins().find(|twin| twin.name == "gauze_phi1").unwrap();
    assert!(judge.limit.rel <= 1e-6 && judge.limit.abs == 0.0);
}

#[test]
fn what_eye_and_light_both_meet_is_no_more_than_either() {
    for a in [0.0, 1e-30, 0.01, 0.5, 1.0] {
        for b in [0.0, 1e-30, 0.01, 0.5, 1.0] {
            let both = met_by_both(a, b);
            assert!(both.is_finite() && both <= a.min(b) * (1.0 + 1e-12) && both >= a * b, "{a} {b}: {both}");
        }
    }
    assert_eq!(met_by_both(1.0, 1.0), 1.0);
}
