//! Unit vectors as points of a square: the octahedron, unfolded.
//!
//! Meyer et al. 2010, "On Floating-Point Normal Vectors".

use glam::{DVec2, DVec3};

/// The unit vector that a point of the square [-1, 1] stands for; decodes what `octahedral.glsl` codes.
pub fn direction_from_octahedral(coded: DVec2) -> DVec3 {
    let z = 1.0 - coded.x.abs() - coded.y.abs();
    if z >= 0.0 {
        return coded.extend(z).normalize();
    }
    // The lower half lies in the corners, each mirrored at its side of the inner diamond.
    let sign = |number: f64| if number >= 0.0 { 1.0 } else { -1.0 };
    DVec3::new(sign(coded.x) * (1.0 - coded.y.abs()), sign(coded.y) * (1.0 - coded.x.abs()), z).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_and_corners() {
        let decoded = |x, y| direction_from_octahedral(DVec2::new(x, y));
        assert_eq!(decoded(0.0, 0.0), DVec3::Z);
        assert_eq!(decoded(1.0, 0.0), DVec3::X);
        assert_eq!(decoded(0.0, -1.0), DVec3::NEG_Y);
        assert_eq!(decoded(-1.0, 1.0), DVec3::NEG_Z);
        assert!((decoded(-0.75, 0.5) - DVec3::new(-0.5, 0.25, -0.25).normalize()).length() < 1e-15);
    }
}
