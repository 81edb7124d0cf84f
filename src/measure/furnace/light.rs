//! What holds for every material under any one light: darkness without it, linearity, its own colour, finite radiance.

use super::property_check::{Input, PropertyCheck};
use glam::DVec3;

/// Checks of `radiance`, which takes one number for each of `inputs` and the light's irradiance per channel. Of our own
/// materials the irradiance is a factor, so that only the last can fail; the rest is asked of rendered frames
/// (tests/render/light.rs).
pub fn checks(
    material: &'static str,
    classic: bool,
    inputs: &[Input],
    radiance: impl Fn(&[f64], DVec3) -> DVec3 + Copy + Send + Sync + 'static,
) -> Vec<PropertyCheck> {
    let check = |property, limit, value| PropertyCheck {
        material,
        property,
        classic,
        limit: Some(limit),
        inputs: inputs.to_vec(),
        value,
    };
    let mut checks = vec![
        check("radiance with lights off", 0.0, Box::new(move |x| radiance(x, DVec3::ZERO).abs().max_element())),
        check(
            "departure from linear in light",
            1e-6,
            Box::new(move |x| {
                let (once, thrice) = (radiance(x, DVec3::ONE), radiance(x, DVec3::splat(3.0)));
                (thrice - 3.0 * once).abs().max_element() / thrice.abs().max_element().max(f64::MIN_POSITIVE)
            }),
        ),
        check(
            "red and green under blue light",
            0.0,
            Box::new(move |x| {
                let seen = radiance(x, DVec3::Z);
                seen.x.abs().max(seen.y.abs())
            }),
        ),
        check(
            "radiance below 0",
            0.0,
            Box::new(move |x| {
                let seen = radiance(x, DVec3::ONE);
                // `min_element` would let NaN pass for its neighbour.
                if seen.is_finite() { (-seen.min_element()).max(0.0) } else { f64::NAN }
            }),
        ),
    ];
    if !classic {
        checks.drain(..3);
    }
    checks
}
