//! Judges `octahedral.glsl`.

use super::super::domain::Domain;
use super::super::twin::{Rule, Twin};
use crate::material::reference::octahedral;

/// On the square, with its corners, sides and diagonals.
const PLACE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, -0.5, 0.0, 0.25, 1.0]);

pub(super) const TWINS: &[Twin] = &[
    Twin::new("octahedral_folded", &[PLACE], |given| octahedral::folded(given.vec2()).to_array().to_vec()),
    // Where the lower half is folded out, its two rims lie apart: rounding decides between them.
    Twin::new("octahedral_from_direction", &[Domain::Direction], |given| {
        octahedral::from_direction(given.vec3()).to_array().to_vec()
    })
    .rule(Rule::Stepped(2)),
    Twin::new("octahedral_direction", &[PLACE], |given| octahedral::direction(given.vec2()).to_array().to_vec()),
];
