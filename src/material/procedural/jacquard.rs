//! Damask: a figure of flowers and leaves on a ground.

use super::noise::octaves;
use super::{color, edge, grey};
use crate::asset::Image;
use glam::{IVec2, Vec2, Vec3};

/// Width of the figure's soft rims, in tiles.
const RIM: f32 = 0.006;

/// Two staggered flowers of eight petals with a ring of leaves, 1 in the figure.
pub fn jacquard() -> Image {
    grey("jacquard", figure)
}

/// Gold in the figure, crimson in the ground.
pub fn brocade() -> Image {
    let (ground, gold) = (Vec3::new(0.36, 0.04, 0.06), Vec3::new(0.95, 0.78, 0.40));
    color("brocade", |point| ground.lerp(gold, figure(point)))
}

/// Roughness in G, metal in B: thread of gold in the figure, silk in the ground.
pub fn brocade_metal() -> Image {
    let (ground, gold) = (Vec3::new(1.0, 0.75, 0.0), Vec3::new(1.0, 0.5, 1.0));
    color("brocade_metal", |point| ground.lerp(gold, figure(point)))
}

fn figure(point: Vec2) -> f32 {
    let flower = |middle: Vec2| {
        // The nearest of its copies in the neighbouring tiles.
        let offset = (point - middle + 0.5).rem_euclid(Vec2::ONE) - 0.5;
        let (radius, angle) = (offset.length(), offset.y.atan2(offset.x));
        let petals = 0.13 + 0.05 * (8.0 * angle).cos();
        let heart = edge(RIM, 0.035 - radius);
        let leaf = 0.255 + 0.055 * (4.0 * angle).cos() + 0.018 * (12.0 * angle).cos();
        let leaves = edge(RIM, 0.02 - (radius - leaf).abs()).max(edge(RIM, 0.012 - (radius - leaf - 0.05).abs()));
        (edge(RIM, petals - radius) - edge(RIM, 0.006 - (radius - 0.07).abs())).max(heart).max(leaves)
    };
    let uneven = 0.03 * octaves(point, IVec2::splat(64), 2);
    flower(Vec2::splat(0.25)).max(flower(Vec2::splat(0.75))) * 0.94 + 0.03 + uneven
}
