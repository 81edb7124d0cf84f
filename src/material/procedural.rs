//! Images that presets make by formula, so that nothing has to be shipped. All tile.

use super::reference::hash::pcg3d;
use crate::asset::Image;
use glam::Vec2;
use std::f32::consts::TAU;

/// Names of the images.
pub const NAMES: [&str; 1] = ["leopard"];

/// The image of that name; `None` if there is none.
pub fn image(name: &str) -> Option<Image> {
    match name {
        "leopard" => Some(leopard()),
        _ => None,
    }
}

/// Pixels of each side.
const SIZE: u32 = 512;
/// Rosettes along each side of the tile.
const CELLS: i32 = 4;

/// Coat of a leopard: broken rings of dark spots with a warmer heart, as weights in R (1 = spot).
///
/// One rosette per cell of a jittered grid (Worley 1996, "A Cellular Texture Basis Function"); the ring's radius wobbles
/// with the angle and gaps open in it.
fn leopard() -> Image {
    let mut rgba = Vec::with_capacity((SIZE * SIZE * 4) as usize);
    for y in 0..SIZE {
        for x in 0..SIZE {
            let point = (Vec2::new(x as f32, y as f32) + 0.5) * (CELLS as f32 / SIZE as f32);
            let weight = rosettes(point).clamp(0.0, 1.0);
            let value = (weight * 255.0 + 0.5) as u8;
            rgba.extend([value, value, value, 255]);
        }
    }
    Image { name: "procedural leopard".to_owned(), width: SIZE, height: SIZE, rgba }
}

/// Strongest rosette at a point, in units of cells.
fn rosettes(point: Vec2) -> f32 {
    let cell = point.floor();
    let mut weight = 0.0f32;
    for dy in -1..=1 {
        for dx in -1..=1 {
            let (i, j) = (cell.x as i32 + dx, cell.y as i32 + dy);
            let random = |n: u32| {
                let [bits, ..] = pcg3d([i.rem_euclid(CELLS) as u32, j.rem_euclid(CELLS) as u32, n]);
                (bits >> 8) as f32 / (1u32 << 24) as f32
            };
            let centre = Vec2::new(i as f32 + 0.3 + 0.4 * random(0), j as f32 + 0.3 + 0.4 * random(1));
            weight = weight.max(rosette(point - centre, &random));
        }
    }
    weight
}

fn rosette(offset: Vec2, random: &dyn Fn(u32) -> f32) -> f32 {
    let angle = offset.y.atan2(offset.x);
    let turn = |n: u32| random(n) * TAU;
    let wobble = 0.16 * (2.0 * angle + turn(2)).sin() + 0.1 * (3.0 * angle + turn(3)).sin();
    let radius = (0.25 + 0.1 * random(4)) * (1.0 + wobble);
    let distance = offset.length();
    // Small rosettes are solid spots; large ones are rings that gaps break up.
    if random(4) < 0.25 {
        return edge(0.62 * radius - distance);
    }
    let breaks = 0.5 + 0.5 * (3.0 * angle + turn(5)).sin() + 0.35 * (5.0 * angle + turn(6)).sin();
    let width = 0.115 * (breaks * 1.6).clamp(0.0, 1.0);
    edge(width - (distance - radius).abs()).max(0.25 * edge(radius - distance))
}

/// 0 to 1 across a soft rim of the spot, `inside` in units of cells.
fn edge(inside: f32) -> f32 {
    let x = (inside / 0.05 + 0.5).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leopard_tiles_and_has_spots() {
        let image = image("leopard").unwrap();
        assert_eq!(image.rgba.len(), (SIZE * SIZE * 4) as usize);
        let at = |x: u32, y: u32| f32::from(image.rgba[((y * SIZE + x) * 4) as usize]) / 255.0;
        let mean = (0..SIZE * SIZE).map(|i| at(i % SIZE, i / SIZE)).sum::<f32>() / (SIZE * SIZE) as f32;
        assert!((0.15..0.5).contains(&mean), "share of spots {mean}");
        // A seam would be a step larger than any inside the picture.
        let step =
            |x: u32, y: u32| (at(x, y) - at((x + 1) % SIZE, y)).abs().max((at(x, y) - at(x, (y + 1) % SIZE)).abs());
        let (mut seam, mut within) = (0.0f32, 0.0f32);
        for i in 0..SIZE {
            seam = seam.max(step(SIZE - 1, i)).max(step(i, SIZE - 1));
            for j in 0..SIZE - 1 {
                within = if i < SIZE - 1 { within.max(step(i, j)) } else { within };
            }
        }
        assert!(seam <= within, "largest step over the seam {seam}, elsewhere {within}");
        assert_eq!(image.rgba, leopard().rgba);
    }
}
