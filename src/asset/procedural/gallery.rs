//! The embedded gallery, and tiny scenes for checks.

use std::f32::consts::{FRAC_PI_2, PI};

use glam::{Quat, Vec3, Vec4};
use serde_json::json;

use super::Set;
use super::mesh::{backdrop, capsule, cube, rounded_cube, sphere, torus, torus_knot};
use crate::asset::{Asset, LightKind, Material, Primitive, Projection, Vertices};

/// Name of the gallery's camera: its composition is made for this view at 16:9.
pub const GALLERY_CAMERA: &str = "hero";

/// What the program shows without a file: a photographer's table with furs around a furred knot, and a metal and a
/// ceramic ball to compare them with. About a metre wide; the front is +Z.
///
/// The material "fur" (fox, on the knot) is the one that timings are quoted for.
pub fn gallery() -> Asset {
    let mut set = Set::default();
    let paper = set.material(surface("backdrop", [0.24, 0.228, 0.216], 0.0, 0.9));
    let stone = set.material(surface("plinth", [0.13, 0.125, 0.125], 0.0, 0.55));
    let copper = set.material(surface("copper", [0.955, 0.638, 0.538], 1.0, 0.32));
    let ceramic = set.material(surface("ceramic", [0.07, 0.20, 0.24], 0.0, 0.28));
    let fox = set.material(fur("fur", [0.62, 0.27, 0.075], "fox"));
    let leopard = set.material(fur("fur leopard", [1.0; 3], "leopard"));
    let mink = set.material(fur("fur mink", [1.0; 3], "mink"));
    let plush = set.material(fur("fur plush", [0.80, 0.72, 0.62], "plush toy"));

    set.object("backdrop", backdrop(3.0, 2.2, 1.3, 2.4, 0.9), paper, Vec3::ZERO, Quat::IDENTITY);
    set.object("plinth", rounded_cube(0.17, 0.012, 12), stone, Vec3::new(0.0, -0.06, -0.02), turned(0.35));
    set.object("knot", torus_knot(0.125, 0.05, 0.044, 224, 24), fox, Vec3::new(0.0, 0.35, -0.02), tilted(0.25, -0.12));
    set.object("leopard ball", sphere(0.12, 20), leopard, Vec3::new(-0.40, 0.14, 0.10), tilted(0.5, 0.2));
    set.object("plush block", rounded_cube(0.085, 0.04, 12), plush, Vec3::new(0.33, 0.10, 0.20), turned(0.6));
    set.object("mink roll", capsule(0.06, 0.09, 36, 32), mink, Vec3::new(0.52, 0.085, -0.04), lying(0.35));
    set.object("mink ring", torus(0.085, 0.036, 64, 24), mink, Vec3::new(-0.17, 0.06, 0.40), tilted(0.3, 0.0));
    set.object("copper ball", sphere(0.06, 32), copper, Vec3::new(0.10, 0.06, 0.44), Quat::IDENTITY);
    set.object("ceramic ball", sphere(0.042, 28), ceramic, Vec3::new(-0.45, 0.042, 0.36), Quat::IDENTITY);

    // Key from the upper left, a cool rim from behind that draws the hair tips, a weak warm fill from the right.
    let key = LightKind::Directional;
    set.light("key light", key, [1.0, 0.96, 0.9], 1.25 * PI, Vec3::new(-1.2, 1.9, 1.4), Vec3::new(0.0, 0.2, 0.0));
    let rim = LightKind::Spot { range_m: None, inner_angle: 0.35, outer_angle: 0.7 };
    set.light("rim light", rim, [0.8, 0.9, 1.0], 8.0, Vec3::new(0.9, 1.35, -1.0), Vec3::new(0.0, 0.25, 0.0));
    let fill = LightKind::Point { range_m: None };
    set.light("fill light", fill, [1.0, 0.88, 0.75], 1.4, Vec3::new(1.3, 0.7, 1.1), Vec3::ZERO);

    let projection =
        Projection::Perspective { vertical_fov: 28f32.to_radians(), aspect: None, near_m: 0.05, far_m: None };
    set.camera(GALLERY_CAMERA, projection, Vec3::new(0.10, 0.52, 1.75), Vec3::new(0.02, 0.245, 0.0));
    set.asset("gallery")
}

