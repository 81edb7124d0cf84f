//! Flakes of a level, many a tile: the one whose lobe may hold a half vector is found without looking at the others.

use super::footprint::{Footprint, flake, read_footprint};
use super::inputs::{
    CHART, FINENESS, FLAKES, FOOTPRINT, KERNEL, LEVEL, LOBE, NEAR, SHARE, SQUARE, TILES, WIDE_LOBE, ivec2, join,
    read_flakes, uvec2, words2, words3,
};
use super::lattice::shuffle;
use super::mean_tint;
use crate::material::Flakes;
use crate::measure::twin::domain::Domain;
use crate::measure::twin::{Limit, Rule, TestInputs, Twin, hash};
use glam::{DVec2, DVec3, IVec2};
use std::f64::consts::PI;

/// Level at which single flakes are left out.
pub const LAST_LEVEL: f64 = 8.0;

/// First level whose single flakes are seen by a kernel that reaches so far, and their share and that of the next level.
pub fn levels(reach: f64, fineness: u32) -> (u32, f64, f64) {
    let level = (2.0 * reach).max(1e-6).log2() - f64::from(fineness);
    let first = level.ceil().clamp(0.0, LAST_LEVEL);
    // The next level takes over within the last half octave. a + b / 2 <= 1, so that nothing is negative, and a^2 + b^2,
    // the variance, is 1 where that allows.
    let b = (2.0 * (level - first) + 1.0).clamp(0.0, 1.0);
    let a = (1.0 - 0.5 * b).min((1.0 - b * b).sqrt());
    let share = 0.5f64.powf(first) * (LAST_LEVEL - level).clamp(0.0, 1.0);
    (first as u32, a * share, 0.5 * b * share)
}

/// What chooses a tile's shuffle (second) and moves its normals (first: two halves of a word).
pub fn seed(tile: IVec2, stream: u32) -> [u32; 2] {
    let [x, y, z] = hash::pcg3d([tile.x as u32, tile.y as u32, stream + 128]);
    [x & 0xffff_0000 | y >> 16, z]
}

/// The four tiles of one level around a pixel.
#[derive(Debug, Clone, Copy)]
pub struct Tiles {
    /// Of them the lowest along both edges.
    pub first: IVec2,
    /// Of random numbers: level and chart.
    pub stream: u32,
    /// Each flake stands for 4^level.
    pub level: u32,
    /// Of the first, one right, one up, both.
    pub seeds: [[u32; 2]; 4],
}

/// From the first tile to each.
pub(super) const STEPS: [IVec2; 4] = [IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE];

impl Tiles {
    /// Those that a kernel in that rhombus may reach.
    pub fn new(cell: IVec2, fineness: u32, level: u32, chart: u32) -> Self {
        let size = f64::from(1u32 << (fineness + level));
        let first = (cell.as_dvec2() / size - 0.5).floor().as_ivec2();
        let stream = chart * 16 + level;
        Self { first, stream, level, seeds: STEPS.map(|step| seed(first + step, stream)) }
    }
}

/// How far a tile's normals are moved, in sides of the square.
pub fn shift(seed: [u32; 2]) -> DVec2 {
    DVec2::new(f64::from(seed[0] >> 16), f64::from(seed[0] & 0xffff)) / 65536.0
}

/// The profile of a lobe, of squared distance u; its mean over the disc u <= 1 is 1.
pub fn lobe_profile(u: f64) -> f64 {
    3.0 * (1.0 - u).max(0.0).powi(2)
}

/// Tint times weight of the flake of one tile whose lobe may hold the half vector at `square`.
pub fn tile(
    flakes: &Flakes,
    footprint: &Footprint,
    tile: IVec2,
    (level, stream): (u32, u32),
    seed: [u32; 2],
    square: DVec2,
    lobe: f64,
) -> DVec3 {
    let cells = f64::from(1u32 << flakes.fineness);
    let place = (0.5 * square + shift(seed)).fract_gl() * cells;
    let cell = place.floor().min(DVec2::splat(cells - 1.0));
    let u = (place - cell - 0.5).length_squared() / (lobe * lobe);
    let number = shuffle(cell.x as u32 + ((cell.y as u32) << flakes.fineness), flakes.fineness, seed[1]);
    let in_tile = IVec2::new((number % (1 << flakes.fineness)) as i32, (number >> flakes.fineness) as i32);
    let (tint, weight) = flake(flakes, footprint, (tile << flakes.fineness) + in_tile, level, stream);
    let area = 4f64.powi((flakes.fineness + level) as i32);
    tint * weight * area * lobe_profile(u) / (PI * lobe * lobe)
}

