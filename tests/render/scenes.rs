//! Scenes that several checks show.

use crate::stage::{Stage, at, plain};
use glam::{Quat, Vec3, Vec4};
use vair::asset::procedural::{cube, plane, sphere};
use vair::asset::{LightKind, Material, Primitive, Transform};
use vair::material::{Fur, Length};
use vair::scene::Scene;

/// Dielectric balls above, metal balls below, smooth to rough.
pub fn balls() -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(1.0, Vec3::new(0.0, 0.2, 1.0), Vec3::Y);
    for (row, (metallic, color)) in [(0.0, [0.1, 0.3, 0.6]), (1.0, [0.95, 0.64, 0.3])].into_iter().enumerate() {
        for (column, roughness) in [0.15, 0.5, 0.95].into_iter().enumerate() {
            let base_color = Vec3::from(color).extend(1.0);
            let material = stage.material(Material { base_color, metallic, roughness, ..plain() });
            let place = Vec3::new(column as f32 - 1.0, 0.48 - 0.96 * row as f32, 0.0);
            stage.object(sphere(0.42, 12), material, at(place));
        }
    }
    three_lights(&mut stage);
    stage.scene()
}

/// A directional key, a point and a spot.
pub fn three_lights(stage: &mut Stage) {
    let key = Vec3::new(-0.5, 0.7, 0.6).normalize();
    stage.light(LightKind::Directional, Vec3::new(2.4, 2.3, 2.1), Vec3::ZERO, key);
    let warm = Vec3::new(1.6, 1.2, 0.8);
    stage.light(LightKind::Point { range_m: Some(6.0) }, warm, Vec3::new(1.6, 0.2, 1.4), Vec3::Z);
    let spot = LightKind::Spot { range_m: None, inner_angle: 0.2, outer_angle: 0.8 };
    let from = Vec3::new(0.3, 1.9, -1.2);
    stage.light(spot, Vec3::splat(4.0), from, from.normalize());
}

/// Fur as it is by default, on something brown, over a floor.
fn furred(primitive: Primitive, rotation: Quat, fur: Fur) -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(0.75, Vec3::new(0.3, 0.45, 1.0), Vec3::Y);
    let paper = stage.material(Material { base_color: Vec4::new(0.5, 0.5, 0.52, 1.0), ..plain() });
    stage.object(plane(3.0, 3.0, 1), paper, at(Vec3::NEG_Y * 0.62));
    let base_color = Vec4::new(0.45, 0.24, 0.1, 1.0);
    let brown = stage.material(Material { name: Some("fur".into()), base_color, ..plain() });
    stage.object(primitive, brown, Transform::Trs { translation: Vec3::ZERO, rotation, scale: Vec3::ONE });
    three_lights(&mut stage);
    let mut scene = stage.scene();
    scene.materials_mut()[brown].fur = Some(fur);
    scene
}

/// A ball with the default coat.
pub fn fur_ball() -> Scene {
    furred(sphere(0.5, 16), Quat::IDENTITY, Fur::default())
}

/// A hard-edged cube with a long coat of thick strands.
pub fn fur_cube() -> Scene {
    // Strands of several pixels.
    let fur = Fur { length: Length::Relative(0.2), strand_spacing: Length::Relative(0.06), ..Fur::default() };
    furred(cube(0.38), Quat::from_rotation_y(0.5), fur)
}

/// A plain cube under three lights.
pub fn plain_cube() -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(1.0, Vec3::new(0.5, 0.6, 1.0), Vec3::Y);
    let material = stage.material(plain());
    stage.object(cube(0.5), material, at(Vec3::ZERO));
    three_lights(&mut stage);
    stage.scene()
}
