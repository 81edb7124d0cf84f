//! Twin of `uv.glsl`: texture coordinates.

use glam::{DVec2, DVec3};

/// KHR_texture_transform: translation * rotation * scale, angle in radians.
pub fn transformed(uv: DVec2, offset: DVec2, rotation: f64, scale: DVec2) -> DVec2 {
    let (sine, cosine) = rotation.sin_cos();
    let scaled = uv * scale;
    offset + DVec2::new(cosine * scaled.x + sine * scaled.y, cosine * scaled.y - sine * scaled.x)
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
