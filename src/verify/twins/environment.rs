//! Judges `environment.glsl`.

use super::super::domain::{ALPHA, COSINE, Domain, ROUGHNESS};
use super::super::twin::{Rule, Twin};
use super::ULP;
use crate::material::reference::environment;
use glam::{DVec2, DVec3};

/// Of a face.
const PLACE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-7, 1.0]);
const FACE: Domain = Domain::Choice(&[0, 1, 2, 3, 4, 5]);
/// The points that Hammersley gives keep away from the edges of the square.
const INSIDE: Domain = Domain::Uniform(1e-3, 0.999, &[1e-3, 0.5, 0.999]);
/// Last level of a cube: faces of 4 to 1024 texels.
const LAST: Domain = Domain::Uniform(0.0, 8.0, &[0.0, 4.0, 6.0, 8.0]);
const LAST_ABOVE_0: Domain = Domain::Uniform(1.0, 8.0, &[1.0, 6.0, 8.0]);
/// Of the harmonics.
const INDICES: [u32; 25] = {
    let mut indices = [0; 25];
    let mut index = 0;
    while index < 25 {
        indices[index] = index as u32;
        index += 1;
    }
    indices
};

pub(super) const TWINS: &[Twin] = &[
    // Cosine and sine of any length: the formula asks for none.
    Twin::new("environment_from_world", &[Domain::Direction, PLACE], |given| {
        let (direction, rotation) = (given.vec3(), given.vec2());
        let turned = environment::from_world(direction, rotation.to_angle()) * rotation.length();
        vec![turned.x, direction.y, turned.z]
    }),
    Twin::new("environment_uv", &[Domain::Direction], |given| environment::uv(given.vec3()).to_array().to_vec()),
    Twin::new("environment_face_direction", &[FACE, PLACE], |given| {
        let face = given.uint() as usize;
        environment::face_direction(face, given.vec2()).to_array().to_vec()
    }),
    Twin::new("environment_face_place", &[Domain::Direction], |given| {
        let (face, place) = environment::face_place(given.vec3());
        vec![place.x, place.y, face as f64]
    }),
    // The volume of the cone over an area of the face grows as the cube of its slant.
    Twin::new("environment_face_density", &[PLACE], |given| vec![given.vec2().extend(1.0).length().powi(-3)]),
    Twin::new("environment_sh", &[Domain::Choice(&INDICES), Domain::Direction], |given| {
        let (band, order) = environment::band_and_order(given.uint() as usize);
        vec![environment::harmonic(band, order, given.vec3())]
    }),
    Twin::new("environment_cosine_band", &[Domain::Choice(&[0, 1, 2, 3, 4])], |given| {
        vec![environment::cosine_band(given.uint() as usize)]
    }),
    Twin::new(
        "environment_hammersley",
        &[Domain::Choice(&[0, 1, 2, 3, 5, 17, 62, 63]), Domain::Choice(&[64, 100, 1024])],
        |given| {
            let (index, count) = (given.uint(), given.uint());
            let middle = 0.5f64.powi(25);
            vec![(f64::from(index) + 0.5) / f64::from(count), environment::radical_inverse(index) + middle]
        },
    ),
    Twin::new("environment_visible_facet", &[INSIDE, Domain::Hemisphere, ALPHA], |given| {
        let (u, v): (DVec2, DVec3) = (given.vec2(), given.vec3());
        environment::visible_facet(u, v, given.number()).to_array().to_vec()
    })
    // Cap and view cancel down to what stands above the horizon, (1 - u.y) (1 + v'.z) with v' the stretched view: an error
    // of two units in the last place of 1 is that much larger of the facet.
    .allowance(|given| {
        let (u, v, alpha) = (given.vec2(), given.vec3(), given.number());
        let stretched = DVec3::new(v.x * alpha, v.y * alpha, v.z).normalize();
        vec![2.0 * ULP / ((1.0 - u.y) * (1.0 + stretched.z)); 3]
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("environment_masking", &[Domain::Uniform(1e-7, 1.0, &[1e-7, 1e-3, 1.0]), ALPHA], |given| {
        let (mu, alpha) = (given.number(), given.number());
        vec![environment::masking(mu, alpha)]
    }),
    Twin::new("environment_level", &[ROUGHNESS, LAST], |given| {
        let (roughness, last) = (given.number(), given.number());
        vec![environment::level(roughness, last)]
    }),
    Twin::new("environment_alpha_of_level", &[Domain::Uniform(0.0, 8.0, &[0.0, 1.0, 8.0]), LAST_ABOVE_0], |given| {
        let (level, last) = (given.number(), given.number());
        vec![(level.exp2() - 1.0) / (last.exp2() - 1.0)]
    }),
    Twin::new(
        "environment_table_uv",
        &[Domain::Choice(&[0, 1, 2, 3]), COSINE, ROUGHNESS, Domain::Uniform(8.0, 64.0, &[8.0, 32.0, 64.0])],
        |given| {
            let (sheet, mu, roughness, nodes) = (given.uint(), given.number(), given.number(), given.number());
            let texel = |place: f64| place * (nodes - 1.0) + 0.5;
            let rows = nodes * environment::SHEETS as f64;
            vec![texel(mu.sqrt()) / nodes, (texel(roughness) + f64::from(sheet) * nodes) / rows]
        },
    ),
    Twin::new("environment_lobe_axis", &[Domain::Above, Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1.0])], |given| {
        let v = given.vec3();
        environment::lobe_axis(v, given.number()).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
];
