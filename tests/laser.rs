//! Laser cloth: hues that follow the eye, ramps, directions, and colours that a pixel cannot hold.

use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use vair::measure::twin::classic;
use vair::measure::twin::hsv::{hsv_from_rgb, rgb_from_hsv};
use vair::measure::twin::laser::{angle_along, curve, kept_of_wheel, mean_of_wheel, ramp, wheel};

fn steps(count: u32) -> impl Iterator<Item = f64> {
    (0..=count).map(move |step| f64::from(step) / f64::from(count))
}

fn near(found: DVec3, expected: DVec3, at: &str) {
    assert!((found - expected).abs().max_element() <= 1e-9, "{found} for {expected} {at}");
}

#[test]
fn hues_there_and_back() {
    for (hue, color) in [(0.0, DVec3::X), (1.0 / 3.0, DVec3::Y), (2.0 / 3.0, DVec3::Z), (1.0, DVec3::X)] {
        near(rgb_from_hsv(DVec3::new(hue, 1.0, 1.0)), color, "");
    }
    for red in steps(8) {
        for green in steps(8) {
            for blue in steps(8) {
                let color = DVec3::new(red, green, blue);
                near(rgb_from_hsv(hsv_from_rgb(color)), color, "there and back");
            }
        }
    }
    assert_eq!(hsv_from_rgb(DVec3::splat(0.3)), DVec3::new(0.0, 0.0, 0.3));
    assert_eq!(hsv_from_rgb(DVec3::ZERO), DVec3::ZERO);
}

#[test]
fn the_hue_at_the_facing_end_is_the_offset() {
    for offset in steps(10) {
        let hue = classic::laser::hue(1.0, 5.0, offset);
        near(wheel(offset, 0.0, 1.0, 1.0), rgb_from_hsv(DVec3::new(hue, 1.0, 1.0)), "offset");
    }
    near(wheel(0.3, 0.0, 0.0, 1.0), DVec3::ONE, "saturation 0 is the plain cloth");
    near(wheel(0.3, 0.0, 1.0, 0.0), DVec3::ZERO, "brightness 0 is black");
}

#[test]
fn the_sine_spreads_and_is_not_the_printed_one() {
    for angle in steps(90).map(|share| share * PI / 2.0) {
        let there = DVec2::new(angle.cos(), angle.sin());
        assert!((curve(there, true) - (1.0 - angle.cos().powi(2)).sqrt()).abs() < 1e-7);
        assert!((curve(there, false) - (1.0 - angle.cos())).abs() < 1e-15);
    }
    let largest = steps(1000).map(classic::laser::printed_sine).fold(0.0, f64::max);
    assert!((largest - 0.385).abs() < 5e-4 && classic::laser::printed_sine(0.0) == 0.0, "{largest}");
}

#[test]
fn only_the_angle_along_the_axis_counts() {
    for axis in steps(12).map(|share| DVec2::from_angle(share * PI)) {
        for turn in steps(24).map(|share| share * 2.0 * PI) {
            for cosine in [0.01, 0.3, 0.9, 1.0f64] {
                let eye = DVec2::from_angle(turn) * (1.0 - cosine * cosine).sqrt();
                let found = angle_along(eye.extend(cosine), axis);
                let known = classic::laser::cosine_along(eye.extend(cosine), axis);
                assert!((found.x - known).abs() <= 1e-4, "{found} {known}");
                assert!((found.length() - 1.0).abs() < 1e-4);
            }
        }
    }
    assert!(classic::laser::cosine_along(DVec3::Y, DVec2::X).is_nan(), "0 / 0 across the axis");
    assert_eq!(angle_along(DVec3::Y, DVec2::X), DVec2::ZERO);
    // Unnormalised, the projected view says what the whole view says.
    let (eye, axis) = (DVec3::new(0.6, 0.48, 0.64), DVec2::X);
    let part = DVec3::new(eye.x, 0.0, eye.z);
    assert_eq!(part.z, eye.z);
    assert!((angle_along(eye, axis).x - eye.z).abs() > 0.05);
}

#[test]
fn many_hues_in_a_pixel_are_their_mean() {
    for saturation in steps(4) {
        let mean = (0..3600).map(|hue| wheel(f64::from(hue) / 3600.0, 0.0, saturation, 0.8)).sum::<DVec3>() / 3600.0;
        assert!((mean - mean_of_wheel(saturation, 0.8)).abs().max_element() < 1e-6, "{mean}");
        near(wheel(0.37, 1e30, saturation, 0.8), DVec3::splat(mean_of_wheel(saturation, 0.8)), "faded");
    }
    // Against the mean over the pixel itself: the wheel's first harmonic falls as the Gaussian of the box's variance.
    for change in [0.05, 0.2, 0.5] {
        let pixel =
            (0..1000).map(|at| (2.0 * PI * change * ((f64::from(at) + 0.5) / 1000.0 - 0.5)).cos()).sum::<f64>() / 1e3;
        assert!((kept_of_wheel(change) - pixel).abs() <= 0.03, "{change}: {} {pixel}", kept_of_wheel(change));
    }
    assert!(kept_of_wheel(2.0) < 2e-3);
}

#[test]
fn a_ramp_is_painted() {
    let painted = DVec3::new(0.8, 0.3, 0.1);
    near(ramp(painted, 0.0, 1.0, 1.0), painted, "as painted");
    near(ramp(painted, 1.0, 1.0, 1.0), painted, "a whole turn");
    near(ramp(painted, 0.0, 0.0, 1.0), DVec3::splat(0.8), "without saturation");
    near(ramp(painted, 1.0 / 3.0, 1.0, 1.0), DVec3::new(0.1, 0.8, 0.3), "a third of a turn");
    near(ramp(painted, 0.0, 1.0, 0.5), 0.5 * painted, "half as bright");
}