/// The factor on the smooth lobe, of the flakes of one level alone.
pub fn level(flakes: &Flakes, footprint: &Footprint, tiles: &Tiles, square: DVec2, lobe: f64) -> DVec3 {
    let streams = (tiles.level, tiles.stream);
    let all = STEPS.iter().zip(tiles.seeds);
    all.map(|(step, seed)| tile(flakes, footprint, tiles.first + *step, streams, seed, square, lobe)).sum()
}

/// The factor on the smooth lobe in a pixel that sees levels of tiles, each with its share.
pub fn tiles_flash(flakes: &Flakes, footprint: &Footprint, levels: &[(f64, Tiles)], square: DVec2, lobe: f64) -> DVec3 {
    let seen = lobe.min(0.5);
    let mean = DVec3::splat(mean_tint(flakes));
    let off_mean = |tiles: &Tiles| level(flakes, footprint, tiles, square, seen) - mean;
    mean + seen / lobe * levels.iter().map(|(share, tiles)| *share * off_mean(tiles)).sum::<DVec3>()
}

fn read_tiles(inputs: &mut TestInputs<'_>) -> Tiles {
    Tiles {
        first: ivec2(inputs),
        stream: inputs.uint(),
        level: inputs.uint(),
        seeds: [uvec2(inputs), uvec2(inputs), uvec2(inputs), uvec2(inputs)],
    }
}

/// What the shader's functions are held to.
pub(in crate::measure::twin) const TWINS: &[Twin] = &[
    // At a step the next level takes over with the share that it had, so that sums over levels know no step. The
    // logarithm is rounded at 2^-20, which is 2^-20 ln 2 / 2^-24 = 11 units of the reach; three more for log2 itself.
    Twin::new("glint_levels", &[Domain::Log(1e-3, 1e6, &[0.0, 1.0, 2.0, 128.0, 1e6, 1e12]), FINENESS], |inputs| {
        let (reach, fineness) = (inputs.number(), inputs.uint());
        let (first, near, far) = levels(reach, fineness);
        vec![f64::from(first), near, far]
    })
    .used(|words| {
        if let [first, near, far] = *words {
            words.copy_from_slice(&[near + far, near * first + far * (first + 1.0), near * near + far * far]);
        }
    })
    .rule(Rule::Conditioned(14)),
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("glint_seed", &[Domain::Bits, Domain::Choice(&[0, 1, 16, 41])], |inputs| {
            let (tile, stream) = (ivec2(inputs), inputs.uint());
            seed(tile, stream).map(f64::from).to_vec()
        })
    },
    Twin {
        limit: Limit::EXACT,
        ..Twin::new(
            "glint_tiles",
            &join::<12>(&[
                &[Domain::Choice(&[0, 1, 7, u32::MAX, 100_000_000, 0xfa0a_1f00])],
                FOOTPRINT.split_at(1).1,
                &[FINENESS, LEVEL, CHART],
            ]),
            |inputs| {
                let footprint = read_footprint(inputs);
                let t = Tiles::new(footprint.cell, inputs.uint(), inputs.uint(), inputs.uint());
                let mut words = words2(t.first.as_dvec2());
                words.extend([t.stream, t.level].map(f64::from));
                words.extend(t.seeds.concat().into_iter().map(f64::from));
                words
            },
        )
    },
    Twin::new(
        "glint_tile",
        &join::<20>(&[&FLAKES, &FOOTPRINT, &[NEAR, Domain::Choice(&[0, 1]), CHART, Domain::Bits, SQUARE, LOBE]]),
        |inputs| {
            let (flakes, footprint) = (read_flakes(inputs), read_footprint(inputs));
            let (at, streams, seed) = (ivec2(inputs), (inputs.uint(), inputs.uint()), uvec2(inputs));
            words3(tile(&flakes, &footprint, at, streams, seed, inputs.vec2(), inputs.number()))
        },
    )
    .rule(KERNEL),
    Twin::new("glint_level", &join::<23>(&[&FLAKES, &FOOTPRINT, &TILES, &[SQUARE, LOBE]]), |inputs| {
        let (flakes, footprint, tiles) = (read_flakes(inputs), read_footprint(inputs), read_tiles(inputs));
        words3(level(&flakes, &footprint, &tiles, inputs.vec2(), inputs.number()))
    })
    .rule(KERNEL),
    Twin::new(
        "glint_tiles_flash",
        &join::<33>(&[&FLAKES, &FOOTPRINT, &[NEAR, SHARE, SHARE], &TILES, &TILES, &[SQUARE, WIDE_LOBE]]),
        |inputs| {
            let (flakes, footprint) = (read_flakes(inputs), read_footprint(inputs));
            let (_, near, far) = (inputs.uint(), inputs.number(), inputs.number());
            let levels = [(near, read_tiles(inputs)), (far, read_tiles(inputs))];
            words3(tiles_flash(&flakes, &footprint, &levels, inputs.vec2(), inputs.number()))
        },
    )
    .rule(KERNEL),
];
