//! Twin of `direction.glsl`: unit vectors from vectors that may be nothing.

use glam::DVec3;

/// `vector` at unit length, or `fallback` where it is shorter than 1e-15.
pub fn or(vector: DVec3, fallback: DVec3) -> DVec3 {
    if vector.length_squared() > 1e-30 { vector.normalize() } else { fallback }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_points_where_it_is_told() {
        assert_eq!(or(DVec3::ZERO, DVec3::Y), DVec3::Y);
        assert_eq!(or(DVec3::splat(1e-300), DVec3::Y), DVec3::Y);
        assert!((or(DVec3::splat(1e-10), DVec3::Y).length() - 1.0).abs() < 1e-12);
        assert!((or(DVec3::splat(1e30), DVec3::Y).length() - 1.0).abs() < 1e-12);
    }
}
