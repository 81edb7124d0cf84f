//! Flakes that a pixel tells apart, as discs.

use super::footprint::{Footprint, flake, read_footprint};
use super::inputs::{
    CHART, DISC, FLAKES, FOOTPRINT, KERNEL, NEAR, SQUARE, WIDE_LOBE, ivec2, join, read_flakes, words2, words3,
};
use super::lattice::{edges, unshuffle};
use super::mean_tint;
use super::tile::{STEPS, lobe_profile, seed, shift};
use crate::material::Flakes;
use crate::measure::twin::domain::UNIT;
use crate::measure::twin::{TestInputs, Twin};
use glam::{DVec2, DVec3, IVec2};
use std::f64::consts::PI;

/// A flake that a pixel may show as a disc.
#[derive(Debug, Clone, Copy)]
pub struct Disc {
    /// Tint times weight.
    pub tinted: DVec3,
    /// Share of area over the mean share.
    pub weight: f64,
    /// Where its normal lies.
    pub square: DVec2,
}

/// The flake at a place of the lattice.
pub fn disc(flakes: &Flakes, footprint: &Footprint, place: IVec2, chart: u32) -> Disc {
    let (tint, weight) = flake(flakes, footprint, place, 0, chart * 16);
    let side = 1 << flakes.fineness;
    let (tile, at) = (place.div_euclid(IVec2::splat(side)), place.rem_euclid(IVec2::splat(side)).as_uvec2());
    let seed = seed(tile, chart * 16);
    let number = unshuffle(at.x + at.y * side as u32, flakes.fineness, seed[1]);
    let cell = DVec2::new(f64::from(number % side as u32), f64::from(number / side as u32)) + 0.5;
    let moved = cell / f64::from(side) - shift(seed);
    let square = 2.0 * (moved - (moved + 0.5).floor());
    Disc { tinted: tint * weight, weight, square }
}

/// The flakes that a pixel may show as discs.
pub fn discs(flakes: &Flakes, footprint: &Footprint, chart: u32) -> [Disc; 4] {
    let first = footprint.cell + (footprint.within - 0.5).floor().as_ivec2();
    STEPS.map(|step| disc(flakes, footprint, first + step, chart))
}

/// How well a pixel tells discs apart, [0, 1].
pub fn apart(footprint: &Footprint) -> f64 {
    ((0.45 - footprint.blur) * 4.0).clamp(0.0, 1.0)
}

/// Tint and share of area of the flakes in a pixel over their mean share; no more than all of it.
pub fn cover(flakes: &Flakes, discs: &[Disc; 4], apart: f64) -> (DVec3, f64) {
    let weight: f64 = discs.iter().map(|disc| disc.weight).sum();
    let mean_share = PI * f64::from(flakes.radius).powi(2) / edges().determinant();
    let left = 1.0 / (mean_share * weight).max(1.0);
    let tinted = discs.iter().map(|disc| disc.tinted).sum::<DVec3>() * left;
    (DVec3::splat(mean_tint(flakes)).lerp(tinted, apart), 1.0 + (weight * left - 1.0) * apart)
}

/// Tint times weight of a disc whose lobe holds the half vector.
pub fn disc_flash(flakes: &Flakes, disc: &Disc, square: DVec2, lobe: f64) -> DVec3 {
    let cells = f64::from(1u32 << flakes.fineness);
    let way = 0.5 * (square - disc.square);
    let u = ((way - (way + 0.5).floor()) * cells / lobe).length_squared();
    disc.tinted * lobe_profile(u) * cells * cells / (PI * lobe * lobe)
}

/// The factor on the smooth lobe in a pixel that tells discs apart.
pub fn discs_flash(flakes: &Flakes, discs: &[Disc; 4], square: DVec2, lobe: f64) -> DVec3 {
    let seen = lobe.min(0.5 * f64::from(1u32 << flakes.fineness));
    let sum = discs.iter().map(|disc| disc_flash(flakes, disc, square, seen)).sum();
    DVec3::splat(mean_tint(flakes)).lerp(sum, seen / lobe)
}

fn read_disc(inputs: &mut TestInputs<'_>) -> Disc {
    Disc { tinted: inputs.vec3(), weight: inputs.number(), square: inputs.vec2() }
}

fn read_discs(inputs: &mut TestInputs<'_>) -> [Disc; 4] {
    [read_disc(inputs), read_disc(inputs), read_disc(inputs), read_disc(inputs)]
}

fn disc_words(disc: &Disc) -> Vec<f64> {
    [words3(disc.tinted), vec![disc.weight], words2(disc.square)].concat()
}

/// What the shader's functions are held to.
pub(in crate::measure::twin) const TWINS: &[Twin] = &[
    // A normal on the rim of the square may lie on the opposite one just as well.
    Twin::new("glint_disc", &join::<16>(&[&FLAKES, &FOOTPRINT, &[NEAR, CHART]]), |inputs| {
        let (flakes, footprint) = (read_flakes(inputs), read_footprint(inputs));
        let place = ivec2(inputs);
        disc_words(&disc(&flakes, &footprint, place, inputs.uint()))
    })
    .rule(KERNEL),
    Twin::new("glint_discs", &join::<15>(&[&FLAKES, &FOOTPRINT, &[CHART]]), |inputs| {
        let (flakes, footprint) = (read_flakes(inputs), read_footprint(inputs));
        let discs = discs(&flakes, &footprint, inputs.uint());
        let mut words = discs.iter().map(disc_words).collect::<Vec<_>>().concat();
        words.push(apart(&footprint));
        words
    })
    .rule(KERNEL),
    Twin::new("glint_cover", &join::<14>(&[&FLAKES, &DISC, &DISC, &DISC, &DISC, &[UNIT]]), |inputs| {
        let (flakes, discs) = (read_flakes(inputs), read_discs(inputs));
        let (tinted, share) = cover(&flakes, &discs, inputs.number());
        tinted.extend(share).to_array().to_vec()
    }),
    Twin::new("glint_disc_flash", &join::<9>(&[&FLAKES, &DISC, &[SQUARE, WIDE_LOBE]]), |inputs| {
        let (flakes, disc) = (read_flakes(inputs), read_disc(inputs));
        words3(disc_flash(&flakes, &disc, inputs.vec2(), inputs.number()))
    })
    .rule(KERNEL),
    Twin::new(
        "glint_discs_flash",
        &join::<16>(&[&FLAKES, &DISC, &DISC, &DISC, &DISC, &[UNIT, SQUARE, WIDE_LOBE]]),
        |inputs| {
            let (flakes, discs) = (read_flakes(inputs), read_discs(inputs));
            let _apart = inputs.number();
            words3(discs_flash(&flakes, &discs, inputs.vec2(), inputs.number()))
        },
    )
    .rule(KERNEL),
];
