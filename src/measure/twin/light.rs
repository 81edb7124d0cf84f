//! Twin of `light.glsl`: punctual lights (KHR_lights_punctual).

use super::domain::Domain;
use super::{Rule, Twin, direction};
use glam::DVec3;

/// Irradiance is limited to this, linear: times the peak of the sharpest lobe (about 1e8) it is still a finite number.
pub const LARGEST_IRRADIANCE: f64 = 1e30;

/// Share of the light left at a distance within a range.
pub fn range_window(distance_squared: f64, range_m: f64) -> f64 {
    (1.0 - (distance_squared / range_m.powi(2)).powi(2)).clamp(0.0, 1.0)
}

/// Share of a spot's light at an angle from its axis; angles in radians.
pub fn cone(angle: f64, inner: f64, outer: f64) -> f64 {
    let scale = 1.0 / (inner.cos() - outer.cos()).max(1e-3);
    ((angle.cos() - outer.cos()) * scale).clamp(0.0, 1.0).powi(2)
}

/// Metres, a coordinate.
const PLACE: Domain = Domain::Uniform(-10.0, 10.0, &[0.0, 1e-40, 1e-7, 2.0, -1e4, 1e30]);
/// Metres.
const RANGE: Domain = Domain::Log(1e-2, 1e3, &[1e-30, 1.0, 1e30]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("light_range_window", &[Domain::Log(1e-12, 1e9, &[1e-12, 1.0, 1e30]), RANGE], |inputs| {
        vec![range_window(inputs.number(), inputs.number())]
    }),
    // A spot's cosine is stretched by up to a thousand.
    Twin::new(
        "light_sample",
        &[
            PLACE,
            Domain::Log(1e-2, 1e3, &[0.0, 1e-30, 1.0, 1e30]),
            Domain::Direction,
            Domain::Choice(&[0, 1, 2]),
            Domain::Log(1e-3, 1e6, &[0.0, 1e-38, 1.0, 1e30]),
            Domain::Log(1.0, 1e3, &[1.0, 1e3]),
            Domain::Uniform(-1e3, 1.0, &[-1e3, -0.5, 0.0, 1.0]),
            // Its shadow maps, which are read elsewhere.
            Domain::Choice(&[0]),
            Domain::Choice(&[0]),
            PLACE,
        ],
        |inputs| {
            let (position, range_m, axis, kind) = (inputs.vec3(), inputs.number(), inputs.vec3(), inputs.uint());
            let (intensity, scale, offset) = (inputs.vec3(), inputs.number(), inputs.number());
            let _shadows = (inputs.uint(), inputs.uint());
            let place = inputs.vec3();
            let limited = |irradiance: DVec3| irradiance.min(DVec3::splat(LARGEST_IRRADIANCE));
            if kind == 0 {
                return [axis, limited(intensity)].map(|vector| vector.to_array()).concat();
            }
            let to_light = position - place;
            let to_light_unit = direction::or(to_light, DVec3::ZERO);
            let distance_squared = to_light.length_squared().max(1e-12);
            let window = if range_m > 0.0 { range_window(distance_squared, range_m) } else { 1.0 };
            let cone = if kind == 2 { (axis.dot(to_light_unit) * scale + offset).clamp(0.0, 1.0).powi(2) } else { 1.0 };
            let irradiance = limited(intensity * (window * cone / distance_squared));
            [to_light_unit, irradiance].map(|vector| vector.to_array()).concat()
        },
    )
    .rule(Rule::Conditioned(4)),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_end_where_they_say() {
        assert_eq!(range_window(0.0, 2.0), 1.0);
        assert_eq!(range_window(4.0, 2.0), 0.0);
        assert_eq!(range_window(400.0, 2.0), 0.0);
        assert!((range_window(1.0, 2.0) - 15.0 / 16.0).abs() < 1e-12);
        assert_eq!(cone(0.0, 0.2, 0.5), 1.0);
        assert_eq!(cone(0.6, 0.2, 0.5), 0.0);
        assert!(cone(0.3, 0.3, 0.3).is_finite());
    }
}
