//! A sample of one material, as a tailor shows it.

use super::Set;
use super::drape::drape;
use super::gallery::surface;
use super::mesh::{backdrop, sphere};
use crate::asset::{Asset, LightKind, Projection};
use glam::{Quat, Vec3};
use std::f32::consts::PI;

/// Name of the material to dress.
pub const SWATCH_MATERIAL: &str = "swatch";

/// Name of the camera that frames it in a square.
pub const SWATCH_CAMERA: &str = "front";

/// A ball on paper, 0.4 m wide, with the material `swatch` on it; or, where it is `draped`, on a cloth that hangs over a
/// ball of stone, which sheer cloth lets through. Key, rim and fill light; the camera frames it in a square.
pub fn swatch(draped: bool) -> Asset {
    const RADIUS_M: f32 = 0.2;
    let mut set = Set::default();
    let paper = set.material(surface("paper", [0.32, 0.31, 0.30], 0.0, 0.9));
    // Fur without a colour of their own show the surface's.
    let color = if draped { [0.5; 3] } else { [0.55, 0.26, 0.09] };
    let sample = set.material(surface(SWATCH_MATERIAL, color, 0.0, 0.6));
    set.object("paper", backdrop(4.0, 2.6, 1.6, 2.6, 1.0), paper, Vec3::ZERO, Quat::IDENTITY);
    if draped {
        let stone = set.material(surface("stone", [0.10, 0.045, 0.03], 0.0, 0.35));
        set.object("cloth", drape(RADIUS_M, 0.37, 160), sample, Vec3::ZERO, Quat::from_rotation_y(0.42));
        set.object("stone", sphere(RADIUS_M * 0.98, 24), stone, Vec3::Y * RADIUS_M, Quat::IDENTITY);
    } else {
        set.object("ball", sphere(RADIUS_M, 24), sample, Vec3::Y * RADIUS_M * 1.03, Quat::from_rotation_y(0.42));
    }
    let target = Vec3::Y * 0.2;
    let key = LightKind::Directional;
    set.light("key light", key, [1.0, 0.97, 0.92], 1.1 * PI, Vec3::new(-1.6, 1.7, 1.3), Vec3::ZERO);
    let rim = LightKind::Spot { range_m: None, inner_angle: 0.4, outer_angle: 0.8 };
    set.light("rim light", rim, [0.85, 0.92, 1.0], 7.0, Vec3::new(1.2, 1.1, -1.1), target);
    let fill = LightKind::Point { range_m: None };
    set.light("fill light", fill, [1.0, 0.9, 0.8], 1.2, Vec3::new(1.3, 0.6, 1.3), target);
    let projection =
        Projection::Perspective { vertical_fov: 22f32.to_radians(), aspect: None, near_m: 0.05, far_m: None };
    set.camera(SWATCH_CAMERA, projection, Vec3::new(0.0, 0.66, 1.86), Vec3::Y * if draped { 0.17 } else { 0.2 });
    set.asset("swatch")
}
