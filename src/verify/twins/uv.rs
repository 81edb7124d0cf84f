//! Judges `uv.glsl`.

use super::super::domain::Domain;
use super::super::twin::{Given, Rule, Twin};
use crate::material::reference::uv;
use glam::{DMat2, DVec2};

/// A texture coordinate or its change.
const COORDINATE: Domain = Domain::Uniform(-3.0, 3.0, &[0.0, 1e-40, 1.0, -1e30, 1e30]);
/// A row: two numbers of scale and rotation, and the offset.
const ROW: Domain = Domain::Uniform(-4.0, 4.0, &[0.0, 1.0, -1e4]);
const SET: Domain = Domain::Choice(&[0, 1]);

/// KHR_texture_transform as a matrix and an offset, and the UV set.
fn transform(given: &mut Given<'_>) -> (DMat2, DVec2, u32) {
    let row_u = given.vec3();
    let set = given.uint();
    let row_v = given.vec3();
    let matrix = DMat2::from_cols(DVec2::new(row_u.x, row_v.x), DVec2::new(row_u.y, row_v.y));
    (matrix, DVec2::new(row_u.z, row_v.z), set)
}

pub(super) const TWINS: &[Twin] = &[
    // Terms that may cancel.
    Twin::new("uv_transformed", &[ROW, SET, ROW, COORDINATE, COORDINATE], |given| {
        let (matrix, offset, set) = transform(given);
        let sets = [given.vec2(), given.vec2()];
        (matrix * sets[set as usize] + offset).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("uv_gradient", &[ROW, SET, ROW, COORDINATE], |given| {
        let (matrix, _, set) = transform(given);
        let sets = [given.vec2(), given.vec2()];
        (matrix * sets[set as usize]).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("uv_projected", &[COORDINATE, Domain::DirectionOrZero], |given| {
        uv::projected(given.vec3(), given.vec3()).to_array().to_vec()
    }),
];
