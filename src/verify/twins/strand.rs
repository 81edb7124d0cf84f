//! Judges `strand.glsl`.

use super::super::domain::{Domain, UNIT};
use super::super::twin::{Given, Rule, Twin};
use super::ULP;
use crate::material::reference::strand::{self, Hit, Path, Strand};
use glam::DVec3;
use std::f32::consts::FRAC_PI_2;

/// A coordinate in cells.
pub(super) const PLACE: Domain = Domain::Uniform(-32.0, 32.0, &[-31.0, -0.5, 0.0, 0.5, 31.0]);
/// Over the spacing of strands.
const RADIUS: Domain = Domain::Uniform(0.02, 0.5, &[0.02, 0.5]);
/// A component of half a view ray's segment, in cells: what is walked at most.
const SEGMENT: Domain = Domain::Uniform(-1.7, 1.7, &[0.0, 1e-40, 1e-7, 1.7]);
/// Of a threshold, over half a slab.
const RISE: Domain = Domain::Uniform(-0.2, 0.2, &[0.0, 1e-40, 0.2]);
/// In the middle of a path: at both ends it is not negative.
const THRESHOLD: Domain = Domain::Uniform(0.2, 1.2, &[0.2, 0.5, 1.0, 9.0]);
const ENOUGH: Domain = Domain::Uniform(0.0, 1.0, &[1e-3, 0.25, 1.0]);
const MARGIN: Domain = Domain::Uniform(-1.0, 1.0, &[-1e3, -1e-40, 0.0, 1.0]);
const PLACE_ON_PATH: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1.0]);
/// In the order of the shader's struct.
const PATH: &[Domain] = &[PLACE, THRESHOLD, SEGMENT, RISE, Domain::Direction, RADIUS, Domain::Sign, ENOUGH];
/// Cells around the place, so that strands are met.
const PATH_AND_CELL: &[Domain] = &[
    Domain::Uniform(0.0, 2.0, &[0.0, 0.5, 1.0]),
    THRESHOLD,
    SEGMENT,
    RISE,
    Domain::Direction,
    RADIUS,
    Domain::Sign,
    ENOUGH,
    Domain::Choice(&[0, 1]),
];
/// Offsets of up to 6 cells keep 2^-22, and root radii are 0.02 or more: 1.2e-5 for a margin; places, where the ray slants
/// into a strand's side, some times that.
const WALK: f64 = 1e-4;

fn path(given: &mut Given) -> Path {
    Path {
        middle: given.vec3(),
        threshold: given.number(),
        half_segment: given.vec3(),
        threshold_rise: given.number(),
        normal: given.vec3(),
        radius: given.number(),
        entry: given.number(),
        enough: given.number(),
    }
}

fn hit(hit: Hit) -> Vec<f64> {
    vec![hit.margin, hit.place, hit.random]
}

/// Nothing reads where a strand is that the pixel hardly touches, nor which of those it is that hold the entry together.
fn met(result: &mut [f64]) {
    result[0] = result[0].max(-0.1);
    if result[0] < 0.02 {
        result[1] = 0.0;
    }
    if result[0] < 0.02 || result[1].abs() == 1.0 {
        result[2] = 0.0;
    }
}

/// A component of a force of at most unit strength.
const FORCE: Domain = Domain::Uniform(-0.57, 0.57, &[-0.57, 0.0, 1e-40, 1e-7, 0.57]);

pub(super) const TWINS: &[Twin] = &[
    // Radii are at least a thousandth of a cell, of which f32 keeps 2^-13 when offsets of a cell are rounded.
    Twin::new("strand_meet", PATH_AND_CELL, |given| {
        let path = path(given);
        let cell = DVec3::new(given.int().into(), given.int().into(), given.int().into());
        hit(strand::meet(&path, &Strand::of_cell(cell)))
    })
    .limit(2e-5, WALK)
    .rule(Rule::Conditioned(4))
    .used(met),
    Twin::new("strand_first", &[MARGIN, PLACE_ON_PATH, UNIT, MARGIN, PLACE_ON_PATH, UNIT, Domain::Sign], |given| {
        let mut next = || Hit { margin: given.number(), place: given.number(), random: given.number() };
        let (a, b) = (next(), next());
        hit(strand::first(a, b, given.number()))
    })
    .limit(0.0, 0.0),
    Twin::new("strand_walk", PATH, |given| hit(strand::walk(&path(given))))
        .limit(2e-5, WALK)
        .rule(Rule::Stepped(4))
        .used(met),
    // Eight times log, which near 1 is off by up to 2^-21.
    Twin::new("strand_left", &[UNIT], |given| strand::left(given.number()).to_vec()).limit(2e-5, 8.0 / 2_097_152.0),
    Twin::new("strand_cross_section", &[UNIT, RADIUS], |given| {
        vec![strand::cross_section(given.number(), given.number())]
    }),
    Twin::new("strand_width", &[UNIT, RADIUS], |given| vec![strand::width(given.number(), given.number())]),
    Twin::new(
        "strand_slab_opacity",
        &[
            Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-40, 1e-7, 1.0]),
            UNIT,
            Domain::Log(1e-3, 1e2, &[0.0, 1e-40, 1e-7, 1e30]),
        ],
        |given| vec![strand::slab_opacity(given.number(), given.number(), given.number())],
    ),
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
            Domain::Log(1e-4, 10.0, &[0.0, 1e-40, 1e-6, 0.75, 2.0, 1e30]),
            UNIT,
        ],
        |given| vec![strand::opacity(given.number(), given.number(), given.number())],
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
    // The chord's slant costs a digit below the horizon, in single precision as in the twin's inputs.
    Twin::new(
        "strand_optical_depth",
        &[UNIT, UNIT, Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-40, 1e-7, 0.05, 1.0])],
        |given| vec![strand::optical_depth(given.number(), given.number(), given.number())],
    )
    .limit(2e-5, 1e-5),
];
