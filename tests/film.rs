//! Films interfere as physics says: against 801 wavelengths, at the limits, and without colour where there is no film.

use glam::DVec3;
use std::sync::LazyLock;
use vair::measure::twin::film::{self, BANDS, Fit, bare, f0_of_reflectance, spectral_reflectance};
use vair::measure::twin::hash;

static FIT: LazyLock<Fit> = LazyLock::new(Fit::shipped);

/// A film of any thickness and index that shows colours, on any base: (cosine, thickness_nm, film_ior, base_f0).
fn random_film(index: i32) -> (f64, f64, f64, DVec3) {
    let [a, b, c] = [0, 1, 2].map(|draw| DVec3::from_array(hash::cell([index, draw, 0])));
    (a.x, 1200.0 * a.y, 1.0 + 1.5 * a.z, if index % 2 == 0 { DVec3::splat(b.x) } else { DVec3::new(b.y, b.z, c.x) })
}

#[test]
fn film_airy() {
    let (mut sum, mut worst) = (0.0, (0.0, 0));
    let count = 3000;
    for index in 0..count {
        let (cosine, thickness_nm, film_ior, base_f0) = random_film(index);
        let truth = spectral_reflectance(cosine, thickness_nm, film_ior, base_f0);
        let error = (FIT.reflectance(cosine, thickness_nm, film_ior, base_f0) - truth).abs();
        sum += error.element_sum() / 3.0;
        worst = if error.max_element() > worst.0 { (error.max_element(), index) } else { worst };
    }
    let mean = sum / f64::from(count);
    assert!(mean <= 0.005, "mean {mean}");
    assert!(worst.0 <= 0.03, "{} at {:?}", worst.0, random_film(worst.1));
}

#[test]
fn film_limits() {
    for index in 0..3000 {
        let (cosine, thickness_nm, film_ior, base_f0) = random_film(index);
        let plain = DVec3::from_array(base_f0.to_array().map(|f0| bare(cosine, f0)));
        let at = format!("cosine {cosine} thickness {thickness_nm} ior {film_ior} base {base_f0}");
        let reflectance = |thickness_nm, film_ior| FIT.reflectance(cosine, thickness_nm, film_ior, base_f0);
        for thin_nm in [0.0, 1e-40, 1e-6, 1e-4] {
            let off = (reflectance(thin_nm, film_ior) - plain).abs().max_element();
            assert!(off <= 1e-3, "no film: off by {off}, {at} {thin_nm}");
        }
        let off = (reflectance(thickness_nm, 1.0) - plain).abs().max_element();
        assert!(off <= 1e-6, "a film of air: off by {off}, {at}");
        let shown = reflectance(thickness_nm, film_ior);
        assert!(shown.min_element() >= 0.0 && shown.max_element() <= 1.0, "{shown}, {at}");
        // So thick that the orders wash out: one colour, that of the base.
        let thick = FIT.reflectance(cosine, 1e6, film_ior, DVec3::splat(base_f0.x));
        assert!(thick.max_element() - thick.min_element() <= 1e-9, "{thick}, {at}");
    }
}

#[test]
fn film_tir() {
    for film_ior in [0.1, 0.7, 0.999, 1.0] {
        for cosine in [0.0, 1e-7, 0.01, 0.5, 0.714_142_842_854_285, 1.0] {
            for base_f0 in [0.0, 0.04, 1.0] {
                for thickness_nm in [0.0, 300.0, 1e30] {
                    let shown = FIT.reflectance(cosine, thickness_nm, film_ior, DVec3::splat(base_f0));
                    let at = format!("ior {film_ior} cosine {cosine} base {base_f0} thickness {thickness_nm}: {shown}");
                    assert!(shown.is_finite() && shown.min_element() >= 0.0 && shown.max_element() <= 1.0, "{at}");
                    let is_total = film_ior * film_ior < 1.0 - cosine * cosine;
                    assert!(!is_total || shown == DVec3::ONE, "{at}");
                }
            }
        }
    }
}

#[test]
fn white_stays_white_and_each_channel_reads_its_own_weights() {
    let matrix = film::rgb_from_equal_energy_xyz();
    assert!((matrix * DVec3::ONE - DVec3::ONE).abs().max_element() < 1e-6, "{matrix}");
    // Row by row; transposed, red would look at blue's place.
    let rows = matrix.transpose();
    let known = [
        DVec3::new(3.1463, -1.6661, -0.4801),
        DVec3::new(-0.9955, 1.9558, 0.0398),
        DVec3::new(0.0636, -0.2146, 1.1510),
    ];
    for (row, known) in [rows.x_axis, rows.y_axis, rows.z_axis].into_iter().zip(known) {
        assert!((row - known).abs().max_element() < 5e-5, "{row} for {known}");
    }
    for (channel, weights) in FIT.weights.iter().enumerate() {
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-9, "{weights:?}");
        assert!((FIT.sensitivity(channel, 0.0) - 1.0).abs() < 1e-9);
    }
    // A quarter of a wave of 630, 540 and 450 nm: its own channel is darkest.
    for (channel, wavelength_um) in [0.63, 0.54, 0.45].into_iter().enumerate() {
        let seen = [0, 1, 2].map(|at| FIT.sensitivity(at, 0.5 * wavelength_um));
        assert!(seen.iter().enumerate().all(|(at, value)| at == channel || *value > seen[channel] + 0.02), "{seen:?}");
    }
}

#[test]
fn bands_answer_as_the_spectrum_does() {
    let mut worst = 0.0f64;
    for step in 0..=400 {
        let path_um = f64::from(step) / 80.0;
        let truth = film::color_of(|wavelength_nm| (std::f64::consts::TAU * path_um * 1e3 / wavelength_nm).cos());
        for channel in 0..3 {
            worst = worst.max((FIT.sensitivity(channel, path_um) - truth[channel]).abs());
        }
    }
    assert!(worst <= 0.06, "{worst}");
    assert_eq!(FIT.wavenumber.len(), BANDS);
}

#[test]
fn schlick_through_a_reflectance_returns_it() {
    for cosine in [0.01, 0.3, 1.0] {
        for f0 in [0.0, 0.2, 1.0] {
            let schlick = f0 + (1.0 - f0) * (1.0f64 - cosine).powi(5);
            assert!((f0_of_reflectance(schlick, cosine) - f0).abs() < 1e-9);
        }
    }
    assert_eq!(f0_of_reflectance(0.0, 0.0), 0.0);
}
