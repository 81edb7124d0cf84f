//! Twin of `horizon.glsl`: ambient occlusion from horizons.

use super::domain::Domain;
use super::{Rule, Twin};
use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_PI_2;

/// A plane through a point and the eye.
#[derive(Debug, Clone, Copy)]
pub struct Slice {
    /// Unit, in the tangent plane and in the slice.
    pub tangent: DVec3,
    /// Angle of the projected normal from the direction to the eye, radians.
    pub normal_angle: f64,
    /// Length of the normal's projection.
    pub weight: f64,
}

/// The slice through `along` and `to_eye`, which are perpendicular.
pub fn slice(along: DVec3, to_eye: DVec3, normal: DVec3) -> Slice {
    // A surface is seen from above.
    let projected = DVec2::new(normal.dot(along), normal.dot(to_eye).max(0.0));
    let normal_angle = projected.x.atan2(projected.y);
    let (sine, cosine) = normal_angle.sin_cos();
    Slice { tangent: along * cosine - to_eye * sine, normal_angle, weight: projected.length() }
}

/// Elevation of a sample over the tangent plane in the slice, in [0, `highest`] radians.
pub fn elevation(to_sample: DVec3, normal: DVec3, tangent: DVec3, weight: f64, highest: f64) -> f64 {
    let height = to_sample.dot(normal);
    if height <= 0.0 { 0.0 } else { height.atan2(weight * to_sample.dot(tangent)).clamp(0.0, highest) }
}

/// Cosine-weighted light of one side of a slice below an elevation: Jimenez et al. 2016, eq. 7, as the arc from the
/// tangent plane at `pi/2 + n` down to the horizon at `h = pi/2 + n - elevation`.
pub fn arc(elevation: f64, normal_angle: f64) -> f64 {
    let n = normal_angle;
    let inner = |h: f64| 0.25 * (n.cos() - (2.0 * h - n).cos() + 2.0 * h * n.sin());
    inner(FRAC_PI_2 + n) - inner(FRAC_PI_2 + n - elevation)
}

/// Share of light that what stands at a distance takes.
pub fn falloff(distance_squared: f64, radius: f64) -> f64 {
    (1.0 - distance_squared / (radius * radius)).clamp(0.0, 1.0)
}

/// Share of cosine-weighted light that arrives, from `slices` slices: `sides` gives, for a unit vector of the tangent
/// plane and the slice's projected unit normal, what stands on that side as (elevation, distance squared), nearest first.
pub fn visibility(
    normal: DVec3,
    to_eye: DVec3,
    slices: u32,
    radius: f64,
    side: impl Fn(DVec3, DVec3) -> Vec<(f64, f64)>,
) -> f64 {
    let (across, up) = to_eye.any_orthonormal_pair();
    let (mut lost, mut whole) = (0.0, 0.0);
    for index in 0..slices {
        let (sine, cosine) = (std::f64::consts::PI * (f64::from(index) + 0.5) / f64::from(slices)).sin_cos();
        let slice = slice(across * cosine + up * sine, to_eye, normal);
        let upright = (normal - normal.project_onto(slice.tangent.cross(to_eye))).normalize();
        for sign in [1.0, -1.0] {
            let angle = sign * slice.normal_angle;
            let mut horizon = 0.0;
            for (elevation, distance_squared) in side(sign * slice.tangent, upright) {
                if elevation > horizon {
                    let rise = arc(elevation, angle) - arc(horizon, angle);
                    lost += slice.weight * falloff(distance_squared, radius) * rise;
                    horizon = elevation;
                }
            }
            whole += slice.weight * arc(FRAC_PI_2 + angle, angle);
        }
    }
    1.0 - lost / whole
}

/// Radians.
const NORMAL_ANGLE: Domain = Domain::Uniform(
    -std::f32::consts::FRAC_PI_2,
    std::f32::consts::FRAC_PI_2,
    &[-std::f32::consts::FRAC_PI_2, -1e-4, 0.0, 1e-40, std::f32::consts::FRAC_PI_2],
);
const ELEVATION: Domain =
    Domain::Uniform(0.0, std::f32::consts::PI, &[0.0, 1e-40, 1e-4, std::f32::consts::FRAC_PI_2, std::f32::consts::PI]);
