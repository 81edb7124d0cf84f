//! The fur of a leopard.

use super::{edge, grey};
use crate::asset::Image;
use crate::math::pcg3d;
use glam::Vec2;
use std::f32::consts::TAU;

/// Rosettes along each side of the tile.
const CELLS: i32 = 4;
/// Width of the spots' soft rims, in cells.
const RIM: f32 = 0.05;

/// Fur of a leopard: broken rings of dark spots with a warmer heart, as weights in R (1 = spot).
///
/// One rosette per cell of a jittered grid (Worley 1996, "A Cellular Texture Basis Function"); the ring's radius wobbles
/// with the angle and gaps open in it.
pub fn leopard() -> Image {
    grey("leopard", |point| rosettes(point * CELLS as f32))
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
        return edge(RIM, 0.62 * radius - distance);
    }
    let breaks = 0.5 + 0.5 * (3.0 * angle + turn(5)).sin() + 0.35 * (5.0 * angle + turn(6)).sin();
    let width = 0.115 * (breaks * 1.6).clamp(0.0, 1.0);
    edge(RIM, width - (distance - radius).abs()).max(0.25 * edge(RIM, radius - distance))
}

#[cfg(test)]
mod tests {
    use super::super::SIZE;
    use super::*;

    #[test]
    fn a_quarter_to_a_half_is_spots() {
        let image = leopard();
        let sum: f32 = image.rgba.iter().step_by(4).map(|&value| f32::from(value) / 255.0).sum();
        let mean = sum / (SIZE * SIZE) as f32;
        assert!((0.15..0.5).contains(&mean), "share of spots {mean}");
    }
}
