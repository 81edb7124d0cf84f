//! The lattice that flakes stand on, the square that their normals fill, and how each finds its number.

use super::inputs::{CHART, FINENESS, VECTOR, words2};
use crate::measure::twin::domain::{ALMOST_ONE, ALPHA, Domain};
use crate::measure::twin::{Limit, Twin};
use glam::{DMat2, DVec2, DVec3, Vec2Swizzles};
use std::f64::consts::PI;

/// `1 - (1 - p)^n`, where neither p nor its complement may vanish in a sum.
pub fn chance(p: f64, n: f64) -> f64 {
    if n == 0.0 { 0.0 } else { -(n * (-p).ln_1p()).exp_m1() }
}

/// Where a normal lies in the square [-1, 1]^2 that the normals of GGX of that width fill evenly.
pub fn square(normal: DVec3, alpha: f64) -> DVec2 {
    let stretched = DVec3::new(normal.x / alpha, normal.y / alpha, normal.z);
    if stretched.x == 0.0 && stretched.y == 0.0 {
        return DVec2::ZERO;
    }
    let disc = (stretched / stretched.length()).truncate();
    // In the quarter around the x axis, x is the radius, and y the angle's share of that quarter.
    let quarter = |along: f64, aside: f64| {
        disc.length() * DVec2::new(1f64.copysign(along), (aside / along.abs()).atan() / (0.25 * PI))
    };
    if disc.x.abs() >= disc.y.abs() { quarter(disc.x, disc.y) } else { quarter(disc.y, disc.x).yx() }
}

/// The normal that lies there: the inverse of [`square`].
pub fn normal(square: DVec2, alpha: f64) -> DVec3 {
    let of_quarter = |along: f64, aside: f64| {
        let (sine, cosine) = if along == 0.0 { (0.0, 1.0) } else { (0.25 * PI * aside / along).sin_cos() };
        along * DVec2::new(cosine, sine)
    };
    let disc = if square.x.abs() >= square.y.abs() {
        of_quarter(square.x, square.y)
    } else {
        of_quarter(square.y, square.x).yx()
    };
    DVec3::new(alpha * disc.x, alpha * disc.y, (1.0f64 - disc.length_squared()).max(0.0).sqrt()).normalize()
}

/// A permutation of the numbers below 4^fineness for each key.
pub fn shuffle(number: u32, fineness: u32, key: u32) -> u32 {
    let mask = (1 << (2 * fineness)) - 1;
    let first = ((number ^ key) & mask).wrapping_mul(0x9e37_79b1).wrapping_add(key >> 8) & mask;
    let second = (first ^ first >> fineness).wrapping_mul(0x85eb_ca6b).wrapping_add(key >> 16) & mask;
    (second ^ second >> fineness).wrapping_mul(0xc2b2_ae35) & mask
}

/// Which number [`shuffle`] made this of.
pub fn unshuffle(shuffled: u32, fineness: u32, key: u32) -> u32 {
    let mask = (1 << (2 * fineness)) - 1;
    // Newton's iteration doubles the bits that are right, of which an odd number by itself has three.
    let inverse = |factor: u32| (0..4).fold(factor, |x, _| x.wrapping_mul(2u32.wrapping_sub(factor.wrapping_mul(x))));
    let third = shuffled.wrapping_mul(inverse(0xc2b2_ae35)) & mask;
    let second = (third ^ third >> fineness).wrapping_sub(key >> 16).wrapping_mul(inverse(0x85eb_ca6b)) & mask;
    let first = (second ^ second >> fineness).wrapping_sub(key >> 8).wrapping_mul(inverse(0x9e37_79b1)) & mask;
    (first ^ key) & mask
}

/// Axes of the plane that the lattice lies in, by the surface's normal in the rest pose.
pub fn chart(normal: DVec3) -> u32 {
    let size = normal.abs();
    if size.x > size.y.max(size.z) {
        0
    } else if size.y > size.z {
        1
    } else {
        2
    }
}

/// A vector in that plane.
pub fn in_chart(vector: DVec3, chart: u32) -> DVec2 {
    let following = [DVec3::Y, DVec3::Z, DVec3::X];
    let after = [DVec3::Z, DVec3::X, DVec3::Y];
    DVec2::new(vector.dot(following[chart as usize]), vector.dot(after[chart as usize]))
}

/// The edges of a rhombus, in a plane.
pub fn edges() -> DMat2 {
    DMat2::from_cols(DVec2::X, DVec2::new(0.5, 0.75f64.sqrt()))
}

/// What the shader's functions are held to.
pub(in crate::measure::twin) const TWINS: &[Twin] = &[
    // Small chances keep every digit; what a naive formula loses is all of them.
    Twin::new(
        "glint_chance",
        &[
            Domain::Log(1e-12, 1.0, &[0.0, 1e-30, 1e-8, 0.499_999_97, 0.5, ALMOST_ONE, 1.0]),
            Domain::Log(1.0, 1e7, &[0.0, 0.5, 1.0, 1e3, 1e7]),
        ],
        |inputs| {
            let (p, n) = (inputs.number(), inputs.number());
            vec![chance(p, n)]
        },
    )
    .limit(1e-5, 0.0),
    Twin::new("glint_square", &[Domain::Hemisphere, ALPHA], |inputs| {
        let (normal, alpha) = (inputs.vec3(), inputs.number());
        words2(square(normal, alpha))
    }),
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("glint_shuffle", &[Domain::Bits, FINENESS, Domain::Bits], |inputs| {
            vec![f64::from(shuffle(inputs.uint(), inputs.uint(), inputs.uint()))]
        })
    },
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("glint_unshuffle", &[Domain::Bits, FINENESS, Domain::Bits], |inputs| {
            vec![f64::from(unshuffle(inputs.uint(), inputs.uint(), inputs.uint()))]
        })
    },
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("glint_chart", &[Domain::Direction], |inputs| vec![f64::from(chart(inputs.vec3()))])
    },
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("glint_in_chart", &[VECTOR, CHART], |inputs| {
            let (vector, chart) = (inputs.vec3(), inputs.uint());
            words2(in_chart(vector, chart))
        })
    },
    Twin::new("glint_length_squared", &[VECTOR], |inputs| vec![(edges() * inputs.vec2()).length_squared()]),
    Twin::new("glint_cross", &[VECTOR, VECTOR], |inputs| vec![inputs.vec2().perp_dot(inputs.vec2())]),
];
