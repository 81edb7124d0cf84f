//! Shadows lie where geometry says, are as dark as what casts them, and cost nothing where no light needs them.

use crate::headless::{Headless, headless};
use crate::stage::{NEAREST, Stage, at, camera_axes, options as unshadowed, plain, quad};
use glam::{Mat3, Vec3, Vec4Swizzles};
use vair::asset::procedural::sphere;
use vair::asset::{AlphaMode, LightKind, Material, Transform};
use vair::material::{Family, Fur, Gauze, Length};
use vair::measure::twin::shadow::normal_step;
use vair::render::{FrameOptions, FrameSetup, Pass, Picture, Shadows};
use vair::scene::{Light, Scene};

const SIZE: [u32; 2] = [128, 128];
/// What the camera shows above and below the origin, metres.
const HALF_M: f32 = 1.0;

fn options(size: [u32; 2], msaa: u32) -> FrameOptions {
    FrameOptions { shadows: Shadows::default(), ..unshadowed(size, msaa) }
}

/// A white floor in the XY plane under one directional light, seen along `backwards`.
fn floor(backwards: Vec3, to_light: Vec3) -> Stage {
    let mut stage = Stage::default();
    stage.parallel_camera(HALF_M, backwards, Vec3::Y);
    stage.light(LightKind::Directional, Vec3::splat(3.0), Vec3::ZERO, to_light.normalize());
    let white = stage.material(Material { roughness: 1.0, ..plain() });
    stage.object(quad(1.5, 1.5), white, at(Vec3::ZERO));
    stage
}

/// The middle of a pixel on the plane z = 0, for a camera along `backwards`.
fn on_floor(backwards: Vec3, pixel: [u32; 2]) -> Vec3 {
    let axes: Mat3 = camera_axes(backwards, Vec3::Y);
    let [x, y] = [0, 1].map(|axis| (pixel[axis] as f32 + 0.5) / SIZE[axis] as f32 * 2.0 - 1.0);
    let start = axes * Vec3::new(x * HALF_M, -y * HALF_M, 0.0);
    start - axes.z_axis * (start.z / axes.z_axis.z)
}

/// The pixel in which a place on the floor is seen.
fn pixel_of(backwards: Vec3, place: Vec3) -> [u32; 2] {
    let seen = camera_axes(backwards, Vec3::Y).transpose() * place / HALF_M;
    [seen.x, -seen.y].map(|share| ((0.5 + 0.5 * share) * SIZE[0] as f32) as u32)
}

/// The frame, and the same without shadows.
fn both(device: &mut Headless, scene: &Scene, frame: &FrameOptions) -> [Picture; 2] {
    let without = Shadows { are_cast: false, ..frame.shadows };
    [frame, &FrameOptions { shadows: without, ..frame.clone() }].map(|frame| device.picture(scene, frame))
}

/// Share of the light, by channel, that reaches a pixel; `dark` is the same frame without any light.
fn share([shadowed, lit, dark]: [&Picture; 3], pixel: [u32; 2]) -> Vec3 {
    let at = |picture: &Picture| picture.radiance(pixel[0], pixel[1]).xyz();
    (at(shadowed) - at(dark)) / (at(lit) - at(dark))
}

/// Shares of the light at places of the floor.
fn shares(scene: &Scene, unlit: &Scene, backwards: Vec3, places: &[Vec3]) -> Vec<Vec3> {
    let mut found = Vec::new();
    headless(|device| {
        let [shadowed, lit] = both(device, scene, &options(SIZE, 1));
        let dark = device.picture(unlit, &options(SIZE, 1));
        found = places.iter().map(|&place| share([&shadowed, &lit, &dark], pixel_of(backwards, place))).collect();
    });
    found
}

/// The scene with its lights put out.
fn unlit(stage: &Stage) -> Scene {
    let mut asset = stage.asset.clone();
    asset.lights.iter_mut().for_each(|light| light.intensity = 0.0);
    Stage { asset }.scene()
}

