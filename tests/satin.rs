//! Satin is a mixture that never gains light, has the colour of its light, and keeps shining at full anisotropy.
#![cfg(feature = "measure")]

use glam::DVec3;
use std::f64::consts::FRAC_PI_2;
use vair::measure::furnace::checks;
use vair::measure::twin::albedo::Fit;
use vair::measure::twin::ggx;
use vair::measure::twin::satin::Satin;

const SILK: Satin = Satin {
    base_color: DVec3::new(0.5, 0.1, 0.1),
    metallic: 0.0,
    roughness: 0.4,
    anisotropy: 0.8,
    specular_strength: 7.0,
    specular_color: DVec3::new(1.0, 0.5, 0.2),
    secondary_color: DVec3::new(0.2, 0.2, 0.4),
    secondary_width: 1.5,
    two_way: true,
    light_tint: 0.5,
};

fn direction(cosine: f64, turn: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    DVec3::new(sine * turn.cos(), sine * turn.sin(), cosine)
}

#[test]
fn satin_mixture() {
    // Shares add up to 1, whatever the strengths, and each lobe is a reflectance.
    for strength in [0.0, 1e-6, 1.0, 12.5, 30.0] {
        for (narrow, wide) in [(1.0, 0.0), (1.0, 0.3), (0.2, 1.0), (0.0, 1.0)] {
            let satin = Satin {
                specular_strength: strength,
                specular_color: DVec3::splat(narrow),
                secondary_color: DVec3::splat(wide),
                ..SILK
            };
            let lobes = satin.lobes();
            let shares: f64 = lobes.iter().map(|(share, _)| share).sum();
            assert!(lobes.is_empty() == (strength == 0.0) && (lobes.is_empty() || (shares - 1.0).abs() < 1e-12));
            assert!(lobes.iter().all(|(_, lobe)| lobe.f0.max_element() <= lobe.f90 && lobe.f90 <= 1.0));
        }
    }
    // Two ways, strength 0 to 30: the furnace.
    let checks = checks();
    for property in ["directional albedo", "directional albedo, two ways"] {
        let of_satin = |check: &&vair::measure::furnace::PropertyCheck| check.material == "satin" && !check.classic;
        let check = checks.iter().filter(of_satin).find(|check| check.property == property).unwrap();
        let judged = check.judge(200);
        assert!(judged.pass && judged.limit == Some(1.001), "{judged}");
    }
}

#[test]
fn light_colour_and_linearity() {
    let fit = Fit::shipped();
    for (index, mu_l) in [1e-3, 0.2, 0.7, 1.0].into_iter().enumerate() {
        let (v, l) = (direction(0.6, 0.3), direction(mu_l, index as f64));
        let brdf = SILK.brdf_times_cosine(&fit, v, l);
        assert!(brdf.is_finite() && brdf.min_element() >= 0.0);
        let blue = brdf * DVec3::Z;
        assert_eq!((blue.x, blue.y), (0.0, 0.0), "no red light, no red");
        let (once, twice) = (brdf * DVec3::new(0.7, 1.3, 2.0), brdf * DVec3::new(1.4, 2.6, 4.0));
        assert!((twice - 2.0 * once).abs().max_element() <= 1e-6 * twice.max_element());
    }
}

#[test]
fn silk_looks_like_silk() {
    let fit = Fit::shipped();
    let one = |anisotropy| Satin { anisotropy, two_way: false, ..SILK };
    let v = direction(0.8, 0.0);
    for anisotropy in [0.3, 0.8, 0.98, 1.0] {
        // A quarter turn of everything is the other sign.
        let turned = |w: DVec3| DVec3::new(-w.y, w.x, w.z);
        for turn in [0.0, 0.5, 2.0, 3.1] {
            let l = direction(0.7, turn);
            let here = one(anisotropy).brdf_times_cosine(&fit, v, l);
            let there = one(-anisotropy).brdf_times_cosine(&fit, turned(v), turned(l));
            assert!((here - there).abs().max_element() <= 1e-5 * here.max_element(), "{anisotropy} {turn}");
        }
        // The streak: brighter than round satin in the mirror, and farther along its run than across.
        let mirror = DVec3::new(-v.x, -v.y, v.z);
        let peak = |anisotropy| one(anisotropy).brdf_times_cosine(&fit, v, mirror).x;
        assert!(peak(anisotropy) > 0.9 * peak(0.0), "bright to the end: {} {}", peak(anisotropy), peak(0.0));
        let from_front =
            |tilt: f64, turn: f64| one(anisotropy).brdf_times_cosine(&fit, DVec3::Z, direction(tilt, turn)).x;
        assert!(from_front(0.8, 0.0) > from_front(0.8, FRAC_PI_2));
    }
    assert_eq!(ggx::anisotropic_alpha(0.5, 1.0), ggx::anisotropic_alpha(0.5, 0.98));
}
