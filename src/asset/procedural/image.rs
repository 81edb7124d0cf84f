//! Images by formula.

use glam::{IVec2, Vec2};

use crate::asset::Image;

/// Squares of two colours: `cells` by `cells` of them over a square picture of `size_px`.
pub fn checker(size_px: u32, cells: u32, colors: [[u8; 4]; 2]) -> Image {
    let cell = |pixel: u32| u64::from(pixel) * u64::from(cells) / u64::from(size_px.max(1));
    image("checker", size_px, |x, y| colors[((cell(x) + cell(y)) % 2) as usize])
}

/// A tileable strand distribution map: one strand in each of `cells` by `cells` cells, jittered, as linear data.
///
/// R is the strand's profile, a cone: 1 on its axis, falling to 0 at `radius_cells` (in cell widths, above 0 and at
/// most 1), the nearest strand wins. G is a number of the strand in [0, 1] (for colour or length variation), B its
/// height in [0.6, 1], A is 255. The same arguments give the same bytes.
pub fn strand_image(size_px: u32, cells: u32, radius_cells: f32, seed: u32) -> Image {
    let cells = cells.max(1) as i32;
    image("strands", size_px, |x, y| {
        let at = (Vec2::new(x as f32, y as f32) + 0.5) * (cells as f32 / size_px as f32);
        let home = at.floor().as_ivec2();
        let (distance, id) = (-1..=1)
            .flat_map(|dy| (-1..=1).map(move |dx| home + IVec2::new(dx, dy)))
            .map(|cell| {
                let id = hash([cell.x.rem_euclid(cells) as u32, cell.y.rem_euclid(cells) as u32, seed]);
                // Jitter within the middle half of the cell keeps the fur even.
                let jitter = Vec2::new(unit(hash([id, 1, 0])), unit(hash([id, 2, 0]))) * 0.5 + 0.25;
                ((cell.as_vec2() + jitter).distance(at), id)
            })
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((f32::INFINITY, 0));
        let profile = (1.0 - distance / radius_cells).clamp(0.0, 1.0);
        [byte(profile), byte(unit(hash([id, 3, 0]))), byte(0.6 + 0.4 * unit(hash([id, 4, 0]))), 255]
    })
}

fn image(name: &str, size_px: u32, pixel: impl Fn(u32, u32) -> [u8; 4]) -> Image {
    let pixel = &pixel;
    let rgba = (0..size_px).flat_map(|y| (0..size_px).flat_map(move |x| pixel(x, y))).collect();
    Image { name: name.to_owned(), width: size_px, height: size_px, rgba }
}

fn byte(value: f32) -> u8 {
    (value * 255.0).round() as u8
}

/// [0, 1).
fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 / (1 << 24) as f32
}

/// Three words to one; each step is the PCG output permutation (Jarzynski & Olano 2020, "Hash Functions for GPU
/// Rendering").
fn hash(words: [u32; 3]) -> u32 {
    words.into_iter().fold(0, |state, word| {
        let state = (state ^ word).wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let mixed = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
        (mixed >> 22) ^ mixed
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn red(image: &Image, x: u32, y: u32) -> u8 {
        image.rgba[((y * image.width + x) * 4) as usize]
    }

    #[test]
    fn a_checker_alternates() {
        let image = checker(8, 4, [[255, 0, 0, 255], [0, 0, 255, 255]]);
        assert_eq!(image.rgba.len(), 8 * 8 * 4);
        let row: Vec<u8> = (0..8).map(|x| red(&image, x, 0)).collect();
        assert_eq!(row, [255, 255, 0, 0, 255, 255, 0, 0]);
        assert_eq!(red(&image, 0, 2), 0);
    }

    #[test]
    fn strands_tile_without_a_seam() {
        // A cone falls by 1 / radius a cell, so neighbouring texels differ by little: across the border too.
        let (size, cells, radius) = (128, 8, 0.6);
        let image = strand_image(size, cells, radius, 7);
        let step = 255.0 * cells as f32 / size as f32 / radius + 1.0;
        for i in 0..size {
            for (a, b) in [((size - 1, i), (0, i)), ((i, size - 1), (i, 0))] {
                let difference = red(&image, a.0, a.1).abs_diff(red(&image, b.0, b.1));
                assert!(f32::from(difference) <= step, "{a:?} {b:?}: {difference}");
            }
        }
    }

    #[test]
    fn strands_have_the_coverage_of_their_cones() {
        // With radius r below a quarter cell no two cones touch: the share above a threshold c is pi r^2 (1 - c)^2.
        let image = strand_image(512, 16, 0.25, 1);
        for threshold in [0.0, 0.5] {
            let above =
                image.rgba.chunks_exact(4).filter(|pixel| f32::from(pixel[0]) > threshold * 255.0 + 0.5).count();
            let share = above as f32 / (512.0 * 512.0);
            let expected = std::f32::consts::PI * 0.0625 * (1.0 - threshold) * (1.0 - threshold);
            assert!((share / expected - 1.0).abs() < 0.05, "{threshold}: {share} against {expected}");
        }
    }

    #[test]
    fn equal_seeds_give_equal_bytes() {
        assert_eq!(strand_image(32, 4, 0.5, 3).rgba, strand_image(32, 4, 0.5, 3).rgba);
        assert_ne!(strand_image(32, 4, 0.5, 3).rgba, strand_image(32, 4, 0.5, 4).rgba);
        assert!(strand_image(0, 4, 0.5, 3).rgba.is_empty());
    }
}
