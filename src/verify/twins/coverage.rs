//! Judges `coverage.glsl`.

use super::super::domain::{ALMOST_ONE, Domain, UNIT};
use super::super::twin::{Limit, Rule, Twin};
use crate::material::reference::{coverage, hash};

/// In [0, 1).
const SHARE: Domain = Domain::Uniform(0.0, ALMOST_ONE, &[0.0, 1e-40, 0.25, 0.5, 0.75, ALMOST_ONE]);

const LAYER: Domain = Domain::Choice(&[0, 1, 7, 255]);

pub(super) const TWINS: &[Twin] = &[
    // The cells of a picture 32 units wide with pixels of a micrometre still have integer numbers. log2 of such pixels
    // is rounded at 2^-20, which is 2^-20 ln 2 / 2^-24 = 11 units of the pixel's size; three more for log2 itself.
    Twin::new(
        "coverage_grain",
        &[
            Domain::Uniform(-32.0, 32.0, &[-32.0, -1.0, 0.0, 0.5, 32.0]),
            Domain::Log(1e-6, 10.0, &[1e-6, 0.25, 1.0]),
            LAYER,
        ],
        |given| {
            let (position, pixel_size, layer) = (given.vec3(), given.number(), given.uint() as i32);
            let cell_size = pixel_size.max(1e-30).log2().ceil().exp2();
            let cell = (position / cell_size).floor().to_array().map(|coordinate| coordinate as i32 + layer * 7919);
            let [_, y, z] = hash::cell(cell);
            vec![z, y]
        },
    )
    .rule(Rule::Stepped(14)),
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("coverage_mask", &[UNIT, Domain::Choice(&[1, 4]), SHARE, SHARE], |given| {
            let (opacity, sample_count) = (given.number(), given.uint());
            let (threshold, order) = (given.number(), given.number());
            let count = coverage::count(opacity, sample_count, threshold);
            vec![f64::from(if sample_count == 1 { count } else { coverage::mask(count, order) })]
        })
        .rule(Rule::Stepped(4))
    },
];
