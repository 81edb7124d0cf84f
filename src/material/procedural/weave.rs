//! Woven and knitted surfaces: threads as bent cylinders, of which the higher one shows.

use super::noise::octaves;
use super::{color, grey, normals};
use crate::asset::Image;
use glam::{IVec2, Vec2, Vec3};
use std::f32::consts::{PI, TAU};

/// What passes over what: one row a weft, one letter a warp; `x` where the warp lies on top.
struct Draft {
    rows: &'static [&'static [u8]],
    /// Threads along each side of the tile, a multiple of the draft's.
    threads: i32,
    /// Width of a thread over the distance to the next, (0, 1].
    width: f32,
}

const PLAIN: Draft = Draft { rows: &[b"x.", b".x"], threads: 24, width: 0.96 };
const TWILL: Draft = Draft { rows: &[b"xxx.", b".xxx", b"x.xx", b"xx.x"], threads: 24, width: 0.96 };
const SATIN: Draft = Draft { rows: &[b"xxxx.", b"x.xxx", b"xxx.x", b".xxxx", b"xx.xx"], threads: 25, width: 0.98 };

/// Heights of the warp and the weft above the middle of the cloth at a point, in distances between threads; far below
/// where there is none.
struct Threads {
    warp: f32,
    weft: f32,
}

impl Draft {
    fn warp_is_on_top(&self, cell: IVec2) -> bool {
        let row = self.rows[cell.y.rem_euclid(self.rows.len() as i32) as usize];
        row[cell.x.rem_euclid(row.len() as i32) as usize] == b'x'
    }

    fn at(&self, point: Vec2) -> Threads {
        let scaled = point * self.threads as f32;
        let cell = scaled.floor().as_ivec2();
        let across = scaled - scaled.floor() - 0.5;
        // Each thread climbs from cell to cell as the draft says.
        let level = |cell: IVec2, of_warp: bool| if self.warp_is_on_top(cell) == of_warp { 1.0f32 } else { -1.0 };
        let along = |step: IVec2, at: f32, of_warp: bool| {
            let next = if at < 0.0 { cell - step } else { cell + step };
            let blend = 0.5 - 0.5 * (PI * at.abs()).cos();
            let (here, there) = (level(cell, of_warp), level(next, of_warp));
            0.16 * (here + (there - here) * blend)
        };
        let round = |at: f32| {
            let squared = 1.0 - (2.0 * at / self.width).powi(2);
            if squared > 0.0 { 0.3 * squared.sqrt() } else { -1.0 }
        };
        Threads {
            warp: along(IVec2::Y, across.y, true) + round(across.x),
            weft: along(IVec2::X, across.x, false) + round(across.y),
        }
    }

    /// Normals of the higher threads, with the twist of their plies.
    fn normals(&self, name: &str) -> Image {
        normals(name, |point| {
            let Threads { warp, weft } = self.at(point);
            let scaled = point * self.threads as f32;
            // The plies of warp and weft are twisted the same way round, and so lean in mirrored directions.
            let twist = if warp > weft { scaled.x + scaled.y } else { scaled.x - scaled.y };
            (warp.max(weft).max(-0.3) + 0.012 * (TAU * 3.0 * twist).sin()) / self.threads as f32
        })
    }
}

pub fn plain_weave() -> Image {
    PLAIN.normals("plain_weave")
}

pub fn twill() -> Image {
    TWILL.normals("twill")
}

pub fn satin_weave() -> Image {
    SATIN.normals("satin_weave")
}

/// Where the weft of the plain weave lies on top.
pub fn weft() -> Image {
    grey("weft", |point| {
        let Threads { warp, weft } = PLAIN.at(point);
        0.5 + 4.0 * (weft - warp)
    })
}

/// Threads a third as wide as their distance.
pub fn mesh() -> Image {
    grey("mesh", |point| {
        let from_middle = ((point * 24.0).rem_euclid(Vec2::ONE) - 0.5).abs();
        let wander = 0.02 * octaves(point, IVec2::splat(12), 2);
        0.5 + (0.17 + wander - from_middle.min_element()) * 24.0
    })
}

/// Indigo warp, white weft, and dye that took unevenly.
pub fn denim() -> Image {
    color("denim", |point| {
        let Threads { warp, weft } = TWILL.at(point);
        let uneven = octaves(point, IVec2::new(96, 6), 3);
        let indigo = Vec3::new(0.19, 0.28, 0.45) * (1.0 + 0.45 * uneven);
        let white = Vec3::new(0.66, 0.68, 0.70) * (1.0 + 0.1 * uneven);
        let shade = 0.72 + 0.6 * warp.max(weft).max(0.0);
        shade * if warp > weft { indigo } else { white }
    })
}

/// Rows of loops, each a pair of legs that lean apart.
pub fn knit() -> Image {
    const STITCHES: f32 = 16.0;
    normals("knit", |point| {
        let scaled = point * STITCHES;
        let x = scaled.x.rem_euclid(1.0);
        // The legs of a stitch mirror each other, and each runs on under the next row.
        let from_leg = if x < 0.5 { x - 0.25 } else { 0.75 - x };
        let y = (scaled.y + 1.6 * from_leg).rem_euclid(1.0);
        let across = 1.0 - (from_leg / 0.24).powi(2);
        let along = (PI * y).sin();
        0.22 / STITCHES * (across.max(0.0).sqrt() * (0.55 + 0.45 * along))
    })
}

/// Ribs of pile with fine cuts across.
pub fn corduroy() -> Image {
    const RIBS: f32 = 16.0;
    normals("corduroy", |point| {
        let x = (point.x * RIBS).rem_euclid(1.0) - 0.5;
        let rib = (1.0 - (x / 0.46).powi(2)).max(0.0).sqrt();
        let pile = 0.02 * octaves(point, IVec2::new(64, 32), 2);
        (0.3 * rib + pile) / RIBS
    })
}
