//! Cloth that hangs over a ball.

use super::mesh::{SurfacePoint, grid};
use crate::asset::Primitive;
use glam::{Vec2, Vec3};

/// A square cloth over a ball of `radius_m` that stands on the floor, y = 0: it follows the ball's upper part and falls in
/// eight folds, uneven as folds are. uv is one unit square of the flat cloth; the front is outside.
pub fn drape(radius_m: f32, half_size_m: f32, segments: u32) -> Primitive {
    let at = |flat: Vec2| hang(flat / radius_m) * radius_m;
    grid([segments; 2], Vec2::ONE, |u, v| {
        let flat = Vec2::new(2.0 * u - 1.0, 1.0 - 2.0 * v) * half_size_m;
        let step = half_size_m * 1e-3;
        let along = |way: Vec2| at(flat + way * step) - at(flat - way * step);
        let (along_x, along_z) = (along(Vec2::X), along(Vec2::Y));
        SurfacePoint { position: at(flat), normal: along_z.cross(along_x), along_u: along_x }
    })
}

/// Where a point of the flat cloth hangs, for a ball of radius 1.
fn hang(flat: Vec2) -> Vec3 {
    /// The angle from the top at which the cloth leaves the ball.
    const LEAVES: f32 = 1.25;
    /// How far it takes to turn straight down.
    const TURN: f32 = 0.5;
    let from_top = flat.length();
    if from_top < 1e-6 {
        return Vec3::Y * 2.0;
    }
    let way = flat / from_top;
    let on_ball = from_top.min(LEAVES);
    let (mut out, mut up) = (on_ball.sin(), 1.0 + on_ball.cos());
    let hangs = from_top - on_ball;
    // From the ball's tangent into the vertical, without a kink.
    let turned = TURN * (1.0 - (-hangs / TURN).exp());
    out += LEAVES.cos() * turned;
    up -= hangs - (1.0 - LEAVES.sin()) * turned;
    // What the flat cloth is too wide for its fall goes into folds.
    let angle = flat.y.atan2(flat.x);
    let fold = 0.5 + 0.5 * (8.0 * angle + 0.5 * (3.0 * angle + 1.0).sin()).cos();
    out += 0.62 * hangs * (1.0 - (-hangs / 0.35).exp()) * fold * fold * (3.0 - 2.0 * fold);
    let beside = way * out;
    Vec3::new(beside.x, up.max(0.0), beside.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_lies_on_the_ball_faces_outwards_and_stays_above_the_floor() {
        let cloth = drape(0.2, 0.4, 60);
        let mut touching = 0;
        for (position, normal) in cloth.vertices.positions.iter().zip(&cloth.vertices.normals) {
            let from_middle = *position - Vec3::Y * 0.2;
            assert!(position.y >= 0.0 && from_middle.length() > 0.2 - 1e-5, "{position}");
            touching += usize::from(from_middle.length() < 0.2 + 1e-5);
            assert!((normal.length() - 1.0).abs() < 1e-4);
            assert!(position.y < 0.3 || normal.dot(from_middle) > 0.0, "{position} {normal}");
        }
        assert!(touching > 300, "{touching}");
    }
}
