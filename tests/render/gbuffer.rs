//! Layers beside the colour: depth, normal and motion are those of the geometry, and nobody pays who does not ask.

use crate::headless::headless;
use crate::scenes::{fur_cube, plain_cube};
use crate::skinning::bent_tube;
use crate::stage::{Stage, at, options, plain, quad, unlit};
use glam::{DVec2, DVec3, Quat, Vec2, Vec3, Vec4};
use vair::asset::procedural::sphere;
use vair::asset::{AlphaMode, Animation, Channel, Interpolation, Keys, Material, Projection, Transform};
use vair::material::Fur;
use vair::render::{Aovs, EMPTY_DEPTH_M, FrameOptions, FrameSetup, Pass};
use vair::scene::{self, Scene, deform, joint_matrices};

const ALL: Aovs = Aovs { depth: true, normal: true, motion: true, occlusion: false };

/// A clip of one second in which one node moves.
pub fn clip(node: usize, values: Keys) -> Animation {
    let channel = Channel { node, times_s: vec![0.0, 1.0], interpolation: Interpolation::Linear, values };
    Animation { name: None, duration_s: 1.0, channels: vec![channel] }
}

#[test]
fn depth_and_normal_of_a_tilted_plane_are_those_of_its_rays() {
    let size = [33, 24];
    let (fov, eye) = (0.9f64, DVec3::new(0.0, 0.0, 3.0));
    let normal = DVec3::new(0.3, 0.5, 0.8).normalize();
    let mut stage = Stage::default();
    let projection = Projection::Perspective { vertical_fov: fov as f32, aspect: None, near_m: 0.05, far_m: None };
    stage.camera(projection, eye.as_vec3(), Vec3::Z, Vec3::Y);
    let rotation = Quat::from_rotation_arc(Vec3::Z, normal.as_vec3());
    let material = stage.material(Material { double_sided: true, ..plain() });
    stage.object(quad(1.0, 1.0), material, Transform::Trs { translation: Vec3::ZERO, rotation, scale: Vec3::ONE });
    let scene = stage.scene();
    headless(|device| {
        let aovs = device.picture(&scene, &FrameOptions { aovs: ALL, ..options(size, 4) }).aovs;
        let (mut seen, mut empty) = (0, 0);
        for (index, depth_m) in aovs.depth_m.iter().enumerate() {
            let pixel = DVec2::new((index as u32 % size[0]) as f64, (index as u32 / size[0]) as f64) + 0.5;
            let half = (0.5 * fov).tan();
            let in_clip = pixel / DVec2::new(size[0].into(), size[1].into()) * 2.0 - 1.0;
            let aspect = f64::from(size[0]) / f64::from(size[1]);
            let ray = DVec3::new(in_clip.x * half * aspect, -in_clip.y * half, -1.0);
            // Along a ray of unit depth, the distance is the depth.
            let expected = -eye.dot(normal) / ray.dot(normal);
            if *depth_m == EMPTY_DEPTH_M {
                empty += 1;
                assert_eq!((aovs.normal_in_world[index], aovs.motion_px[index]), (Vec3::ZERO, Vec2::ZERO));
                continue;
            }
            seen += 1;
            assert!((f64::from(*depth_m) - expected).abs() < 4e-6 * expected, "{depth_m} is not {expected}");
            assert!((aovs.normal_in_world[index].as_dvec3() - normal).length() < 1e-6);
            assert_eq!(aovs.motion_px[index], Vec2::ZERO, "nothing moves");
        }
        assert!(seen > 100 && empty > 100, "{seen} seen, {empty} empty");
    });
}

#[test]
fn what_is_masked_or_blends_counts_where_it_covers_more_than_half() {
    let size = [16, 4];
    let mut stage = Stage::front(0.5);
    let cases =
        [(AlphaMode::Mask(0.5), 0.4), (AlphaMode::Mask(0.5), 0.6), (AlphaMode::Blend, 0.4), (AlphaMode::Blend, 0.6)];
    for (index, (alpha_mode, opacity)) in cases.into_iter().enumerate() {
        let material = stage.material(Material { alpha_mode, ..unlit(Vec4::new(0.5, 0.5, 0.5, opacity)) });
        stage.object(quad(0.5, 0.5), material, at(Vec3::X * (index as f32 - 1.5)));
    }
    let scene = stage.scene();
    headless(|device| {
        let aovs = device.picture(&scene, &FrameOptions { aovs: ALL, ..options(size, 1) }).aovs;
        let depths: Vec<f32> = (0..4).map(|case| aovs.depth_m[16 + case * 4 + 2]).collect();
        assert_eq!([depths[0], depths[2]], [EMPTY_DEPTH_M; 2]);
        assert!((depths[1] - 50.0).abs() < 1e-4 && (depths[3] - 50.0).abs() < 1e-4, "{depths:?}");
    });
}

/// A thing that goes a metre to the right and two up in a second, before a camera that shows two metres over 64 pixels.
fn rising(fur: Option<Fur>) -> Scene {
    let mut stage = Stage::front(1.0);
    let material = stage.material(plain());
    let node = stage.object(sphere(0.4, 8), material, at(Vec3::ZERO));
    stage.asset.animations.push(clip(node, Keys::Translation(vec![Vec3::ZERO, Vec3::new(1.0, 2.0, 0.0)])));
    let mut scene = stage.scene();
    scene.materials_mut()[material].fur = fur;
    scene
}

