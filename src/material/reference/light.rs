//! Twin of `light.glsl`: punctual lights (KHR_lights_punctual).

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