/// A coordinate, in any unit.
const PLACE: Domain = Domain::Uniform(-10.0, 10.0, &[-10.0, -1e-7, 0.0, 1.0, 1e15]);
/// Of a slice that is not seen edge on.
const WEIGHT: Domain = Domain::Log(1e-6, 1.0, &[1e-6, 1.0]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    // Vulkan 1.3, "Precision of core SPIR-V Instructions", leaves
    // atan 4096 units in the last place; the angle feeds sines that are as smooth as it.
    Twin::new("horizon_slice", &[Domain::Direction, Domain::Direction, Domain::Direction], |inputs| {
        let slice = slice(inputs.vec3(), inputs.vec3(), inputs.vec3());
        [&slice.tangent.to_array()[..], &[slice.normal_angle, slice.weight]].concat()
    })
    .limit(1e-5, 1e-5)
    .rule(Rule::Conditioned(4)),
    // What lies beyond the eye's direction steps from all to nothing where it crosses the tangent plane.
    Twin::new("horizon_elevation", &[PLACE, Domain::Direction, Domain::Direction, WEIGHT, ELEVATION], |inputs| {
        let (to_sample, normal, tangent) = (inputs.vec3(), inputs.vec3(), inputs.vec3());
        vec![elevation(to_sample, normal, tangent, inputs.number(), inputs.number())]
    })
    .limit(1e-5, 1e-5)
    .rule(Rule::Stepped(4)),
    Twin::new("horizon_arc", &[ELEVATION, NORMAL_ANGLE], |inputs| vec![arc(inputs.number(), inputs.number())]),
    Twin::new(
        "horizon_falloff",
        &[Domain::Log(1e-9, 1e9, &[0.0, 1e-30, 1.0, 1e30]), Domain::Log(1e-3, 1e3, &[1e-3, 1.0, 1e3])],
        |inputs| vec![falloff(inputs.number(), inputs.number())],
    ),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// A box that begins at x = `FROM` on a floor that faces +Y, and goes on for ever.
    const FROM: f64 = 0.7;
    const STEPS: u32 = 400;

    /// Where a ray from the origin meets a wall of a height, distance squared.
    fn wall(direction: DVec3, height: f64) -> Option<f64> {
        let distance = FROM / direction.x;
        (direction.x > 0.0 && direction.y * distance < height).then_some(distance * distance)
    }

    fn found(to_eye: DVec3, height: f64, radius: f64, slices: u32) -> f64 {
        visibility(DVec3::Y, to_eye.normalize(), slices, radius, |tangent, upright| {
            let at = |step: u32| {
                let elevation = std::f64::consts::PI * f64::from(step) / f64::from(STEPS);
                let (sine, cosine) = elevation.sin_cos();
                wall(tangent * cosine + upright * sine, height).map(|distance| (elevation, distance))
            };
            (1..STEPS).map_while(at).collect()
        })
    }

    /// Seeded: the share of cosine-weighted rays that go free, each blocked one by its falloff.
    fn monte_carlo(height: f64, radius: f64) -> f64 {
        let count = 400_000;
        let lost: f64 = (0..count)
            .map(|index| {
                let [u, v, _] = super::super::hash::pcg3d([index, 17, 4]).map(|bits| f64::from(bits) / 2f64.powi(32));
                let (sine, cosine) = (std::f64::consts::TAU * v).sin_cos();
                let direction = DVec3::new(u.sqrt() * cosine, (1.0 - u).sqrt(), u.sqrt() * sine);
                wall(direction, height).map_or(0.0, |distance| falloff(distance, radius))
            })
            .sum();
        1.0 - lost / f64::from(count)
    }

    const EYES: [DVec3; 4] =
        [DVec3::Y, DVec3::new(-0.4, 1.0, 0.3), DVec3::new(-1.0, 0.3, 0.9), DVec3::new(-0.2, 1.0, -0.8)];

    #[test]
    fn an_arc_is_the_integral_of_its_cosine() {
        for normal_angle in [-1.5f64, -0.6, 0.0, 0.3, 1.2] {
            for share in [0.1, 0.5, 1.0] {
                let elevation = share * (FRAC_PI_2 + normal_angle);
                let step = elevation / 4000.0;
                // The cosine to the normal is the elevation's sine; a slice widens with the angle from the eye.
                let sum: f64 = (0..4000)
                    .map(|index| (f64::from(index) + 0.5) * step)
                    .map(|u| u.sin() * (FRAC_PI_2 + normal_angle - u).sin() * step)
                    .sum();
                assert!((arc(elevation, normal_angle) - sum).abs() < 1e-6, "{elevation} at {normal_angle}");
            }
            let whole = arc(FRAC_PI_2 + normal_angle, normal_angle) + arc(FRAC_PI_2 - normal_angle, -normal_angle);
            assert!((whole - normal_angle.cos() - normal_angle * normal_angle.sin()).abs() < 1e-12);
        }
    }

    #[test]
    fn a_wall_hides_from_a_floor_what_its_form_factor_says() {
        // Half the difference of the sines of the angles from the floor's normal to the wall's top and foot.
        for height in [0.1f64, 0.7, 5.0] {
            let expected = 0.5 * (1.0 + FROM / FROM.hypot(height));
            for to_eye in EYES {
                let share = found(to_eye, height, 1e9, 1024);
                assert!((share - expected).abs() < 4e-3, "{share} of {expected}, height {height} from {to_eye}");
            }
        }
    }

    #[test]
    fn falloff_is_that_of_rays() {
        for (height, radius) in [(0.7, 1.0), (5.0, 2.0), (0.2, 1.5)] {
            let expected = monte_carlo(height, radius);
            for to_eye in EYES {
                let share = found(to_eye, height, radius, 1024);
                assert!((share - expected).abs() < 4e-3, "{share} of {expected}, height {height} from {to_eye}");
            }
        }
    }

    #[test]
    fn what_lies_in_or_below_the_tangent_plane_hides_nothing() {
        let normal = DVec3::new(0.3, 0.5, 0.8).normalize();
        let slice = slice(DVec3::X, DVec3::Z, normal);
        let beside = slice.tangent + 0.2 * slice.tangent.cross(normal);
        assert!(elevation(beside, normal, slice.tangent, slice.weight, 2.0) < 1e-12);
        assert_eq!(elevation(beside - 0.1 * normal, normal, slice.tangent, slice.weight, 2.0), 0.0);
        assert_eq!(elevation(DVec3::ZERO, normal, slice.tangent, slice.weight, 2.0), 0.0);
    }
}