#[test]
fn a_balls_shadow_on_a_floor_lies_where_geometry_says() {
    let (center, radius, to_light) = (Vec3::new(0.35, 0.1, 0.5), 0.2, Vec3::new(0.6, -0.2, 0.8).normalize());
    let mut stage = floor(Vec3::Z, to_light);
    let material = stage.material(plain());
    stage.object(sphere(radius, 48), material, at(center));
    let dark = unlit(&stage);
    let scene = stage.scene();
    headless(|device| {
        for (resolution_px, filter_px) in [(512, 1), (1024, 2), (2048, 3)] {
            let shadows = Shadows { resolution_px, filter_px, ..Shadows::default() };
            let frame = FrameOptions { shadows, ..options(SIZE, 1) };
            let map =
                FrameSetup::new(&scene, &frame).unwrap_or_else(|error| panic!("{error}")).staging.shadow_maps.maps[0];
            let [shadowed, lit] = both(device, &scene, &frame);
            let dark = device.picture(&dark, &frame);
            let (mut inside, mut outside) = (0, 0);
            for index in 0..SIZE[0] * SIZE[1] {
                let pixel = [index % SIZE[0], index / SIZE[0]];
                let place = on_floor(Vec3::Z, pixel);
                // What the ball itself hides.
                if (place - center).truncate().length() < radius + 0.02 {
                    continue;
                }
                // Where the receiver is looked up; it steps aside by less than what the filter reads.
                let cosine = f64::from(to_light.z);
                let texel_m = f64::from(map.texel_m);
                let reach_m = std::f64::consts::SQRT_2 * f64::from(filter_px) * texel_m;
                let aside_m = normal_step(reach_m, cosine) + 0.5 * texel_m;
                assert!(aside_m < reach_m + texel_m);
                let to_center = center - place - Vec3::Z * aside_m as f32;
                let across_m = (to_center - to_center.dot(to_light) * to_light).length();
                let passed = share([&shadowed, &lit, &dark], pixel).x;
                let beyond_px = (across_m - radius) / map.texel_m;
                let what =
                    format!("{resolution_px} {filter_px}: {place}, {beyond_px} texels beyond the edge: {passed}");
                // Half a texel for the map's grid, half for the facets of the ball and for half floats.
                match beyond_px {
                    beyond if beyond > 1.0 => assert!(passed > 0.5, "{what}"),
                    beyond if beyond < -1.0 => assert!(passed < 0.5, "{what}"),
                    _ => {}
                }
                let whole = std::f32::consts::SQRT_2 * filter_px as f32 + 1.0;
                inside += u32::from(beyond_px < -whole);
                outside += u32::from(beyond_px > whole);
                assert!(beyond_px < whole || (passed - 1.0).abs() < 5e-3, "{what}");
                assert!(beyond_px > -whole || passed.abs() < 5e-3, "{what}");
            }
            assert!(inside > 200 && outside > 2000, "{inside} {outside}");
        }
    });
}

#[test]
fn light_passes_the_holes_of_a_masked_card() {
    let to_light = Vec3::new(0.6, 0.0, 0.8);
    let mut stage = floor(Vec3::Z, to_light);
    let holes = stage.texture([2, 1], &[[255, 255, 255, 0], [255; 4]], NEAREST);
    let alpha_mode = AlphaMode::Mask(0.5);
    let card = stage.material(Material { base_color_texture: Some(holes), alpha_mode, ..plain() });
    stage.object(quad(0.2, 0.2), card, at(Vec3::new(0.3, 0.0, 0.8)));
    // Its middle's shadow.
    let middle = Vec3::new(0.3 - 0.6, 0.0, 0.0);
    let dark = unlit(&stage);
    let places = [middle - Vec3::X * 0.1, middle + Vec3::X * 0.1];
    let found = shares(&stage.scene(), &dark, Vec3::Z, &places);
    assert!((found[0].x - 1.0).abs() < 5e-3 && found[1].x.abs() < 5e-3, "{found:?}");
}

/// Seen from the side, so that nothing hides the floor below.
const ASIDE: Vec3 = Vec3::new(0.8, 0.0, 0.6);

