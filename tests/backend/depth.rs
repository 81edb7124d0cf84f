//! Depth is tested against what the host drew, and written for what it draws later; of either sense, of either handedness.

use crate::host_stage::{host_stage, prepare};
use crate::things::{dull, frame, front, placed, plain_target, preset, quad, rect, unlit};
use glam::{Mat4, Vec2, Vec3, Vec4};
use vair::asset::procedural;
use vair::render::{DepthOrder, DeviceScene, Target, View};
use vair::scene::Light;

const SIZE: [u32; 2] = [32, 32];
const BLUE: [f32; 4] = [0.0, 0.0, 1.0, 1.0];
/// Of the host's box; [`front`] sees z = 0.5 m at 0.75 and z = -0.5 m at 0.25.
const BOX_DEPTH: f32 = 0.5;

/// Green before the host's box in the upper half, red behind it in the lower one.
fn before_and_behind() -> DeviceScene {
    let (left, right) = (-1.0, 1.0);
    let upper = quad(Vec2::new(left, 0.0), Vec2::new(right, 1.0), 0.5);
    let lower = quad(Vec2::new(left, -1.0), Vec2::new(right, 0.0), -0.5);
    placed(vec![(upper, unlit([0.0, 1.0, 0.0])), (lower, unlit([1.0, 0.0, 0.0]))])
}

#[test]
fn what_the_host_drew_hides_what_is_behind_it_and_is_hidden_by_what_is_before_it() {
    host_stage(SIZE, plain_target(), |stage| {
        let mut scene = before_and_behind();
        let views = [front(SIZE)];
        let desc = frame(stage.target, &views);
        stage.frame(
            &mut scene,
            |frame, scene| prepare(frame, scene, &desc),
            |pass, _| {
                // The box covers the right half.
                pass.host.engine.fill(pass.commands, rect([16, 0], [16, 32]), BLUE, BOX_DEPTH);
            },
        );
        stage.frame(
            &mut scene,
            |frame, scene| prepare(frame, scene, &desc),
            |pass, scene| {
                pass.host.engine.fill(pass.commands, rect([16, 0], [16, 32]), BLUE, BOX_DEPTH);
                pass.draw(scene, 0);
            },
        );
        let (pixels, depth) = (stage.pixels(), stage.depth());
        let (green, red, blue) = (Vec4::new(0.0, 1.0, 0.0, 1.0), Vec4::new(1.0, 0.0, 0.0, 1.0), Vec4::from(BLUE));
        for y in 0..32 {
            for x in 0..32 {
                let (color, at) = match (y < 16, x < 16) {
                    (true, _) => (green, 0.75),
                    (false, true) => (red, 0.25),
                    (false, false) => (blue, BOX_DEPTH),
                };
                assert_eq!(pixels[y * 32 + x], color, "at {x}, {y}");
                assert!((depth[y * 32 + x] - at).abs() < 1e-6, "depth {} at {x}, {y}", depth[y * 32 + x]);
            }
        }
    });
}

#[test]
fn fur_behind_the_hosts_box_is_hidden_and_fur_before_it_hides_it() {
    host_stage(SIZE, plain_target(), |stage| {
        let ball = || procedural::sphere(0.4, 8);
        for (depth, shows_box) in [(0.95, true), (0.05, false)] {
            let mut scene = placed(vec![(ball(), preset("fox"))]);
            let views = [front(SIZE)];
            let desc = frame(stage.target, &views);
            stage.frame(
                &mut scene,
                |frame, scene| prepare(frame, scene, &desc),
                |pass, scene| {
                    pass.host.engine.fill(pass.commands, rect([0, 0], SIZE), BLUE, depth);
                    pass.draw(scene, 0);
                },
            );
            let pixels = stage.pixels();
            let middle = pixels[16 * 32 + 16];
            assert_eq!(middle == Vec4::from(BLUE), shows_box, "{middle} with the box at {depth}");
            assert_eq!(pixels[0], Vec4::from(BLUE));
        }
    });
}

/// Everything that depth decides: fur over a floor, seen in perspective.
fn furry() -> DeviceScene {
    placed(vec![(procedural::sphere(0.4, 10), preset("fox")), (procedural::plane(1.0, 1.0, 2), dull())])
}

fn drawn(target: Target, change: impl FnOnce(View) -> View) -> Vec<Vec4> {
    let mut pixels = Vec::new();
    host_stage(SIZE, target, |stage| {
        let eye = Mat4::from_translation(Vec3::new(0.0, 0.4, 2.5));
        let clip_from_view = vair::math::perspective(0.7, 1.0, 0.5, 8.0);
        let views = [change(View::new(eye.inverse(), clip_from_view, SIZE))];
        let lights = [Light::key()];
        let desc = vair::render::FrameDesc { lights: &lights, ..frame(stage.target, &views) };
        pixels = stage.draw(&mut furry(), &desc);
    });
    pixels
}

/// Turns the depth around: 0 at the near plane.
fn standard_depth(view: View) -> View {
    let turned = Mat4::from_cols(Vec4::X, Vec4::Y, Vec4::NEG_Z, Vec4::new(0.0, 0.0, 1.0, 1.0));
    View { clip_from_view: turned * view.clip_from_view, ..view }
}

#[test]
fn standard_and_reversed_depth_give_the_same_picture() {
    for samples in [1, 4] {
        let reversed = drawn(Target::hdr(samples), |view| view);
        let standard = Target { depth_order: DepthOrder::Standard, ..Target::hdr(samples) };
        assert!(reversed.iter().filter(|pixel| pixel.w > 0.0).count() > 200);
        let standard = drawn(standard, standard_depth);
        let differing = reversed.iter().zip(&standard).filter(|(a, b)| a != b).count();
        assert_eq!(differing, 0, "pixels differ at {samples} samples");
    }
}

#[test]
fn clip_space_may_point_up_or_down() {
    let up = drawn(Target::hdr(1), |view| view);
    let down = drawn(Target::hdr(1), |view| {
        let mirrored = Mat4::from_scale(Vec3::new(1.0, -1.0, 1.0)) * view.clip_from_view;
        View { clip_from_view: mirrored, is_y_down: true, ..view }
    });
    let differing = up.iter().zip(&down).filter(|(a, b)| a != b).count();
    assert_eq!(differing, 0, "pixels differ");
}
