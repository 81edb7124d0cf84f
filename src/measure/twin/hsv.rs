//! Twin of `hsv.glsl`: hue, saturation and value.
//!
//! Smith 1978, "Color Gamut Transform Pairs" (the hexcone).

use super::domain::{Domain, UNIT};
use super::{Rule, Twin};
use glam::DVec3;

/// Chroma below which a colour counts as grey.
pub const SMALLEST_CHROMA: f64 = 1e-30;

/// Linear RGB of a hue in turns, a saturation and a value in [0, 1]: along the six edges of the hexagon.
pub fn rgb_from_hsv(hsv: DVec3) -> DVec3 {
    let sixths = hsv.x.rem_euclid(1.0) * 6.0;
    let (sector, along) = (sixths.floor(), sixths.fract());
    let low = hsv.z * (1.0 - hsv.y);
    let falling = hsv.z * (1.0 - hsv.y * along);
    let rising = hsv.z * (1.0 - hsv.y * (1.0 - along));
    match sector as i32 {
        0 => DVec3::new(hsv.z, rising, low),
        1 => DVec3::new(falling, hsv.z, low),
        2 => DVec3::new(low, hsv.z, rising),
        3 => DVec3::new(low, falling, hsv.z),
        4 => DVec3::new(rising, low, hsv.z),
        _ => DVec3::new(hsv.z, low, falling),
    }
}

/// Hue in [0, 1), 0 for greys, saturation and value of a linear colour in [0, 1].
pub fn hsv_from_rgb(rgb: DVec3) -> DVec3 {
    let (value, least) = (rgb.max_element(), rgb.min_element());
    let chroma = value - least;
    if chroma < SMALLEST_CHROMA {
        return DVec3::new(0.0, 0.0, value);
    }
    // The largest channel's own hue, and how the other two pull from it.
    let largest = rgb.to_array().iter().position(|&channel| channel == value).unwrap_or(0);
    let (next, last) = (rgb[(largest + 1) % 3], rgb[(largest + 2) % 3]);
    let turns = largest as f64 / 3.0 + (next - last) / chroma / 6.0;
    DVec3::new(turns.rem_euclid(1.0), chroma / value, value)
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("rgb_from_hsv", &[Domain::Uniform(-1.0, 7.0, &[-1.0, 0.0, 1e-40, 0.5, 1.0, 7.0])], |inputs| {
        // The components share one domain; saturation and value are meant in [0, 1] and nothing here needs it.
        rgb_from_hsv(inputs.vec3()).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
    // Which channel is largest, and on which side of red a hue falls, is a matter of rounding.
    Twin::new("hsv_from_rgb", &[UNIT], |inputs| hsv_from_rgb(inputs.vec3()).to_array().to_vec()).rule(Rule::Stepped(2)),
];