/// A unit square in the XY plane, facing +Z, that exactly fills a square picture of the orthographic camera "front",
/// under one directional light of pi lux that shines straight onto it: a white Lambert surface then reflects a radiance
/// of 1.
pub fn lit_quad(material: Material) -> Asset {
    let mut set = Set::default();
    let material = set.material(material);
    // The front face of a unit cube, moved back into the plane.
    let face = cube(0.5);
    let front: Vec<usize> = (0..24).filter(|&i| face.vertices.normals[i] == Vec3::Z).collect();
    let vertices = Vertices {
        positions: front.iter().map(|&i| face.vertices.positions[i].with_z(0.0)).collect(),
        normals: vec![Vec3::Z; 4],
        tangents: vec![Vec4::new(1.0, 0.0, 0.0, 1.0); 4],
        uv_sets: vec![front.iter().map(|&i| face.vertices.uv_sets[0][i]).collect()],
        ..Vertices::default()
    };
    let quad = Primitive { indices: vec![0, 1, 3, 0, 3, 2], vertices, ..Primitive::default() };
    set.object("quad", quad, material, Vec3::ZERO, Quat::IDENTITY);
    set.light("light", LightKind::Directional, [1.0; 3], PI, Vec3::Z, Vec3::ZERO);
    let projection = Projection::Orthographic { half_width_m: 0.5, half_height_m: 0.5, near_m: 0.5, far_m: 2.0 };
    set.camera("front", projection, Vec3::Z, Vec3::ZERO);
    set.asset("lit quad")
}

fn turned(angle: f32) -> Quat {
    Quat::from_rotation_y(angle)
}

/// Turned around Y, then leaning back.
fn tilted(angle: f32, lean: f32) -> Quat {
    Quat::from_rotation_x(lean) * Quat::from_rotation_y(angle)
}

/// Lying on the floor, turned around Y.
fn lying(angle: f32) -> Quat {
    Quat::from_rotation_y(angle) * Quat::from_rotation_z(FRAC_PI_2)
}

pub(super) fn surface(name: &str, linear_color: [f32; 3], metallic: f32, roughness: f32) -> Material {
    let base_color = Vec3::from(linear_color).extend(1.0);
    Material { name: Some(name.to_owned()), base_color, metallic, roughness, ..Material::default() }
}

fn fur(name: &str, color: [f32; 3], preset: &str) -> Material {
    let vair = Some(serde_json::Map::from_iter([("preset".to_owned(), json!(preset))]));
    Material { vair, ..surface(name, color, 0.0, 0.8) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_fur_is_named_for_timings() {
        let gallery = gallery();
        let mut names: Vec<&str> = gallery.nodes.iter().filter_map(|node| node.name.as_deref()).collect();
        assert_eq!(names.len(), gallery.nodes.len());
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), gallery.nodes.len());
        let fur = gallery.materials.iter().find(|material| material.name.as_deref() == Some("fur")).expect("fur");
        assert_eq!(fur.vair.as_ref().and_then(|keys| keys.get("preset")), Some(&json!("fox")));
    }

    #[test]
    fn every_material_is_used_and_every_index_is_inside() {
        for asset in [gallery(), lit_quad(Material::default())] {
            let primitives: Vec<&Primitive> = asset.meshes.iter().flat_map(|mesh| &mesh.primitives).collect();
            for material in 0..asset.materials.len() {
                assert!(primitives.iter().any(|primitive| primitive.material == material));
            }
            for primitive in primitives {
                assert!(primitive.material < asset.materials.len() && primitive.indices.len() % 3 == 0);
                assert!(primitive.indices.iter().all(|&i| (i as usize) < primitive.vertices.positions.len()));
                assert!(primitive.vertices.positions.iter().all(|position| position.is_finite()));
            }
        }
    }

    #[test]
    fn the_quad_is_a_square_that_faces_the_light() {
        let asset = lit_quad(Material::default());
        let quad = &asset.meshes[0].primitives[0];
        let at = |i: usize| quad.vertices.positions[quad.indices[i] as usize];
        for triangle in [0, 3] {
            let normal = (at(triangle + 1) - at(triangle)).cross(at(triangle + 2) - at(triangle));
            assert!((normal - Vec3::Z).length() < 1e-6);
        }
        for (position, uv) in quad.vertices.positions.iter().zip(&quad.vertices.uv_sets[0]) {
            assert_eq!((uv.x - 0.5, 0.5 - uv.y), (position.x, position.y));
        }
    }
}
