//! Twin of `uv.glsl`: texture coordinates.

use super::domain::Domain;
use super::{Rule, TestInputs, Twin};
use glam::{DMat2, DVec2, DVec3};

/// KHR_texture_transform: translation * rotation * scale, angle in radians.
pub fn transformed(uv: DVec2, offset: DVec2, rotation: f64, scale: DVec2) -> DVec2 {
    let (sine, cosine) = rotation.sin_cos();
    let scaled = uv * scale;
    offset + DVec2::new(cosine * scaled.x + sine * scaled.y, cosine * scaled.y - sine * scaled.x)
}

/// Change of the transformed coordinates for a change of those before it.
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

/// A texture coordinate or its change.
const COORDINATE: Domain = Domain::Uniform(-3.0, 3.0, &[0.0, 1e-40, 1.0, -1e30, 1e30]);
/// A row: two numbers of scale and rotation, and the offset.
const ROW: Domain = Domain::Uniform(-4.0, 4.0, &[0.0, 1.0, -1e4]);
const SET: Domain = Domain::Choice(&[0, 1]);

/// KHR_texture_transform as a matrix and an offset, and the UV set.
fn transform(inputs: &mut TestInputs<'_>) -> (DMat2, DVec2, u32) {
    let row_u = inputs.vec3();
    let set = inputs.uint();
    let row_v = inputs.vec3();
    let matrix = DMat2::from_cols(DVec2::new(row_u.x, row_v.x), DVec2::new(row_u.y, row_v.y));
    (matrix, DVec2::new(row_u.z, row_v.z), set)
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    // Terms that may cancel.
    Twin::new("uv_transformed", &[ROW, SET, ROW, COORDINATE, COORDINATE], |inputs| {
        let (matrix, offset, set) = transform(inputs);
        let sets = [inputs.vec2(), inputs.vec2()];
        (matrix * sets[set as usize] + offset).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("uv_gradient", &[ROW, SET, ROW, COORDINATE], |inputs| {
        let (matrix, _, set) = transform(inputs);
        let sets = [inputs.vec2(), inputs.vec2()];
        (matrix * sets[set as usize]).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("uv_projected", &[COORDINATE, Domain::DirectionOrZero], |inputs| {
        projected(inputs.vec3(), inputs.vec3()).to_array().to_vec()
    }),
];

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
