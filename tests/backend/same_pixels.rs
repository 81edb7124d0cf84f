//! The host path and the picture path draw the same.

use crate::host_stage::host_stage;
use crate::things::{dull, preset, quad};
use glam::{Quat, Vec2, Vec3, Vec4};
use vair::Scene;
use vair::asset::{
    AlphaMode, Asset, AssetScene, Camera, Light, LightKind, Material, Mesh, Node, Primitive, Projection, Transform,
    procedural,
};
use vair::gpu::GpuOptions;
use vair::render::{
    Background, DeviceScene, FrameDesc, FrameOptions, FrameSetup, Renderer, Target, Transparency, View,
};
use vair::scene::bounding_sphere;

const SIZE: [u32; 2] = [96, 64];

/// Fur, a plain floor, cloth, two panes that blend, and two lights that cast shadows.
fn mixed() -> Scene {
    let mut asset = Asset::default();
    let mut object = |primitive: Primitive, material: Material, translation: Vec3| {
        asset.materials.push(material);
        let primitives = vec![Primitive { material: asset.materials.len() - 1, ..primitive }];
        asset.meshes.push(Mesh { primitives, ..Mesh::default() });
        let transform = Transform::Trs { translation, rotation: Quat::IDENTITY, scale: Vec3::ONE };
        asset.nodes.push(Node { mesh: Some(asset.meshes.len() - 1), transform, ..Node::default() });
    };
    let pane = |color: Vec4| Material { base_color: color, alpha_mode: AlphaMode::Blend, double_sided: true, ..dull() };
    object(procedural::plane(1.2, 1.2, 1), dull(), Vec3::ZERO);
    object(procedural::sphere(0.25, 10), preset("fox"), Vec3::new(-0.35, 0.3, 0.0));
    object(procedural::sphere(0.25, 10), preset("denim"), Vec3::new(0.35, 0.3, 0.0));
    let upright = || quad(Vec2::new(-0.3, 0.0), Vec2::new(0.3, 0.6), 0.0);
    object(upright(), pane(Vec4::new(0.9, 0.1, 0.1, 0.4)), Vec3::new(0.1, 0.1, 0.4));
    object(upright(), pane(Vec4::new(0.1, 0.9, 0.1, 0.6)), Vec3::new(-0.1, 0.1, 0.5));
    let mut light = |kind, intensity, translation, rotation| {
        asset.lights.push(Light { name: None, color: Vec3::ONE, intensity, kind });
        let transform = Transform::Trs { translation, rotation, scale: Vec3::ONE };
        asset.nodes.push(Node { light: Some(asset.lights.len() - 1), transform, ..Node::default() });
    };
    light(LightKind::Directional, 2.5, Vec3::ZERO, Quat::from_rotation_x(-1.0));
    let spot = LightKind::Spot { range_m: None, inner_angle: 0.3, outer_angle: 0.7 };
    light(spot, 6.0, Vec3::new(0.0, 2.0, 0.2), Quat::from_rotation_x(-1.4));
    let projection = Projection::Perspective { vertical_fov: 0.6, aspect: None, near_m: 0.05, far_m: None };
    asset.cameras.push(Camera { name: None, projection });
    let (translation, rotation) = (Vec3::new(0.0, 0.7, 2.6), Quat::from_rotation_x(-0.18));
    let transform = Transform::Trs { translation, rotation, scale: Vec3::ONE };
    asset.nodes.push(Node { camera: Some(0), transform, ..Node::default() });
    asset.scenes.push(AssetScene { name: None, roots: (0..asset.nodes.len()).collect() });
    Scene::from_asset(asset).unwrap_or_else(|error| panic!("{error}"))
}

fn options(msaa: u32) -> FrameOptions {
    let camera = vair::scene::CameraChoice::Index(0);
    let (background, transparency) = (Background::Transparent, Transparency::Sorted);
    FrameOptions { size: SIZE, msaa, camera, background, transparency, ..FrameOptions::default() }
}

fn host_pixels(samples: u32, options: &FrameOptions) -> Vec<Vec4> {
    let mut pixels = Vec::new();
    host_stage(SIZE, Target::hdr(samples), |stage| {
        let scene = mixed();
        let setup = FrameSetup::new(&scene, options).unwrap_or_else(|error| panic!("{error}"));
        let shadow_bounds = bounding_sphere(&scene.outline(0, None));
        let views = [View::of(&setup.camera, None, SIZE)];
        let mut scene = DeviceScene::new(scene);
        scene.add_nodes(0, None).unwrap_or_else(|error| panic!("{error}"));
        let lights = &setup.staging.lights;
        let desc = FrameDesc { views: &views, target: stage.target, lights, shadow_bounds, ..FrameDesc::default() };
        pixels = stage.draw(&mut scene, &desc);
        // Once more, with everything made: the same.
        assert!(stage.draw(&mut scene, &desc) == pixels);
    });
    pixels
}

fn are_the_same(samples: u32) {
    let options = options(samples);
    let in_host = host_pixels(samples, &options);
    let pipeline_cache_dir = Some(env!("CARGO_TARGET_TMPDIR").into());
    let mut own = Renderer::new(&GpuOptions { pipeline_cache_dir, ..GpuOptions::default() })
        .unwrap_or_else(|error| panic!("{error}"));
    let (picture, _) = own.render_reported(&mixed(), &options, true).unwrap_or_else(|error| panic!("{error}"));
    let differing = picture.radiance.iter().zip(&in_host).filter(|(own, host)| own != host).count();
    let covered = in_host.iter().filter(|pixel| pixel.w > 0.0).count();
    assert!(covered > 2000, "{covered} pixels show something");
    assert_eq!(differing, 0, "of {} pixels differ at {samples} samples", in_host.len());
}

#[test]
fn one_sample_a_pixel_is_the_picture_bit_for_bit() {
    are_the_same(1);
}

#[test]
fn four_samples_a_pixel_are_the_picture_bit_for_bit() {
    are_the_same(4);
}
