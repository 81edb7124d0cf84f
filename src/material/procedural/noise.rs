//! Unevenness: gradient noise that tiles (Perlin 2002, "Improving Noise"), in octaves.

use super::grey;
use crate::asset::Image;
use crate::math::pcg3d;
use glam::{IVec2, Vec2};
use std::f32::consts::TAU;

/// Soft unevenness in four octaves from 8 cells a side.
pub fn cloth_noise() -> Image {
    grey("cloth_noise", |point| 0.5 + 0.75 * octaves(point, IVec2::splat(8), 4))
}

/// The same drawn out along u.
pub fn streaks() -> Image {
    grey("streaks", |point| 0.5 + 0.8 * octaves(point, IVec2::new(3, 64), 3))
}

/// Octaves of noise at a point of the unit square, each of twice the frequency and half the height of the one before;
/// within about [-0.8, 0.8].
pub fn octaves(point: Vec2, cells: IVec2, count: u32) -> f32 {
    (0..count).map(|octave| gradient_noise(point, cells << octave, octave) * 0.5f32.powi(octave as i32)).sum()
}

/// Gradient noise of so many cells a side, within about [-0.7, 0.7].
fn gradient_noise(point: Vec2, cells: IVec2, seed: u32) -> f32 {
    let scaled = point * cells.as_vec2();
    let cell = scaled.floor().as_ivec2();
    let within = scaled - scaled.floor();
    let corner = |x: i32, y: i32| {
        let at = (cell + IVec2::new(x, y)).rem_euclid(cells).as_uvec2();
        let [bits, ..] = pcg3d([at.x, at.y, seed]);
        let gradient = Vec2::from_angle(bits as f32 / 4_294_967_296.0 * TAU);
        gradient.dot(within - Vec2::new(x as f32, y as f32))
    };
    let fade = within * within * within * (within * (within * 6.0 - 15.0) + 10.0);
    let row = |y: i32| corner(0, y) + (corner(1, y) - corner(0, y)) * fade.x;
    row(0) + (row(1) - row(0)) * fade.y
}
