//! Twin of `direction.glsl`: unit vectors from vectors that may be nothing.

use super::domain::Domain;
use super::{Rule, Twin};
use glam::DVec3;

/// `vector` at unit length, or `fallback` where it is shorter than 1e-15.
pub fn or(vector: DVec3, fallback: DVec3) -> DVec3 {
    if vector.length_squared() > 1e-30 { vector.normalize() } else { fallback }
}

/// Tangent and bitangent of the frame around a unit normal (Duff et al. 2017).
pub fn frame(normal: DVec3) -> [DVec3; 2] {
    // The rotation that takes +-z to the normal along the shortest way, applied to x and y, which are across that pole.
    let pole = if normal.z >= 0.0 { DVec3::Z } else { DVec3::NEG_Z };
    let turned = |axis: DVec3| axis - (pole + normal) * (normal.dot(axis) / (1.0 + pole.dot(normal)));
    [turned(DVec3::X), turned(DVec3::Y * pole.z)]
}

/// Tangent and bitangent of the frame around a unit normal whose tangent is `tangent` without its part along the normal;
/// those of [`frame`] where less than 1e-4 of it is left. A negative `side` mirrors the bitangent.
pub fn frame_along(normal: DVec3, tangent: DVec3, side: f64) -> [DVec3; 2] {
    let across = tangent - normal * normal.dot(tangent);
    let along = if across.length() > 1e-4 { across.normalize() } else { frame(normal)[0] };
    [along, normal.cross(along) * if side < 0.0 { -1.0 } else { 1.0 }]
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new(
        "direction_or",
        &[Domain::Log(1e-14, 1e15, &[0.0, -0.0, 1e-40, -1e-20, 1e-12, -1.0, 1e18, -1e30, f32::MAX]), Domain::Direction],
        |inputs| or(inputs.vec3(), inputs.vec3()).to_array().to_vec(),
    ),
    Twin::new("direction_frame", &[Domain::Direction], |inputs| {
        let normal = inputs.vec3();
        let [tangent, bitangent] = frame(normal);
        [tangent, bitangent, normal].map(|column| column.to_array()).concat()
    }),
    // A tangent along the normal leaves little that is across.
    Twin::new("direction_frame_along", &[Domain::Direction, Domain::DirectionOrZero, Domain::Sign], |inputs| {
        let (normal, tangent, side) = (inputs.vec3(), inputs.vec3(), inputs.number());
        let [tangent, bitangent] = frame_along(normal, tangent, side);
        [tangent, bitangent, normal].map(|column| column.to_array()).concat()
    })
    .rule(Rule::Conditioned(2)),
];

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

    #[test]
    fn frames_are_orthonormal_and_those_of_the_closed_form() {
        for [x, y, z] in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.6, -0.48, 0.64], [0.8, 0.0, -0.6], [1.0, 0.0, 0.0]] {
            let normal = DVec3::new(x, y, z);
            let [tangent, bitangent] = frame(normal);
            assert!((tangent.cross(bitangent) - normal).length() < 1e-12);
            let side = if z >= 0.0 { 1.0 } else { -1.0 };
            let a = -1.0 / (side + z);
            let closed = DVec3::new(1.0 + side * x * x * a, side * x * y * a, -side * x);
            assert!((tangent - closed).length() < 1e-12, "{normal}");
        }
    }
}