#[test]
fn gauze_tints_its_shadow_and_two_sheets_multiply() {
    let cast = |heights_m: &[f32], floor_m: f32| {
        let mut stage = floor(ASIDE, Vec3::Z);
        let base_color = Vec3::new(0.9, 0.2, 0.1).extend(1.0);
        let red = stage.material(Material { base_color, double_sided: true, ..plain() });
        for &height_m in heights_m {
            stage.object(quad(0.3, 0.3), red, at(Vec3::Z * height_m));
        }
        let dress = |mut scene: Scene| {
            scene.materials_mut()[red].family = Some(Family::Gauze(Gauze::default()));
            scene
        };
        let dark = dress(unlit(&stage));
        let place = Vec3::new(0.0, 0.0, floor_m);
        shares(&dress(stage.scene()), &dark, ASIDE, &[place])[0]
    };
    let one = cast(&[0.5], 0.0);
    assert!(one.x > one.y && one.y > one.z && one.z > 0.1 && one.x < 0.95, "tinted and partial: {one}");
    for heights_m in [[0.5, 0.7], [0.7, 0.5], [0.5, 0.505]] {
        let two = cast(&heights_m, 0.0);
        assert!((two - one * one).abs().max_element() < 0.01, "{heights_m:?}: {two} for {one} twice");
    }
    let three = cast(&[0.3, 0.5, 0.9], 0.0);
    assert!((three - one * one * one).abs().max_element() < 0.01, "{three}");
}

#[test]
fn blended_surfaces_cast_shadows_of_their_opacity() {
    for alpha in [0.0, 0.25, 0.75] {
        let mut stage = floor(ASIDE, Vec3::Z);
        let base_color = Vec3::ONE.extend(alpha);
        let glass = stage.material(Material { base_color, alpha_mode: AlphaMode::Blend, ..plain() });
        stage.object(quad(0.3, 0.3), glass, at(Vec3::Z * 0.5));
        let dark = unlit(&stage);
        let found = shares(&stage.scene(), &dark, ASIDE, &[Vec3::ZERO])[0];
        assert!((found - (1.0 - alpha)).abs().max_element() < 5e-3, "{alpha}: {found}");
    }
}

#[test]
fn a_coat_casts_less_shadow_towards_its_fringe() {
    let mut stage = floor(ASIDE, Vec3::Z);
    let material = stage.material(plain());
    stage.object(sphere(0.15, 24), material, at(Vec3::Z * 0.6));
    let dress = |mut scene: Scene| {
        scene.materials_mut()[material].fur =
            Some(Fur { length: Length::Metres(0.12), strand_spacing: Length::Metres(0.006), ..Fur::default() });
        scene
    };
    let dark = dress(unlit(&stage));
    let places = [0.0, 0.2, 0.22, 0.25, 0.32].map(|y| Vec3::Y * y);
    let found = shares(&dress(stage.scene()), &dark, ASIDE, &places);
    assert!(found[0].x.abs() < 5e-3 && (found[4].x - 1.0).abs() < 5e-3, "{found:?}");
    assert!(found.windows(2).all(|pair| pair[0].x < pair[1].x), "{found:?}");
    assert!(found[3].x < 0.999 && found[2].x > found[0].x + 0.01, "the fringe is soft: {found:?}");
}

#[test]
fn convex_things_do_not_shadow_themselves() {
    headless(|device| {
        for degrees in [0f32, 30.0, 60.0, 80.0, 87.0] {
            let angle = degrees.to_radians();
            let to_light = Vec3::new(angle.sin(), 0.0, angle.cos());
            let plane = floor(Vec3::Z, to_light);
            let mut ball = Stage::front(HALF_M);
            ball.light(LightKind::Directional, Vec3::splat(3.0), Vec3::ZERO, to_light);
            let material = ball.material(Material { roughness: 0.6, ..plain() });
            ball.object(sphere(0.8, 16), material, at(Vec3::ZERO));
            for (what, scene) in [("plane", plane.scene()), ("ball", ball.scene())] {
                let [shadowed, lit] = both(device, &scene, &options(SIZE, 1));
                let brightest = lit.radiance.iter().map(|radiance| radiance.x).fold(0.0, f32::max);
                let farthest = shadowed.radiance.iter().zip(&lit.radiance).map(|(a, b)| (a.x - b.x).abs());
                let farthest = farthest.fold(0.0, f32::max) / brightest;
                assert!(farthest < 0.02, "{what} under light from {degrees} degrees: {farthest} of the brightest");
            }
        }
    });
}

