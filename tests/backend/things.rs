//! Small things to draw.

use glam::{Mat4, Vec2, Vec3, Vec4};
use vair::Scene;
use vair::asset::{Asset, AssetScene, Material, Mesh, Node, Primitive, Skin, Vertices, procedural};
use vair::gpu::vk;
use vair::math::orthographic;
use vair::render::{DeviceScene, EnvironmentQuality, FrameDesc, InstanceDesc, Shadows, Target, View};
use vair::scene::EnvironmentLight;

/// How far the eye of [`front`] is from the XY plane, metres.
pub const EYE_M: f32 = 2.0;
/// Half of what [`front`] shows, metres.
pub const HALF_M: f32 = 1.0;

/// Looks along -Z at the square of 2 m around the origin, in parallel rays, from [`EYE_M`]; depth is 1 at 1 m and 0 at 3 m.
pub fn front(size: [u32; 2]) -> View {
    let eye = Mat4::from_translation(Vec3::Z * EYE_M);
    View::new(eye.inverse(), orthographic(HALF_M, HALF_M, 1.0, 3.0), size)
}

/// Linear half floats at one sample, cheap to compare.
pub fn plain_target() -> Target {
    Target::hdr(1)
}

/// A frame of those views without shadows.
pub fn frame<'a>(target: Target, views: &'a [View]) -> FrameDesc<'a> {
    let shadows = Shadows { are_cast: false, ..Shadows::default() };
    FrameDesc { views, target, shadows, ..FrameDesc::default() }
}

/// A scene of these meshes, each of its own material, lit evenly; nothing is placed.
pub fn scene(things: Vec<(Primitive, Material)>) -> DeviceScene {
    evenly_lit(DeviceScene::new(Scene::from_asset(asset(things)).unwrap_or_else(|error| panic!("{error}"))))
}

/// The same, and each mesh stands at the origin.
pub fn placed(things: Vec<(Primitive, Material)>) -> DeviceScene {
    let count = things.len();
    let mut scene = scene(things);
    for mesh in 0..count {
        scene.add(&InstanceDesc { mesh, ..InstanceDesc::default() }).unwrap_or_else(|error| panic!("{error}"));
    }
    scene
}

/// Light from everywhere, which takes no time to prepare.
pub fn evenly_lit(mut scene: DeviceScene) -> DeviceScene {
    let light = EnvironmentLight::constant(Vec3::splat(0.5));
    scene.set_environment(light, EnvironmentQuality::default()).unwrap_or_else(|error| panic!("{error}"));
    scene
}

fn asset(things: Vec<(Primitive, Material)>) -> Asset {
    let mut asset = Asset { scenes: vec![AssetScene::default()], ..Asset::default() };
    for (index, (primitive, material)) in things.into_iter().enumerate() {
        let primitives = vec![Primitive { material: index, ..primitive }];
        asset.meshes.push(Mesh { primitives, ..Mesh::default() });
        asset.materials.push(material);
    }
    asset
}

/// Shows its colour without light.
pub fn unlit(color: [f32; 3]) -> Material {
    Material { base_color: Vec3::from(color).extend(1.0), unlit: true, metallic: 0.0, ..Material::default() }
}

/// A dull surface.
pub fn dull() -> Material {
    Material { base_color: Vec4::new(0.8, 0.8, 0.8, 1.0), metallic: 0.0, ..Material::default() }
}

/// What a preset makes.
pub fn preset(name: &str) -> Material {
    let keys = [("preset".to_owned(), serde_json::Value::from(name))];
    Material { vair: Some(keys.into_iter().collect()), ..dull() }
}

/// A rectangle that faces +Z.
pub fn quad(from: Vec2, to: Vec2, z: f32) -> Primitive {
    let corners = [from, Vec2::new(to.x, from.y), to, Vec2::new(from.x, to.y)];
    let vertices = Vertices {
        positions: corners.iter().map(|corner| corner.extend(z)).collect(),
        normals: vec![Vec3::Z; 4],
        uv_sets: vec![corners.to_vec()],
        ..Vertices::default()
    };
    Primitive { indices: vec![0, 1, 2, 0, 2, 3], vertices, ..Primitive::default() }
}

/// A furred capsule of two joints, with nothing placed.
pub fn furred() -> DeviceScene {
    let mut capsule = procedural::capsule(0.25, 0.3, 12, 12);
    let upper = capsule.vertices.positions.iter().map(|position| (position.y + 0.5).clamp(0.0, 1.0));
    capsule.vertices.joints = upper.flat_map(|upper| [(0, 1.0 - upper), (1, upper), (0, 0.0), (0, 0.0)]).collect();
    capsule.vertices.influences_per_vertex = 4;
    let mut asset = asset(vec![(capsule, preset("fox"))]);
    asset.nodes = vec![Node::default(), Node::default()];
    asset.skins = vec![Skin { joints: vec![0, 1], inverse_bind: vec![Mat4::IDENTITY; 2] }];
    evenly_lit(DeviceScene::new(Scene::from_asset(asset).unwrap_or_else(|error| panic!("{error}"))))
}

/// An instance of it.
pub const SKINNED: InstanceDesc =
    InstanceDesc { mesh: 0, skin: Some(0), world_from_object: Mat4::IDENTITY, variant: None };

/// Pixels of a picture, as a rectangle.
pub fn rect(offset: [i32; 2], extent: [u32; 2]) -> vk::Rect2D {
    let ([x, y], [width, height]) = (offset, extent);
    vk::Rect2D { offset: vk::Offset2D { x, y }, extent: vk::Extent2D { width, height } }
}
