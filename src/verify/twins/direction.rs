//! Judges `direction.glsl`.

use super::super::domain::Domain;
use super::super::twin::{Rule, Twin};
use crate::material::reference::direction;

pub(super) const TWINS: &[Twin] = &[
    Twin::new(
        "direction_or",
        &[Domain::Log(1e-14, 1e15, &[0.0, -0.0, 1e-40, -1e-20, 1e-12, -1.0, 1e18, -1e30, f32::MAX]), Domain::Direction],
        |given| direction::or(given.vec3(), given.vec3()).to_array().to_vec(),
    ),
    Twin::new("direction_frame", &[Domain::Direction], |given| {
        let normal = given.vec3();
        let [tangent, bitangent] = direction::frame(normal);
        [tangent, bitangent, normal].map(|column| column.to_array()).concat()
    }),
    // A tangent along the normal leaves little that is across.
    Twin::new("direction_frame_along", &[Domain::Direction, Domain::DirectionOrZero, Domain::Sign], |given| {
        let (normal, tangent, side) = (given.vec3(), given.vec3(), given.number());
        let [tangent, bitangent] = direction::frame_along(normal, tangent, side);
        [tangent, bitangent, normal].map(|column| column.to_array()).concat()
    })
    .rule(Rule::Conditioned(2)),
];
