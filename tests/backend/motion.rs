//! Motion vectors of what the host moved.

use crate::host::Pass;
use crate::host_stage::{floats, host_stage, prepare, read};
use crate::things::{frame, front, quad, scene, unlit};
use glam::{Mat4, Vec2, Vec3};
use vair::gpu::{HostRendering, vk};
use vair::render::{InstanceDesc, Target};

const SIZE: [u32; 2] = [64, 64];
const FORMAT: vk::Format = vk::Format::R32G32_SFLOAT;
const LAYOUT: vk::ImageLayout = vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL;

#[test]
fn a_moved_instance_has_the_motion_of_its_move() {
    let target = Target { motion: Some(FORMAT), ..Target::hdr(1) };
    host_stage(SIZE, target, |stage| {
        let usage = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC;
        let motion = stage.host.engine.target(FORMAT, SIZE, 1, usage).unwrap();
        let mut scene = scene(vec![(quad(Vec2::splat(-0.25), Vec2::splat(0.25), 0.0), unlit([1.0; 3]))]);
        let moving = scene.add(&InstanceDesc::default()).unwrap();
        let still = Mat4::from_translation(Vec3::new(-0.6, -0.6, 0.0));
        scene.add(&InstanceDesc { world_from_object: still, ..InstanceDesc::default() }).unwrap();
        let views = [front(SIZE)];
        let desc = frame(target, &views);
        // A pixel is 1/32 m: 8 to the right, 4 up; then nothing any more.
        let aside = Vec3::new(0.25, 0.125, 0.0);
        let moves = [(Vec3::ZERO, Vec2::ZERO), (aside, Vec2::new(8.0, -4.0)), (aside, Vec2::ZERO)];
        for (place, expected) in moves {
            scene.set_transform(moving, Mat4::from_translation(place)).unwrap();
            stage.frame_with(
                &mut scene,
                |frame, scene| prepare(frame, scene, &desc),
                |pass, scene| pass.draw(scene, 0),
                |after, scene| {
                    let engine = &after.host.engine;
                    let depth_layout = vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
                    engine.barrier(after.commands, after.depth, depth_layout, depth_layout);
                    engine.barrier(after.commands, &motion, vk::ImageLayout::UNDEFINED, LAYOUT);
                    let pass = Pass {
                        color: Some(&motion),
                        resolve: None,
                        depth: Some(after.depth),
                        clear_color: [99.0; 4],
                        clear_depth: None,
                    };
                    engine.begin_rendering(after.commands, &pass);
                    let formats = target.motion_formats().unwrap();
                    // SAFETY: inside a pass of these formats.
                    let pass = unsafe { HostRendering::begun(after.commands, formats) };
                    after.frame.draw_motion(pass, scene, 0).unwrap_or_else(|error| panic!("{error}"));
                    engine.end_rendering(after.commands);
                },
            );
            let texels = floats(&read(&stage.gpu(), &motion, LAYOUT));
            let at = |x: usize, y: usize| Vec2::new(texels[2 * (y * 64 + x)], texels[2 * (y * 64 + x) + 1]);
            let middle = (Vec2::new(place.x, -place.y) + 1.0) * 32.0;
            assert_eq!(at(middle.x as usize, middle.y as usize), expected, "of what stands at {place}");
            assert_eq!(at(12, 52), Vec2::ZERO, "of what stays");
            assert_eq!(at(2, 2), Vec2::splat(99.0), "where nothing is drawn");
        }
        stage.host.engine.destroy_target(&motion);
    });
}