#[test]
fn lights_that_reach_nothing_cost_nothing() {
    let mut stage = Stage::front(HALF_M);
    let material = stage.material(plain());
    stage.object(quad(0.2, 0.2), material, at(Vec3::X * -0.5));
    stage.object(quad(0.2, 0.2), material, at(Vec3::X * 0.5));
    let near = LightKind::Point { range_m: Some(0.4) };
    stage.light(near, Vec3::ONE, Vec3::new(-0.6, 0.0, 0.2), Vec3::Z);
    let scene = stage.scene();
    let frame = options(SIZE, 1);
    let staging =
        |frame: &FrameOptions| FrameSetup::new(&scene, frame).unwrap_or_else(|error| panic!("{error}")).staging;
    assert_eq!(staging(&frame).light_lists.ranges.iter().map(|range| range.len()).collect::<Vec<_>>(), [1, 0]);

    let away = Light { position_in_world: Vec3::Z * 9.0, range_m: Some(1.0), ..point() };
    let dark = Light { intensity: Vec3::ZERO, ..Light::key() };
    let more = FrameOptions { lights: vec![away, dark], ..frame.clone() };
    let [more_staging, staging] = [staging(&more), staging(&frame)];
    assert_eq!(more_staging.light_lists, staging.light_lists);
    assert_eq!(more_staging.plan.passes, staging.plan.passes);
    headless(|device| assert_eq!(device.picture(&scene, &more).radiance, device.picture(&scene, &frame).radiance));
}

fn point() -> Light {
    Light { kind: vair::scene::LightKind::Point, ..Light::key() }
}

#[test]
fn without_shadows_there_is_neither_pass_nor_image_nor_binding() {
    let stage = floor(Vec3::Z, Vec3::Z);
    let dark = unlit(&stage);
    let mut shaded = stage.asset.clone();
    shaded.materials.iter_mut().for_each(|material| material.unlit = true);
    let shaded = Stage { asset: shaded }.scene();
    let scene = stage.scene();
    let without = Shadows { are_cast: false, ..Shadows::default() };
    for (scene, frame, has_shadows) in [
        (&scene, options(SIZE, 1), true),
        (&scene, FrameOptions { shadows: without, ..options(SIZE, 1) }, false),
        (&dark, options(SIZE, 1), false),
        (&shaded, options(SIZE, 1), false),
    ] {
        let setup = FrameSetup::new(scene, &frame).unwrap_or_else(|error| panic!("{error}"));
        let plan = &setup.staging.plan;
        let binds = plan.pipelines.iter().any(|spec| spec.bindings().contains("shadow_map"));
        let images = plan.memory(scene, &frame).keys().any(|name| name.contains("shadow"));
        let skipped = setup.skipped(scene).iter().any(|skipped| skipped.what == "shadow maps");
        assert_eq!([plan.passes.contains(&Pass::ShadowMap), binds, images, !skipped], [has_shadows; 4]);
    }
}

#[test]
fn sheets_and_scenes_without_size_are_drawn() {
    headless(|device| {
        for scale in [Vec3::ZERO, Vec3::new(1e-12, 1e-12, 1e-12), Vec3::new(1e6, 1e6, 0.0)] {
            let mut stage = Stage::front(HALF_M);
            stage.light(LightKind::Directional, Vec3::ONE, Vec3::ZERO, Vec3::Z);
            let spot = LightKind::Spot { range_m: None, inner_angle: 0.0, outer_angle: 1.57 };
            stage.light(spot, Vec3::ONE, Vec3::ZERO, Vec3::Z);
            let material = stage.material(plain());
            let rotation = glam::Quat::IDENTITY;
            stage.object(quad(1.0, 1.0), material, Transform::Trs { translation: Vec3::ZERO, rotation, scale });
            let picture = device.picture(&stage.scene(), &options(SIZE, 1));
            assert!(picture.radiance.iter().all(|radiance| radiance.is_finite()), "{scale}");
        }
    });
}
