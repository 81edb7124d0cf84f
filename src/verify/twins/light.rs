//! Judges `light.glsl`.

use super::super::domain::Domain;
use super::super::twin::{Rule, Twin};
use crate::material::reference::{direction, light};
use glam::DVec3;

/// Metres, a coordinate.
const PLACE: Domain = Domain::Uniform(-10.0, 10.0, &[0.0, 1e-40, 1e-7, 2.0, -1e4, 1e30]);
/// Metres.
const RANGE: Domain = Domain::Log(1e-2, 1e3, &[1e-30, 1.0, 1e30]);

pub(super) const TWINS: &[Twin] = &[
    Twin::new("light_range_window", &[Domain::Log(1e-12, 1e9, &[1e-12, 1.0, 1e30]), RANGE], |given| {
        vec![light::range_window(given.number(), given.number())]
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
        |given| {
            let (position, range_m, axis, kind) = (given.vec3(), given.number(), given.vec3(), given.uint());
            let (intensity, scale, offset) = (given.vec3(), given.number(), given.number());
            let _shadows = (given.uint(), given.uint());
            let place = given.vec3();
            let limited = |irradiance: DVec3| irradiance.min(DVec3::splat(light::LARGEST_IRRADIANCE));
            if kind == 0 {
                return [axis, limited(intensity)].map(|vector| vector.to_array()).concat();
            }
            let to_light = position - place;
            let to_light_unit = direction::or(to_light, DVec3::ZERO);
            let distance_squared = to_light.length_squared().max(1e-12);
            let window = if range_m > 0.0 { light::range_window(distance_squared, range_m) } else { 1.0 };
            let cone = if kind == 2 { (axis.dot(to_light_unit) * scale + offset).clamp(0.0, 1.0).powi(2) } else { 1.0 };
            let irradiance = limited(intensity * (window * cone / distance_squared));
            [to_light_unit, irradiance].map(|vector| vector.to_array()).concat()
        },
    )
    .rule(Rule::Conditioned(4)),
];
