//! Judges `fuzz.glsl`.

use super::super::domain::{Domain, UNIT};
use super::super::twin::{Given, Twin};
use super::sheen::{Lobe, MODEL, around_two_lobes};
use glam::DVec3;
use std::f64::consts::PI;

/// Members of `FuzzSurface`.
struct Surface {
    diffuse: DVec3,
    coupled_diffuse: DVec3,
    pile_color: DVec3,
    fibre_color: DVec3,
    pile: Lobe,
    fibre: Lobe,
}

impl Surface {
    fn new(given: &mut Given<'_>) -> Self {
        Self {
            diffuse: given.vec3(),
            coupled_diffuse: given.vec3(),
            pile_color: given.vec3(),
            fibre_color: given.vec3(),
            pile: Lobe::new(given),
            fibre: Lobe::new(given),
        }
    }

    fn words(&self) -> Vec<f64> {
        let colors = [self.diffuse, self.coupled_diffuse, self.pile_color, self.fibre_color];
        let colors = colors.iter().flat_map(DVec3::to_array);
        colors.chain(self.pile.words()).chain(self.fibre.words()).collect()
    }
}

/// Of `has_fibre`.
const FLAG: Domain = Domain::Choice(&[0, 1]);

pub(super) const TWINS: &[Twin] = &[
    Twin::new("fuzz_surface", around_two_lobes!([UNIT, UNIT, UNIT], []), |given| {
        let (diffuse, pile_color, fibre_color) = (given.vec3(), given.vec3(), given.vec3());
        let (pile, fibre) = (Lobe::new(given), Lobe::new(given));
        let seen = pile_color * (1.0 - fibre_color);
        let of_both = |pile: f64, fibre: f64| seen * pile + fibre_color * fibre;
        let left = 1.0 - of_both(pile.albedo, fibre.albedo);
        let average = 1.0 - of_both(pile.average, fibre.average);
        let coupled_diffuse = diffuse / PI * left / average.max(DVec3::splat(1e-4));
        Surface { diffuse, coupled_diffuse, pile_color: seen, fibre_color, pile, fibre }.words()
    }),
    Twin::new(
        "fuzz_brdf_times_cosine",
        around_two_lobes!([MODEL, FLAG, UNIT, UNIT, UNIT, UNIT], [Domain::Hemisphere, Domain::Hemisphere, UNIT]),
        |given| {
            let (model, has_fibre, surface) = (given.uint(), given.uint() != 0, Surface::new(given));
            let (v, l, albedo_l) = (given.vec3(), given.vec3(), given.vec2());
            if v.z <= 0.0 || l.z <= 0.0 {
                return vec![0.0; 3];
            }
            let fibre_color = if has_fibre { surface.fibre_color } else { DVec3::ZERO };
            let lobes = surface.pile_color * surface.pile.brdf_times_cosine(model, v, l)
                + fibre_color * surface.fibre.brdf_times_cosine(model, v, l);
            let left = 1.0 - surface.pile_color * albedo_l.x - fibre_color * albedo_l.y;
            (lobes + surface.coupled_diffuse * left * l.z).to_array().to_vec()
        },
    ),
    Twin::new("fuzz_ambient", around_two_lobes!([UNIT, UNIT, UNIT, UNIT], [UNIT, UNIT, UNIT]), |given| {
        let surface = Surface::new(given);
        let (pile_light, fibre_light, base_light) = (given.vec3(), given.vec3(), given.vec3());
        let pile = surface.pile_color * surface.pile.albedo;
        let fibre = surface.fibre_color * surface.fibre.albedo;
        let base = surface.diffuse * (1.0 - pile - fibre);
        (pile * pile_light + fibre * fibre_light + base * base_light).to_array().to_vec()
    }),
];
