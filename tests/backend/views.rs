//! Views: several of one scene, viewports, jitter and pre-exposure.

use crate::host_stage::{host_stage, prepare};
use crate::things::{SKINNED, dull, frame, front, furred, placed, plain_target, preset, quad, unlit};
use glam::{Vec2, Vec4};
use vair::asset::procedural;
use vair::render::{FrameDesc, View, Viewport};
use vair::scene::Light;

const SIZE: [u32; 2] = [32, 32];

#[test]
fn two_views_of_a_frame_skin_once_and_draw_to_their_own_viewports() {
    host_stage([64, 32], plain_target(), |stage| {
        let mut scene = furred();
        scene.add(&SKINNED).unwrap();
        let at = |origin| View { viewport: Viewport { origin, size: SIZE }, ..front(SIZE) };
        let views = [at([0, 0]), at([32, 0])];
        let gpu = stage.gpu();
        let mut dispatches = |views: &[View]| {
            let desc = frame(stage.target, views);
            let before = gpu.calls();
            stage.frame(
                &mut scene,
                |frame, scene| prepare(frame, scene, &desc),
                |pass, scene| (0..views.len()).for_each(|view| pass.draw(scene, view)),
            );
            gpu.calls().since(&before).of("vkCmdDispatch")
        };
        let with_one = dispatches(&views[..1]);
        assert!(with_one > 0);
        assert_eq!(dispatches(&views), with_one);
        let pixels = stage.pixels();
        for y in 0..32 {
            let (left, right) = (&pixels[y * 64..y * 64 + 32], &pixels[y * 64 + 32..y * 64 + 64]);
            assert_eq!(left, right, "row {y}");
        }
        assert!(pixels.iter().any(|pixel| pixel.w > 0.0));
    });
}

#[test]
fn jitter_shifts_the_picture() {
    host_stage(SIZE, plain_target(), |stage| {
        let square = quad(Vec2::splat(-0.5), Vec2::splat(0.5), 0.0);
        let mut scene = placed(vec![(square, unlit([1.0, 0.5, 0.25]))]);
        let still = stage.draw(&mut scene, &frame(plain_target(), &[front(SIZE)]));
        for is_y_down in [false, true] {
            let mut view = View { jitter_px: Vec2::new(1.0, 2.0), is_y_down, ..front(SIZE) };
            if is_y_down {
                view.clip_from_view = glam::Mat4::from_scale(glam::Vec3::new(1.0, -1.0, 1.0)) * view.clip_from_view;
            }
            let moved = stage.draw(&mut scene, &frame(plain_target(), &[view]));
            for y in 0..30 {
                for x in 0..31 {
                    assert_eq!(moved[(y + 2) * 32 + x + 1], still[y * 32 + x], "at {x}, {y}");
                }
            }
        }
    });
}

#[test]
fn twice_the_pre_exposure_is_twice_the_radiance() {
    host_stage(SIZE, plain_target(), |stage| {
        let things = vec![
            (procedural::sphere(0.4, 10), preset("fox")),
            (quad(Vec2::splat(-0.9), Vec2::splat(0.9), -0.6), dull()),
            (quad(Vec2::new(0.5, 0.5), Vec2::new(0.9, 0.9), 0.0), unlit([0.5, 0.25, 0.125])),
        ];
        let mut scene = placed(things);
        let lights = [Light::key()];
        let mut at = |pre_exposure| {
            let views = [View { pre_exposure, ..front(SIZE) }];
            stage.draw(&mut scene, &FrameDesc { lights: &lights, ..frame(plain_target(), &views) })
        };
        let (once, twice) = (at(1.0), at(2.0));
        for (once, twice) in once.iter().zip(&twice) {
            let doubled = (once.truncate() * 2.0).extend(once.w);
            assert_eq!(doubled, *twice);
        }
        assert!(once.iter().filter(|pixel| pixel.w > 0.0 && pixel.truncate() != Vec4::ZERO.truncate()).count() > 500);
    });
}
