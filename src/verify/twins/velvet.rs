//! Judges `velvet.glsl`: the classic form.

use super::super::domain::{COSINE, Domain, ROUGHNESS, UNIT};
use super::super::twin::Twin;
use crate::material::reference::classic::velvet::{self, Velvet};
use crate::material::reference::ggx;

/// A cosine on either side of the horizon.
const SIGNED_COSINE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-7, 1.0]);

pub(super) const TWINS: &[Twin] = &[
    Twin::new("velvet_classic_ndf", &[Domain::Hemisphere], |given| vec![velvet::ndf(given.vec3())]),
    Twin::new(
        "velvet_classic_highlight_times_cosine",
        &[UNIT, ROUGHNESS, Domain::Hemisphere, Domain::Hemisphere],
        |given| {
            let (f0, roughness, v, l) = (given.vec3(), given.number(), given.vec3(), given.vec3());
            let roughness = roughness.max(ggx::SMALLEST_ALPHA.sqrt());
            let none = Velvet { base_color: 0.0, f0: 0.0, roughness, scatter_color: 0.0, scatter_scale: 0.0 };
            f0.to_array().map(|f0| Velvet { f0, ..none }.highlight_times_cosine(v, l)).to_vec()
        },
    ),
    Twin::new("velvet_classic_scatter", &[UNIT, UNIT, COSINE, SIGNED_COSINE], |given| {
        let (scatter_color, scatter_scale) = (given.vec3(), given.number());
        let (mu_v, mu_l) = (given.number(), given.number());
        let none = Velvet { base_color: 0.0, f0: 0.0, roughness: 1.0, scatter_color: 0.0, scatter_scale };
        scatter_color.to_array().map(|scatter_color| Velvet { scatter_color, ..none }.scatter(mu_v, mu_l)).to_vec()
    }),
];
