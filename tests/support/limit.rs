//! How near a value must come to the computed one.

use glam::{DVec3, Vec4};

/// Relative error of a radiance read from an RGBA16F target: half floats keep 11 bits (2^-11 where the driver rounds,
/// 2^-10 where it cuts); the shader adds up to 1e-3 at the smallest roughness, where the half vector's 3e-7 are divided
/// by alpha = 1e-3 and count twice.
pub const RELATIVE: f64 = 1.0 / 1024.0 + 1e-3;
/// Absolute error: half floats below 6e-5 have steps of 6e-8; twins agree to 1e-6.
pub const ABSOLUTE: f64 = 1e-6;

/// Says what differs when `found` is not `expected`, channel by channel.
pub fn close(what: &str, found: Vec4, expected: DVec3) -> Result<(), String> {
    within(what, found, expected, RELATIVE, ABSOLUTE)
}

/// [`close`] with limits of its own.
pub fn within(what: &str, found: Vec4, expected: DVec3, relative: f64, absolute: f64) -> Result<(), String> {
    let found = found.truncate().as_dvec3();
    let is_close = (0..3).all(|i| (found[i] - expected[i]).abs() <= absolute + relative * expected[i].abs());
    if is_close { Ok(()) } else { Err(format!("{what}: {found} is not the computed {expected}")) }
}

/// Fails with all that went wrong, and when nothing was checked.
#[track_caller]
pub fn all_hold(checks: impl IntoIterator<Item = Result<(), String>>) {
    let (mut count, mut wrong) = (0, Vec::new());
    for check in checks {
        count += 1;
        wrong.extend(check.err());
    }
    assert!(count > 0, "nothing was checked");
    assert!(wrong.is_empty(), "{} of {count} checks fail:\n{}", wrong.len(), wrong.join("\n"));
}
