//! What the renderer computes on the host agrees with the twins, which share no code with it.

use glam::DVec2;
use vair::material::{Gauze, Threads, Weave};
use vair::math::{direction_from_octahedral, gauss_legendre, linear_from_srgb_byte, pcg3d};
use vair::measure::twin::{albedo, color, gauze, hash, octahedral};

#[test]
fn random_words() {
    for index in 0..1000u32 {
        let key = [index, index.wrapping_mul(0x9e37_79b9), !index];
        assert_eq!(pcg3d(key), hash::pcg3d(key));
    }
}

#[test]
fn coded_bytes() {
    for byte in 0..=255u8 {
        assert_eq!(linear_from_srgb_byte(byte), color::linear_from_srgb(f64::from(byte) / 255.0) as f32, "{byte}");
    }
}

#[test]
fn coded_directions() {
    for index in 0..1000 {
        let coded = DVec2::from_array([0, 1].map(|at| f64::from(pcg3d([index, 3, 5])[at]) / 2f64.powi(31) - 1.0));
        let off = direction_from_octahedral(coded) - octahedral::direction(coded);
        assert!(off.length() < 1e-15, "{coded}: {off}");
    }
}

#[test]
fn quadrature() {
    for count in [1, 8, 64, 128] {
        for (ours, twins) in gauss_legendre(count).into_iter().zip(albedo::gauss_legendre(count)) {
            assert!((ours.0 - twins.0).abs().max((ours.1 - twins.1).abs()) < 1e-15, "{count}: {ours:?}, {twins:?}");
        }
    }
}

#[test]
fn threads_of_gauze() {
    for weave_density in [0.0, 1e-3, 0.5, 6.0, 40.0, 200.0] {
        let threads = |weave| Gauze { weave_density, weave, ..Gauze::default() }.threads();
        let density = f64::from(weave_density);
        let pairs = [
            (threads(Weave::Matted), gauze::Weave::matted(density)),
            (threads(Weave::Crossed), gauze::Weave::crossed(density)),
        ];
        for (ours, twins) in pairs {
            let same = match (ours, twins) {
                (Threads::Matted(ours), gauze::Weave::Matted(twins)) => (ours - twins).abs() < 1e-12,
                (Threads::Crossed(ours), gauze::Weave::Crossed(twins)) => (ours - twins).abs() < 1e-12,
                _ => false,
            };
            assert!(same, "{weave_density}: {ours:?}, {twins:?}");
            let (mean, expected) = (ours.mean_opacity(), twins.mean_opacity());
            assert!((mean - expected).abs() < 1e-12, "{weave_density}, {ours:?}: {mean}, {expected}");
        }
    }
}
