//! Classic laser cloth: a hue that follows the angle of view.

use glam::{DVec2, DVec3};

/// Range of the turns of hue from facing to grazing.
pub const HUE_SPAN: (f64, f64) = (0.2, 5.0);
/// Range of the hue at the facing end.
pub const HUE_OFFSET: (f64, f64) = (0.0, 1.0);

/// Hue in turns; `mu` = cosine of the view angle in [0, 1].
///
/// Defect: nothing knows how many turns fall in one pixel.
pub fn hue(mu: f64, span: f64, offset: f64) -> f64 {
    ((1.0 - mu) * span + offset).fract()
}

/// Turns of hue from a pixel to the next, on a ball of that radius in pixels, as many pixels inside its outline.
pub fn turns_a_pixel(span: f64, radius_px: f64, inside_px: f64) -> f64 {
    let across = 1.0 - inside_px / radius_px;
    span * across / (radius_px * (1.0 - across * across).sqrt())
}

/// The sine as older manuals print it.
///
/// Defect: it is 0 at both ends and nowhere above 0.385.
pub fn printed_sine(mu: f64) -> f64 {
    (1.0 - mu).sqrt() * mu
}

/// Cosine of the view angle in the plane of the normal and an axis: of the normal and the unit part of the view in that
/// plane.
///
/// Defect: 0 / 0 for a view across the plane.
pub fn cosine_along(eye: DVec3, axis: DVec2) -> f64 {
    let across = DVec3::new(-axis.y, axis.x, 0.0);
    let part = eye - eye.dot(across) * across;
    part.z / part.length()
}
