//! Rows in, an environment out: repaired, and no larger than is kept.

use super::super::AssetError;
use super::super::context::Context;
use super::super::image::MAX_IMAGE_SIDE_PX;
use super::{MAX_ENVIRONMENT_SIZE, MAX_RADIANCE};
use std::f64::consts::PI;

/// A piece of one source row or column that falls into one kept row or column.
#[derive(Debug, Clone, Copy)]
struct Share {
    /// Index of the kept one.
    kept: usize,
    /// Of the kept one.
    share: f32,
}

/// The picture so far: a box filter over solid angle, which meets pieces of the source in any order.
pub(super) struct Reduction {
    columns: Vec<Vec<Share>>,
    rows: Vec<Vec<Share>>,
    size: [usize; 2],
    texels: Vec<[f32; 3]>,
    not_numbers: u64,
    negative: u64,
    too_bright: u64,
}

impl Reduction {
    /// For a source of so many columns and rows; counts its own memory before it takes it. `row_bytes` is what the
    /// decoder holds for a moment.
    pub(super) fn new(context: &Context, source: [u64; 2], decoder_bytes: u64) -> Result<Self, AssetError> {
        let [width, height] = source;
        if source.iter().any(|side| !(1..=u64::from(MAX_IMAGE_SIDE_PX)).contains(side)) {
            let problem = format!("the picture is {width} x {height}; sides must be 1 to {MAX_IMAGE_SIDE_PX}");
            return Err(context.error("size", problem));
        }
        if width != 2 * height && source != [1, 1] {
            let problem = format!("{width} x {height} is not twice as wide as high; it is stretched over the sphere");
            context.warn("size", problem);
        }
        let factor = source.iter().zip(MAX_ENVIRONMENT_SIZE).map(|(side, most)| *side as f64 / f64::from(most));
        let factor = factor.fold(1.0, f64::max);
        let size = [width, height].map(|side| ((side as f64 / factor).round() as usize).max(1));
        let share_bytes = (width + height) * size_of::<(Vec<Share>, [Share; 4])>() as u64;
        context.check("size", decoder_bytes.saturating_add(share_bytes))?;
        context.spend("size", (size[0] * size[1] * size_of::<[f32; 3]>()) as u64)?;
        Ok(Self {
            columns: shares(width as usize, size[0], |column| column),
            // The solid angle above a row is as 1 - cos of its angle from the top.
            rows: shares(height as usize, size[1], |row| -(PI * row / size[1] as f64).cos()),
            size,
            texels: vec![[0.0; 3]; size[0] * size[1]],
            not_numbers: 0,
            negative: 0,
            too_bright: 0,
        })
    }

    /// Adds a piece of the source's row `y` from column `x` on; what lies outside the source is left out.
    pub(super) fn add(&mut self, x: usize, y: usize, piece: &[[f32; 3]]) {
        for (column, texel) in piece.iter().enumerate() {
            let texel = texel.map(|radiance| self.repaired(radiance));
            let (Some(rows), Some(columns)) = (self.rows.get(y), self.columns.get(x + column)) else { return };
            for row in rows {
                for column in columns {
                    let sum = &mut self.texels[row.kept * self.size[0] + column.kept];
                    let share = row.share * column.share;
                    sum.iter_mut().zip(texel).for_each(|(sum, radiance)| *sum += share * radiance);
                }
            }
        }
    }

    fn repaired(&mut self, radiance: f32) -> f32 {
        if radiance.is_nan() {
            self.not_numbers += 1;
            0.0
        } else if radiance < 0.0 {
            self.negative += 1;
            0.0
        } else if radiance > MAX_RADIANCE {
            self.too_bright += 1;
            MAX_RADIANCE
        } else {
            radiance
        }
    }

    /// Size and texels; what was repaired becomes one warning.
    pub(super) fn finish(self, context: &Context) -> ([u32; 2], Vec<[f32; 3]>) {
        let Self { not_numbers, negative, too_bright, .. } = self;
        if not_numbers + negative + too_bright > 0 {
            let problem = format!(
                "{not_numbers} channels are no number and {negative} negative (now 0), {too_bright} above {MAX_RADIANCE:e} (now that)"
            );
            context.warn("texels", problem);
        }
        let sums = self.texels.into_iter().map(|texel| texel.map(|radiance| radiance.min(MAX_RADIANCE)));
        (self.size.map(|side| side as u32), sums.collect())
    }
}

/// Of each of `source` rows or columns: which of the `kept` it falls into, and its share of them. `measure` is the
/// extent up to a place that is counted in kept ones.
fn shares(source: usize, kept: usize, measure: impl Fn(f64) -> f64) -> Vec<Vec<Share>> {
    let ratio = kept as f64 / source as f64;
    let extent = |from: f64, to: f64| measure(to) - measure(from);
    let one = |index: usize| {
        let (start, end) = (index as f64 * ratio, ((index + 1) as f64 * ratio).min(kept as f64));
        let within = |target: usize| {
            let (from, to) = (start.max(target as f64), end.min((target + 1) as f64));
            let share = extent(from, to) / extent(target as f64, (target + 1) as f64);
            (to > from).then_some(Share { kept: target, share: share as f32 })
        };
        (start as usize..(end.ceil() as usize).min(kept)).filter_map(within).collect()
    };
    (0..source).map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_a_kept_one_add_up_to_it() {
        for (source, kept) in [(1, 1), (7, 7), (7, 3), (16_384, 2048), (5, 2)] {
            let mut sums = vec![0.0; kept];
            for share in shares(source, kept, |row| -(PI * row / kept as f64).cos()).iter().flatten() {
                sums[share.kept] += share.share;
            }
            assert!(sums.iter().all(|sum| (sum - 1.0).abs() < 1e-5), "{source} to {kept}: {sums:?}");
        }
        assert!(shares(9, 9, |row| row.sqrt()).iter().all(|one| one.len() == 1 && one[0].share == 1.0));
    }
}
