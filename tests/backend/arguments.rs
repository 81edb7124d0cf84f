//! What cannot be right is refused before anything is recorded, with what it is and what to do.

use crate::host_stage::{HostStage, commands, error_text, host_stage, prepare};
use crate::things::{SKINNED, dull, frame, front, furred, placed, plain_target, scene};
use glam::{Mat4, Vec3};
use vair::asset::procedural;
use vair::gpu::{HostRendering, TargetFormats, vk};
use vair::render::{
    CastTarget, DepthOrder, DeviceScene, FrameDesc, HostShadowMap, HostShadows, InstanceDesc, RenderError, Shadows,
    ShellSubmission, Shells, Target, View, Viewport,
};
use vair::scene::Light;

const SIZE: [u32; 2] = [32, 32];

fn says<T: std::fmt::Debug>(result: Result<T, RenderError>, words: &[&str]) {
    let text = error_text(result.expect_err(words[0]));
    assert!(words.iter().all(|word| text.contains(word)), "'{text}' lacks one of {words:?}");
}

#[test]
fn instances_are_added_hidden_moved_and_removed() {
    host_stage(SIZE, plain_target(), |stage| {
        let mut scene = scene(vec![(procedural::cube(0.3), dull())]);
        let count = |stage: &mut HostStage, scene: &mut DeviceScene| {
            let views = [front(SIZE)];
            stage.draw(scene, &frame(plain_target(), &views)).iter().filter(|pixel| pixel.w > 0.0).count()
        };
        assert_eq!(count(stage, &mut scene), 0);
        let at = |x: f32| Mat4::from_translation(Vec3::X * x);
        let left = scene.add(&InstanceDesc { world_from_object: at(-0.5), ..InstanceDesc::default() }).unwrap();
        let one = count(stage, &mut scene);
        let right = scene.add(&InstanceDesc { world_from_object: at(0.5), ..InstanceDesc::default() }).unwrap();
        assert!(one > 0);
        assert_eq!((count(stage, &mut scene), scene.instance_count()), (2 * one, 2));
        scene.set_visible(left, false).unwrap();
        assert_eq!(count(stage, &mut scene), one);
        scene.set_visible(left, true).unwrap();
        scene.set_transform(left, Mat4::from_scale(Vec3::ZERO)).unwrap();
        assert_eq!(count(stage, &mut scene), one);
        scene.set_transform(left, at(-0.5)).unwrap();
        assert_eq!(count(stage, &mut scene), 2 * one);
        scene.set_transform(left, at(9.0)).unwrap();
        assert_eq!(count(stage, &mut scene), one);
        scene.remove(right).unwrap();
        assert_eq!((count(stage, &mut scene), scene.instance_count()), (0, 1));
        says(scene.remove(right), &["instance", "removed", "add it again"]);
        // Another one in its place is another one.
        let next = scene.add(&InstanceDesc::default()).unwrap();
        assert_ne!(next, right);
        says(scene.set_transform(right, at(0.0)), &["instance", "removed"]);
        assert_eq!(count(stage, &mut scene), one);
    });
}

#[test]
fn what_a_scene_has_not_is_named() {
    let mut scene = furred();
    let mut other = furred();
    let foreign = other.add(&SKINNED).unwrap();
    let id = scene.add(&SKINNED).unwrap();
    says(scene.set_visible(foreign, false), &["instance", "another scene", "add"]);
    says(scene.add(&InstanceDesc { mesh: 1, ..SKINNED }), &["instance.mesh", "no 1", "has 1"]);
    says(scene.add(&InstanceDesc { skin: Some(7), ..SKINNED }), &["instance.skin", "no 7", "has 1"]);
    says(scene.add(&InstanceDesc { variant: Some(0), ..SKINNED }), &["instance.variant", "no 0", "has 0"]);
    let nan = Mat4::from_translation(Vec3::NAN);
    says(scene.add(&InstanceDesc { world_from_object: nan, ..SKINNED }), &["world_from_object", "finite"]);
    says(scene.set_transform(id, nan), &["world_from_object", "finite"]);
    says(scene.set_joints(id, &[Mat4::IDENTITY]), &["world_from_mesh", "1 matrices", "2 joints"]);
    says(scene.set_joints(id, &[Mat4::IDENTITY, nan]), &["world_from_mesh", "matrix 1", "finite"]);
    says(scene.set_morph_weights(id, &[0.5]), &["weights", "1 given", "0 targets"]);
    says(scene.add_nodes(4, None), &["scene", "no scene 4"]);
    says(scene.pose_nodes(Some(2), 0.0), &["animation", "no animation 2"]);
    says(scene.pose_nodes(None, f32::NAN), &["time_s", "finite"]);
    assert_eq!(scene.instance_count(), 1);
}

