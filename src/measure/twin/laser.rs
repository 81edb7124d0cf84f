//! Twin of `laser.glsl`: a painted film whose hue follows the angle of view.

use super::domain::{Domain, UNIT};
use super::hsv::{hsv_from_rgb, rgb_from_hsv};
use super::{Rule, Twin};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Cosine and sine of the part of the view angle that lies in the plane of the normal and of a unit axis in the tangent
/// plane: of the view's projection into that plane, which is kept from vanishing.
pub fn angle_along(eye: DVec3, axis: DVec2) -> DVec2 {
    let projected = DVec2::new(eye.z, eye.truncate().dot(axis).abs());
    projected / (projected.length_squared() + 1e-8).sqrt()
}

/// What drives the hue, of the cosine and sine of the view angle: 1 - cosine or the sine.
pub fn curve(angle: DVec2, is_sine: bool) -> f64 {
    if is_sine { angle.y } else { 1.0 - angle.x }
}

/// Mean over all hues of the wheel: each channel is full for a third of the turn, gone for a third, and on its way.
pub fn mean_of_wheel(saturation: f64, brightness: f64) -> f64 {
    brightness * (1.0 - 0.5 * saturation)
}

/// Share of the wheel's first harmonic that a Gaussian pixel keeps, `change` turns wide as a box of the same variance.
pub fn kept_of_wheel(change: f64) -> f64 {
    let variance = change * change / 12.0;
    (-0.5 * (2.0 * PI).powi(2) * variance).exp()
}

/// Colour at a phase in turns that changes by `change` turns from one pixel to the next.
pub fn wheel(phase: f64, change: f64, saturation: f64, brightness: f64) -> DVec3 {
    let mean = DVec3::splat(mean_of_wheel(saturation, brightness));
    mean.lerp(rgb_from_hsv(DVec3::new(phase, saturation, brightness)), kept_of_wheel(change.min(1e3)))
}

/// A painted colour with its hue turned and its saturation and value scaled.
pub fn ramp(painted: DVec3, offset: f64, saturation: f64, brightness: f64) -> DVec3 {
    let hsv = hsv_from_rgb(painted);
    rgb_from_hsv(DVec3::new(hsv.x + offset, hsv.y * saturation, hsv.z * brightness))
}

/// Turns.
const PHASE: Domain = Domain::Uniform(0.0, 7.0, &[0.0, 1e-40, 1.0, 7.0]);
/// Turns from one pixel to the next.
const CHANGE: Domain = Domain::Log(1e-4, 10.0, &[0.0, 1e-40, 0.5, 1e30]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("laser_angle_along", &[Domain::Above, Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1.0])], |inputs| {
        angle_along(inputs.vec3(), inputs.vec2()).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("laser_curve", &[UNIT, Domain::Choice(&[0, 1])], |inputs| vec![curve(inputs.vec2(), inputs.uint() != 0)]),
    Twin::new("laser_wheel", &[PHASE, CHANGE, UNIT, UNIT], |inputs| {
        wheel(inputs.number(), inputs.number(), inputs.number(), inputs.number()).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("laser_ramp", &[UNIT, Domain::Uniform(0.0, 2.0, &[0.0, 1.0, 2.0]), UNIT, UNIT], |inputs| {
        ramp(inputs.vec3(), inputs.number(), inputs.number(), inputs.number()).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
];
