//! A point in space is shown at the pixel that the camera's formula says; points and lines are drawn.

use crate::headless::headless;
use crate::stage::{Stage, at, camera_axes, options, unlit};
use glam::{DVec3, Vec3, Vec4};
use vair::asset::{Primitive, Projection, Topology, Vertices};
use vair::render::Picture;

fn loose(topology: Topology, positions: &[Vec3]) -> Primitive {
    let vertices = Vertices { positions: positions.to_vec(), ..Vertices::default() };
    Primitive { topology, indices: (0..positions.len() as u32).collect(), vertices, ..Primitive::default() }
}

fn shown(picture: &Picture) -> Vec<[u32; 2]> {
    let size = picture.size;
    let all = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
    all.filter(|&[x, y]| picture.radiance(x, y).w > 0.0).collect()
}

#[test]
fn file_cameras_put_points_where_their_projection_says() {
    let size = [96, 64];
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    let (eye, backwards) = (Vec3::new(2.0, 1.0, 3.0), Vec3::new(0.4, 0.3, 0.9));
    let axes = camera_axes(backwards, Vec3::Y);
    let vertical_fov = 0.9f32;
    // In camera space: right, up, and metres before the eye.
    let places = [[0.0, 0.0, 2.0], [0.31, 0.17, 2.0], [-0.42, 0.23, 1.5], [0.77, -0.53, 4.0]];
    let perspective = |near_m, far_m| Projection::Perspective { vertical_fov, aspect: None, near_m, far_m };
    let projections = [
        (perspective(0.1, None), true),
        (perspective(0.5, Some(10.0)), true),
        (Projection::Orthographic { half_width_m: 1.5, half_height_m: 1.0, near_m: 0.5, far_m: 10.0 }, false),
    ];
    headless(|device| {
        for (projection, is_perspective) in projections {
            for [x, y, depth] in places {
                let mut stage = Stage::default();
                stage.camera(projection, eye, backwards, Vec3::Y);
                let material = stage.material(unlit(Vec4::ONE));
                let place = axes * Vec3::new(x, y, -depth);
                stage.object(loose(Topology::Points, &[Vec3::ZERO]), material, at(eye + place));
                let picture = device.picture(&stage.scene(), &options(size, 1));

                let half_height =
                    if is_perspective { (0.5 * f64::from(vertical_fov)).tan() * f64::from(depth) } else { 1.0 };
                let clip = DVec3::new(f64::from(x) / half_height / aspect, f64::from(y) / half_height, 0.0);
                let expected = [(clip.x + 1.0) * 0.5 * f64::from(size[0]), (1.0 - clip.y) * 0.5 * f64::from(size[1])];
                let [pixel] = shown(&picture)[..] else { panic!("a point is one pixel: {:?}", shown(&picture)) };
                for axis in 0..2 {
                    // f32 positions metres away from the origin err by less than a thousandth of a pixel; where the
                    // point falls on a pixel border, either side is right.
                    let from_middle = expected[axis] - f64::from(pixel[axis]) - 0.5;
                    assert!(from_middle.abs() <= 0.5 + 1e-2, "{projection:?}: {pixel:?} is not {expected:?}");
                }
            }
        }
    });
}

#[test]
fn what_lies_before_the_near_plane_or_behind_the_far_one_is_not_shown() {
    let projection = Projection::Perspective { vertical_fov: 0.9, aspect: None, near_m: 1.0, far_m: Some(3.0) };
    headless(|device| {
        for (depth_m, is_seen) in [(0.9, false), (1.1, true), (2.9, true), (3.1, false), (-2.0, false)] {
            let mut stage = Stage::default();
            stage.camera(projection, Vec3::ZERO, Vec3::Z, Vec3::Y);
            let material = stage.material(unlit(Vec4::ONE));
            stage.object(loose(Topology::Points, &[Vec3::NEG_Z * depth_m]), material, at(Vec3::ZERO));
            let picture = device.picture(&stage.scene(), &options([9, 9], 1));
            assert_eq!(!shown(&picture).is_empty(), is_seen, "at {depth_m} m");
        }
    });
}

#[test]
fn lines_reach_from_end_to_end() {
    let mut stage = Stage::front(1.0);
    let material = stage.material(unlit(Vec4::ONE));
    let ends = [Vec3::new(-0.5, 0.27, 0.0), Vec3::new(0.5, 0.27, 0.0)];
    stage.object(loose(Topology::Lines, &ends), material, at(Vec3::ZERO));
    let scene = stage.scene();
    headless(|device| {
        let size = [64, 64];
        for msaa in [1, 4] {
            let picture = device.picture(&scene, &options(size, msaa));
            let pixels = shown(&picture);
            // y = 0.27 lies at row 0.365 * 64 = 23.36; the ends at columns 16 and 48.
            for x in 17..47 {
                assert!(pixels.iter().any(|pixel| pixel[0] == x), "a gap at {x}");
            }
            for [x, y] in pixels {
                assert!((15..=48).contains(&x) && (22..=24).contains(&y), "pixel {x}, {y} at {msaa} samples");
            }
        }
    });
}
