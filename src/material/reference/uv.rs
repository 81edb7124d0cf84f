//! Twin of `uv.glsl`: texture coordinates.

use glam::{DVec2, DVec3};

/// KHR_texture_transform: translation * rotation * scale, angle in radians.
pub fn transformed(uv: DVec2, offset: DVec2, rotation: f64, scale: DVec2) -> DVec2 {
    let (sine, cosine) = rotation.sin_cos();
    let scaled = uv * scale;
    offset + DVec2::new(cosine * scaled.x + sine * scaled.y, cosine * scaled.y - sine * scaled.x)
}

/// Change of the transformed coordinates for a change of the given ones.
pub fn gradient(change: DVec2, rotation: f64, scale: DVec2) -> DVec2 {
    transformed(change, DVec2::ZERO, rotation, scale)
}

/// Box projection across the normal's largest axis.
pub fn projected(position: DVec3, normal: DVec3) -> DVec2 {
    let size = normal.abs();
    if size.x >= size.y && size.x >= size.z {
        DVec2::new(position.z, position.y)
    } else if size.y >= size.z {
        DVec2::new(position.x, position.z)
    } else {
        DVec2::new(position.x, position.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn a_quarter_turn_scales_first_and_moves_last() {
        let (offset, scale) = (DVec2::new(0.5, 0.25), DVec2::new(2.0, 3.0));
        // The extension's matrices: rotation takes u to -v.
        let found = transformed(DVec2::new(1.0, 0.0), offset, FRAC_PI_2, scale);
        assert!((found - DVec2::new(0.5, -1.75)).length() < 1e-12);
        let step = DVec2::new(1e-3, -2e-3);
        let uv = DVec2::new(0.3, 0.4);
        let moved = transformed(uv + step, offset, 1.1, scale) - transformed(uv, offset, 1.1, scale);
        assert!((moved - gradient(step, 1.1, scale)).length() < 1e-12);
    }

    #[test]
    fn projection_looks_along_the_largest_axis() {
        let place = DVec3::new(1.0, 2.0, 3.0);
        assert_eq!(projected(place, DVec3::X), DVec2::new(3.0, 2.0));
        assert_eq!(projected(place, -DVec3::Y), DVec2::new(1.0, 3.0));
        assert_eq!(projected(place, DVec3::new(0.1, 0.2, -0.9)), DVec2::new(1.0, 2.0));
    }
}