#[test]
fn surfaces_and_coats_move_with_their_roots() {
    headless(|device| {
        for fur in [None, Some(Fur::default())] {
            let scene = rising(fur);
            let frame = FrameOptions { animation: Some(0), time_s: 0.25, aovs: ALL, ..options([64, 64], 4) };
            let still = device.picture(&scene, &frame).aovs;
            assert!(still.motion_px.iter().all(|motion| *motion == Vec2::ZERO), "the same moment twice");
            let moved = device.picture(&scene, &FrameOptions { previous_time_s: Some(0.15), ..frame }).aovs;
            let seen: Vec<Vec2> = moved.motion_px.iter().copied().filter(|motion| *motion != Vec2::ZERO).collect();
            assert!(seen.len() > 300, "{} pixels move", seen.len());
            // A tenth of a second: 0.1 m right and 0.2 m up at 32 pixels a metre; rows count downwards.
            let far = seen.iter().map(|motion| (*motion - Vec2::new(3.2, -6.4)).length()).fold(0.0, f32::max);
            assert!(far < 1e-3, "off by {far} pixels");
        }
    });
}

#[test]
fn skins_and_morphs_move_as_the_twin_deforms_them() {
    for skinned in [true, false] {
        let mut asset = bent_tube(skinned).asset().clone();
        let node = asset.nodes.iter().position(|node| node.mesh.is_some()).unwrap();
        asset.animations = vec![match skinned {
            true => {
                let joint = asset.skins[0].joints[1];
                clip(joint, Keys::Rotation(vec![Quat::IDENTITY, Quat::from_rotation_z(0.8)]))
            }
            false => clip(node, Keys::Weights { targets: 2, values: vec![0.0, 0.0, 1.0, 0.5] }),
        }];
        let scene = Scene::from_asset(asset).unwrap();
        let size = [160, 160];
        let frame =
            FrameOptions { animation: Some(0), time_s: 0.8, previous_time_s: Some(0.5), aovs: ALL, ..options(size, 1) };
        let setup = FrameSetup::new(&scene, &frame).unwrap();
        let previous_pose = scene::pose(scene.asset(), Some(0), 0.5);
        let previous_camera = setup.previous_camera.as_ref().unwrap();
        let source = &scene.asset().meshes[0].primitives[0];
        let [now, before] = [
            (&setup.pose, &setup.staging.instances, &setup.camera),
            (&previous_pose, &setup.staging.previous, previous_camera),
        ]
        .map(|(pose, instances, camera)| {
            let joints = if skinned { joint_matrices(scene.asset(), 0, pose) } else { Vec::new() };
            let instance = &instances[0];
            let half = Vec2::new(0.5 * size[0] as f32, -0.5 * size[1] as f32);
            let posed = deform(source, &joints, &instance.morph_weights);
            let clip_from_object = camera.clip_from_world() * instance.world_from_object;
            let place = |position: &Vec3| {
                let place = clip_from_object.project_point3(*position);
                (place.truncate() * half + half.abs(), place.z)
            };
            posed.positions.iter().map(place).collect::<Vec<_>>()
        });
        headless(|device| {
            let aovs = device.picture(&scene, &frame).aovs;
            let (mut checked, mut largest) = (0, 0f32);
            for ((now, depth), (before, _)) in now.iter().zip(&before) {
                let index = (now.y as usize) * size[0] as usize + now.x as usize;
                // The camera is parallel and sees 98 m: what is hidden is farther by more than a millimetre.
                let depth_m = 1.0 + 98.0 * (1.0 - depth);
                if (aovs.depth_m[index] - depth_m).abs() > 4e-3 {
                    continue;
                }
                let expected = *now - *before;
                checked += 1;
                largest = largest.max(expected.length());
                // The vertex is within a pixel of the pixel's middle, over which the motion changes.
                let error = (aovs.motion_px[index] - expected).length();
                assert!(error < 0.3, "skinned {skinned}: {} is not {expected}", aovs.motion_px[index]);
            }
            assert!(checked > 100 && largest > 5.0, "{checked} vertices, at most {largest} pixels");
        });
    }
}

#[test]
fn layers_leave_the_picture_as_it_is_and_cost_nothing_where_nobody_asks() {
    headless(|device| {
        for scene in [plain_cube(), fur_cube()] {
            let frame = options([64, 64], 4);
            let (without, report) = device.reported(&scene, &frame);
            let with = device.picture(&scene, &FrameOptions { aovs: ALL, ..frame.clone() });
            assert_eq!(without.rgba, with.rgba);
            assert_eq!(without.radiance, with.radiance);
            let setup = FrameSetup::new(&scene, &frame).unwrap();
            let plan = &setup.staging.plan;
            assert!(!plan.passes.contains(&Pass::GBuffer) && plan.draws_of(Pass::GBuffer).is_empty());
            assert!(report.memory.by_owner.iter().all(|(owner, _)| !owner.contains("G-buffer")));
            assert!(setup.skipped(&scene).iter().any(|skipped| skipped.what == "G-buffer pass"));
        }
    });
}
