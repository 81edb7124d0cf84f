//! Judges `strand.glsl`.

use super::super::domain::{Domain, ROUGHNESS, UNIT};
use super::super::twin::{Rule, Twin};
use super::ULP;
use crate::material::reference::strand;
use glam::DVec3;
use std::f32::consts::FRAC_PI_2;

/// A coordinate in cells.
pub(super) const PLACE: Domain = Domain::Uniform(-32.0, 32.0, &[-31.0, -0.5, 0.0, 0.5, 31.0]);
/// Over the spacing of strands.
const RADIUS: Domain = Domain::Uniform(0.02, 0.5, &[0.02, 0.5]);
/// A component of half a view ray's segment, in cells: never longer than what is looked up.
const SEGMENT: Domain = Domain::Uniform(-0.14, 0.14, &[0.0, 1e-40, 0.14]);
const VARIANCE: Domain = Domain::Log(0.0065, 28.0, &[0.0065, 28.0]);
/// 4.95 / 4 times the root of 0.5 * 4 / 2 units in the last place.
const LOBE_ROUNDING: f64 = 4.95 / 4.0 * 3.453e-4;
/// A component of a force of at most unit strength.
const FORCE: Domain = Domain::Uniform(-0.57, 0.57, &[-0.57, 0.0, 1e-40, 1e-7, 0.57]);

pub(super) const TWINS: &[Twin] = &[
    Twin::new("strand_segment_distance", &[Domain::Uniform(-2.0, 2.0, &[-2.0, 0.0, 1e-40, 1.0]), SEGMENT], |given| {
        vec![strand::segment_distance(given.vec3(), given.vec3())]
    }),
    // Offsets keep 2^-18 of a cell this far from the origin; profiles measure them in radii, of which the smallest is
    // 0.02: 2 * 2^-18 / 0.02. The shader looks at the eight nearest cells, the twin at all: it misses a strand in one
    // place of five thousand. Outside of strands nothing reads the answer.
    Twin::new("strand_field", &[PLACE, Domain::Direction, RADIUS, SEGMENT], |given| {
        let (position, normal, radius) = (given.vec3(), given.vec3(), given.number());
        // The shader projects the segment onto the surface before it asks.
        let (profile, random) = strand::field(position, normal, radius, given.vec3());
        vec![profile, random]
    })
    .limit(2e-5, 4e-4)
    .rule(Rule::Stepped(4))
    .missed(2e-4)
    .used(|result| {
        let is_inside = result[0] > 1e-3;
        result.iter_mut().for_each(|value| *value = if is_inside { *value } else { 0.0 });
    }),
    Twin::new("strand_mean_coverage", &[UNIT, RADIUS, Domain::Uniform(0.0, 0.25, &[0.0, 1e-40, 0.25])], |given| {
        vec![strand::mean_coverage(given.number(), given.number(), given.number())]
    }),
    Twin::new("strand_threshold", &[UNIT, UNIT, UNIT, Domain::Choice(&[0, 1])], |given| {
        vec![strand::threshold(given.number(), given.number(), given.number(), given.uint() == 1)]
    }),
    Twin::new("strand_unresolved", &[Domain::Log(1e-3, 1e2, &[0.0, 1e-40, 0.75, 2.0, 1e30])], |given| {
        vec![strand::unresolved(given.number())]
    }),
    Twin::new(
        "strand_opacity",
        &[
            Domain::Uniform(-2.0, 1.0, &[-1e30, -1e3, 0.0, 0.5, 1.0]),
            UNIT,
            Domain::Log(1e-4, 10.0, &[0.0, 1e-40, 1e-6, 0.75, 2.0, 1e30]),
            UNIT,
        ],
        |given| vec![strand::opacity(given.number(), given.number(), given.number(), given.number())],
    ),
    Twin::new(
        "strand_arc",
        &[UNIT, Domain::Uniform(0.0, FRAC_PI_2, &[0.0, 1e-40, 1e-8, 1e-3, 1.9999e-3, 2e-3, FRAC_PI_2])],
        |given| strand::arc(given.number(), given.number()).to_vec(),
    ),
    // Vulkan lets atan be off by 4096 units in the last place.
    Twin::new("strand_bend_angle", &[Domain::Direction, FORCE], |given| {
        vec![strand::bend_angle(given.vec3(), given.vec3())]
    })
    .limit(4096.0 * ULP, 1e-6),
    Twin::new(
        "strand_light_through_coat",
        &[UNIT, UNIT, Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-40, 1e-7, 0.05, 1.0])],
        |given| vec![strand::light_through_coat(given.number(), given.number(), given.number())],
    ),
    // The half angle's cosine cancels where the eye looks into the light: 0.5 + 0.5 cos is known to four roundings, and its
    // root by the root of that. The factor along the fibre is at most 1 / sqrt(2 pi 0.0065) = 4.95.
    Twin::new(
        "strand_lobe",
        &[
            Domain::DirectionOrZero,
            Domain::Direction,
            Domain::Direction,
            Domain::Uniform(-0.2, 0.2, &[-0.08, 0.0, 0.12]),
            VARIANCE,
        ],
        |given| {
            let (tangent, to_eye, to_light) = (given.vec3(), given.vec3(), given.vec3());
            vec![strand::lobe(tangent, to_eye, to_light, given.number(), given.number())]
        },
    )
    .limit(2e-5, LOBE_ROUNDING),
    Twin::new("strand_variance", &[ROUGHNESS], |given| vec![strand::variance(given.number())]),
    Twin::new(
        "strand_scattering",
        &[
            UNIT,
            Domain::Direction,
            Domain::DirectionOrZero,
            Domain::Direction,
            Domain::Direction,
            UNIT,
            Domain::Log(0.0065, 28.0, &[0.0065, 28.0]),
        ],
        |given| {
            let (color, normal, tangent) = (given.vec3(), given.vec3(), given.vec3());
            let (to_eye, to_light, specular, variance) = (given.vec3(), given.vec3(), given.number(), given.number());
            let channel = |color| strand::scattering(color, normal, tangent, to_eye, to_light, specular, variance);
            let DVec3 { x, y, z } = color;
            [x, y, z].map(channel).to_vec()
        },
    )
    // A tenth of a lobe and three tenths of one that is twice as wide.
    .limit(2e-5, (0.1 + 0.3 / 2.0) * LOBE_ROUNDING),
];
