//! Judges `occlusion.glsl`.

use super::super::domain::{COSINE, ROUGHNESS, UNIT};
use super::super::twin::{Rule, Twin};
use crate::material::reference::occlusion;

pub(super) const TWINS: &[Twin] = &[
    // A power of up to 20 stretches the rounding of its base.
    Twin::new("occlusion_of_lobe", &[COSINE, ROUGHNESS, UNIT], |given| {
        vec![occlusion::of_lobe(given.number(), given.number(), given.number())]
    })
    .limit(2e-5, 1e-5)
    .rule(Rule::Conditioned(8)),
    Twin::new("occlusion_bounced", &[UNIT, UNIT], |given| {
        let (x, color) = (given.number(), given.vec3());
        color.to_array().map(|color| occlusion::bounced(x, color)).to_vec()
    }),
];
