//! Judges `fibre.glsl`.

use super::super::domain::{Domain, ROUGHNESS, UNIT};
use super::super::twin::{Given, Rule, Twin};
use crate::material::reference::fibre::{self, Fibre, Lobe};
use glam::DVec3;

const SINE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, -0.0, 1e-40, 1e-7, 0.5, 1.0]);
/// Of the three lobes at roughness 0.1 to 1.
const VARIANCE: Domain = Domain::Log(1.6e-3, 112.0, &[1.6e-3, 112.0]);
/// Of the lobe R.
const VARIANCE_OF_R: Domain = Domain::Log(6.5e-3, 28.0, &[6.5e-3, 28.0]);
/// And far below: what the longitudinal lobe itself stands.
const ANY_VARIANCE: Domain = Domain::Log(1e-7, 112.0, &[1e-7, 4.0, 112.0]);
const DEPTH: Domain = Domain::Log(1e-3, 50.0, &[0.0, 1e-40, 1e-7, 1e30]);
const SHARE: Domain = Domain::Uniform(0.0, 0.3, &[0.0, 0.1, 0.3]);
/// In the order of the shader's struct.
const FIBRE: [Domain; 8] =
    [Domain::Direction, Domain::Direction, Domain::DirectionOrZero, SINE, UNIT, VARIANCE, SHARE, UNIT];

fn fibre(given: &mut Given) -> Fibre {
    let (normal, tangent, across) = (given.vec3(), given.vec3(), given.vec3());
    let [sine, cosine, variance, share, seen] = std::array::from_fn(|_| given.vec3());
    let lobes = [0, 1, 2].map(|index| Lobe {
        sine: sine[index],
        cosine: cosine[index],
        variance: variance[index],
        share: share[index],
        seen: seen[index],
    });
    Fibre { normal, tangent, across, lobes }
}

fn of_colors(color: DVec3, value: impl Fn(f64) -> f64) -> Vec<f64> {
    color.to_array().map(value).to_vec()
}

pub(super) const TWINS: &[Twin] = &[
    Twin::new("fibre_variance", &[ROUGHNESS], |given| vec![fibre::variance(given.number())]),
    // Abramowitz & Stegun's bound, 1.9e-7, is one of sqrt(x) times this.
    Twin::new("fibre_bessel", &[Domain::Log(1e-4, 1e7, &[0.0, 1e-40, 3.75, 1e7])], |given| {
        of_colors(given.vec3(), fibre::bessel)
    }),
    // A narrow lobe's exponent, up to 88 where it counts, moves with the last digits of the sines.
    Twin::new("fibre_along", &[SINE, UNIT, ANY_VARIANCE, SINE, UNIT], |given| {
        let (sine, cosine, variance) = (given.vec3(), given.vec3(), given.vec3());
        let (light_sine, light_cosine) = (given.number(), given.number());
        [0, 1, 2].map(|at| fibre::along(sine[at], cosine[at], variance[at], light_sine, light_cosine)).to_vec()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new(
        "fibre_around",
        &[Domain::DirectionOrZero, Domain::Uniform(-0.6, 0.6, &[-0.5, 0.0, 1e-40, 0.5])],
        |given| {
            let [side, ahead] = fibre::around(given.vec3(), given.vec3());
            vec![side, side, ahead]
        },
    ),
    Twin::new("fibre_horizon", &[SINE], |given| vec![fibre::horizon(given.number())]),
    Twin::new("fibre_seen", &[SINE, VARIANCE, SINE, SINE], |given| {
        let (sine, variance) = (given.vec3(), given.vec3());
        fibre::seen_of_lobes(sine, variance, given.number(), given.number()).to_vec()
    })
    .limit(2e-5, 2e-5),
    Twin::new(
        "fibre_to_eye",
        &[Domain::Direction, Domain::Direction, Domain::Direction, UNIT, UNIT, VARIANCE_OF_R],
        |given| {
            let (normal, tangent, to_eye) = (given.vec3(), given.vec3(), given.vec3());
            let fibre = Fibre::new(normal, tangent, to_eye, given.number(), given.number(), given.number());
            let of_lobes = |value: fn(Lobe) -> f64| fibre.lobes.map(value);
            [
                fibre.normal.to_array(),
                fibre.tangent.to_array(),
                fibre.across.to_array(),
                of_lobes(|lobe| lobe.sine),
                of_lobes(|lobe| lobe.cosine),
                of_lobes(|lobe| lobe.variance),
                of_lobes(|lobe| lobe.share),
                of_lobes(|lobe| lobe.seen),
            ]
            .concat()
        },
    )
    .limit(2e-5, 2e-5)
    .rule(Rule::Stepped(4)),
    Twin::new("fibre_transmittance", &[UNIT], |given| of_colors(given.vec3(), fibre::transmittance)),
    Twin::new("fibre_passed_on", &[UNIT, DEPTH], |given| {
        let (color, depth) = (given.vec3(), given.number());
        of_colors(color, |color| fibre::passed_on(color, depth))
    }),
    Twin::new(
        "fibre_diffuse",
        &[FIBRE[0], FIBRE[1], FIBRE[2], FIBRE[3], FIBRE[4], FIBRE[5], FIBRE[6], FIBRE[7], Domain::Direction, UNIT],
        |given| {
            let fibre = fibre(given);
            vec![fibre.diffuse(given.vec3(), given.number())]
        },
    ),
    Twin::new(
        "fibre_rest",
        &[FIBRE[0], FIBRE[1], FIBRE[2], FIBRE[3], FIBRE[4], FIBRE[5], FIBRE[6], FIBRE[7], UNIT],
        |given| {
            let fibre = fibre(given);
            vec![fibre.rest(given.number())]
        },
    ),
    // Sines of directions are off by two units in the last place of 1, over a deviation of 0.04: 4e-5 of the lobe six
    // deviations out, where nothing is left of it.
    Twin::new(
        "fibre_scattering",
        &[
            FIBRE[0],
            FIBRE[1],
            FIBRE[2],
            FIBRE[3],
            FIBRE[4],
            FIBRE[5],
            FIBRE[6],
            FIBRE[7],
            UNIT,
            Domain::Direction,
            DEPTH,
        ],
        |given| {
            let (fibre, color, to_light) = (fibre(given), given.vec3(), given.vec3());
            let depth = given.number();
            of_colors(color, |color| fibre.scattering(color, to_light, depth))
        },
    )
    .limit(6e-5, 2e-6),
    Twin::new(
        "fibre_surroundings",
        &[
            FIBRE[0], FIBRE[1], FIBRE[2], FIBRE[3], FIBRE[4], FIBRE[5], FIBRE[6], FIBRE[7], UNIT, UNIT, UNIT, UNIT,
            DEPTH,
        ],
        |given| {
            let (fibre, color) = (fibre(given), given.vec3());
            let (diffuse, ahead, mirrored, depth) = (given.vec3(), given.vec3(), given.vec3(), given.number());
            [0, 1, 2].map(|at| fibre.surroundings(color[at], diffuse[at], ahead[at], mirrored[at], depth)).to_vec()
        },
    ),
];
