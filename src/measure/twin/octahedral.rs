//! Twin of `octahedral.glsl`: unit vectors as two numbers.

use super::domain::Domain;
use super::{Rule, Twin};
use glam::{DVec2, DVec3};

/// Mirrors a point of the square's corners at its side of the inner diamond.
pub fn folded(p: DVec2) -> DVec2 {
    let sign = |number: f64| if number >= 0.0 { 1.0 } else { -1.0 };
    DVec2::new(sign(p.x) * (1.0 - p.y.abs()), sign(p.y) * (1.0 - p.x.abs()))
}

/// The point of the square [-1, 1] that stands for a unit vector.
pub fn from_direction(direction: DVec3) -> DVec2 {
    let p = direction.truncate() / direction.abs().element_sum();
    if direction.z < 0.0 { folded(p) } else { p }
}

/// The unit vector that a point of the square stands for.
pub fn direction(p: DVec2) -> DVec3 {
    let z = 1.0 - p.x.abs() - p.y.abs();
    (if z < 0.0 { folded(p) } else { p }).extend(z).normalize()
}

/// On the square, with its corners, sides and diagonals.
const PLACE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, -0.5, 0.0, 0.25, 1.0]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("octahedral_folded", &[PLACE], |inputs| folded(inputs.vec2()).to_array().to_vec()),
    // Where the lower half is folded out, its two rims lie apart: rounding decides between them.
    Twin::new("octahedral_from_direction", &[Domain::Direction], |inputs| {
        from_direction(inputs.vec3()).to_array().to_vec()
    })
    .rule(Rule::Stepped(2)),
    Twin::new("octahedral_direction", &[PLACE], |inputs| direction(inputs.vec2()).to_array().to_vec()),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back_is_the_same_direction() {
        for index in 0..1000 {
            let random = super::super::hash::pcg3d([index, 1, 2]).map(|bits| f64::from(bits) / 2f64.powi(31) - 1.0);
            let expected = DVec3::from_array(random).normalize();
            let p = from_direction(expected);
            assert!(p.abs().max_element() <= 1.0);
            assert!((direction(p) - expected).length() < 1e-14, "{expected}");
        }
    }
}