#[test]
fn frames_that_cannot_be_are_refused_before_anything_is_recorded() {
    host_stage(SIZE, plain_target(), |stage| {
        let mut scene = placed(vec![(procedural::cube(0.3), dull())]);
        let view = front(SIZE);
        let mut refused = |words: &[&str], change: &dyn Fn(&mut View, &mut FrameDesc)| {
            let mut desc = frame(plain_target(), &[]);
            let mut changed = view;
            change(&mut changed, &mut desc);
            let views = [changed];
            let desc = FrameDesc { views: if desc.step_s == 77.0 { &[] } else { &views }, ..desc };
            let text = stage.refused(&mut scene, &desc);
            assert!(words.iter().all(|word| text.contains(word)), "'{text}' lacks one of {words:?}");
        };
        refused(&["views", "at least one"], &|_, desc| desc.step_s = 77.0);
        refused(&["view.view_from_world", "inverse"], &|view, _| view.view_from_world = Mat4::ZERO);
        refused(&["view.clip_from_view", "finite"], &|view, _| view.clip_from_view = Mat4::NAN);
        refused(&["view.previous", "None"], &|view, _| view.previous = Some([Mat4::IDENTITY, Mat4::ZERO]));
        refused(&["view.viewport", "at least 1"], &|view, _| view.viewport.size = [0, 4]);
        refused(&["view.viewport", "32768"], &|view, _| {
            view.viewport = Viewport { origin: [u32::MAX, 0], size: [1, 1] };
        });
        refused(&["view.jitter_px", "finite"], &|view, _| view.jitter_px.x = f32::NAN);
        refused(&["view.pre_exposure", "greater than 0"], &|view, _| view.pre_exposure = 0.0);
        refused(&["target.color", "colour format"], &|_, desc| desc.target.color = vk::Format::D32_SFLOAT);
        refused(&["target.depth", "depth format"], &|_, desc| desc.target.depth = vk::Format::R8_UNORM);
        refused(&["target.motion", "colour format"], &|_, desc| desc.target.motion = Some(vk::Format::D32_SFLOAT));
        refused(&["target.samples", "3", "choose one of"], &|_, desc| desc.target.samples = 3);
        refused(&["cast_into", "depth format"], &|_, desc| {
            desc.cast_into = Some(CastTarget { format: vk::Format::R8_UNORM, depth_order: DepthOrder::Reversed });
        });
        refused(&["shadows", "64"], &|_, desc| desc.shadows = Shadows { resolution_px: 5, ..Shadows::default() });
        refused(&["step_s", "0 or more"], &|_, desc| desc.step_s = -1.0);
        refused(&["layers", "1 to 256"], &|_, desc| desc.layers = Some(0));
        refused(&["layer_scale", "greater than 0"], &|_, desc| desc.layer_scale = 0.0);
        refused(&["shells", "instanced"], &|_, desc| {
            desc.shells = Shells { submission: ShellSubmission::Duplicated, ..Shells::default() };
        });
        // SAFETY: never read.
        let image = unsafe { vair::gpu::Image::from_host(&stage.gpu(), &stage.described()) };
        let lights = [Light { position_in_world: Vec3::NAN, ..Light::key() }];
        let views = [view];
        let desc = FrameDesc { lights: &lights, ..frame(plain_target(), &views) };
        assert!(stage.refused(&mut scene, &desc).contains("lights"));
        let maps = [HostShadowMap { light: 3, clip_from_world: Mat4::IDENTITY, origin_px: [0; 2], size_px: 8 }];
        let host_shadows = Some(HostShadows { image: &image, maps: &maps });
        let desc = FrameDesc { host_shadows, ..frame(plain_target(), &views) };
        assert!(stage.refused(&mut scene, &desc).contains("host_shadows"));
    });
}

#[test]
fn draws_that_were_not_prepared_for_are_refused() {
    host_stage(SIZE, plain_target(), |stage| {
        let mut scene = placed(vec![(procedural::cube(0.3), dull())]);
        let views = [front(SIZE)];
        let desc = frame(plain_target(), &views);
        let gpu = stage.gpu();
        stage.frame(
            &mut scene,
            |_, _| {},
            |pass, scene| {
                let before = gpu.calls();
                says(pass.frame.draw_opaque(pass.pass, scene, 0), &["scene", "prepare"]);
                assert_eq!(commands(&gpu, &before), 0);
            },
        );
        stage.frame(
            &mut scene,
            |frame, scene| prepare(frame, scene, &desc),
            |pass, scene| {
                let before = gpu.calls();
                says(pass.frame.draw_opaque(pass.pass, scene, 1), &["view", "no view 1", "prepared for 1"]);
                says(pass.frame.draw_motion(pass.pass, scene, 0), &["target.motion", "prepare"]);
                says(pass.frame.cast_shadows(pass.pass, scene, 0), &["cast_into", "prepare"]);
                let formats = TargetFormats::new([vk::Format::R8G8B8A8_UNORM], Some(vk::Format::D32_SFLOAT), 1);
                // SAFETY: refused before anything is recorded.
                let other = unsafe { HostRendering::begun(pass.commands, formats) };
                says(pass.frame.draw_fur(other, scene, 0), &["pass", "prepared for", "R8G8B8A8_UNORM"]);
                assert_eq!(commands(&gpu, &before), 0);
            },
        );
        // The next frame must be prepared again.
        stage.frame(
            &mut scene,
            |_, _| {},
            |pass, scene| says(pass.frame.draw_transparent(pass.pass, scene, 0), &["scene", "prepare"]),
        );
        host_stage(SIZE, Target::hdr(1), |other| {
            let text = other.refused(&mut scene, &desc);
            assert!(text.contains("scene") && text.contains("another device"), "{text}");
        });
    });
}
