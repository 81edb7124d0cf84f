//! A coat is closed: nothing of the background, and at no edge the skin, is seen through its outside.

use crate::headless::headless;
use crate::shells::{AROUND, height_coat, shown_height};
use crate::stage::{Stage, at, camera_axes, options, plain};
use glam::{DVec2, DVec3, Vec3};
use vair::asset::procedural::{cube, sphere};
use vair::material::{Blend, Fur, Length};
use vair::render::{FrameOptions, ShellSampling, Shells};
use vair::scene::Scene;

const BACKWARDS: Vec3 = Vec3::new(0.6, 0.5, 0.9);

fn coated(primitive: vair::asset::Primitive, fur: Fur, white_map: bool) -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(1.0, BACKWARDS, Vec3::Y);
    let white = stage.texel([255; 4]);
    let material = stage.material(plain());
    stage.object(primitive, material, at(Vec3::ZERO));
    let mut scene = stage.scene();
    scene.materials_mut()[material].fur = Some(Fur { distribution_map: white_map.then_some(white), ..fur });
    scene
}

#[test]
fn no_background_is_seen_through_fur() {
    headless(|device| {
        for blend in [Blend::Cutout, Blend::Coverage, Blend::Blend] {
            // Three pixels from strand to strand: thinner ones fade to their mean.
            let strand_spacing = Length::Metres(0.06);
            let fur = Fur { length: Length::Metres(0.2), strand_spacing, blend, ..Fur::default() };
            let scene = coated(sphere(0.6, 16), fur, false);
            for msaa in [1, 4] {
                let size = [96, 96];
                let picture = device.picture(&scene, &options(size, msaa));
                let mut inside = 0;
                let mut outside = 0.0f32;
                for y in 0..size[1] {
                    for x in 0..size[0] {
                        let coverage = picture.radiance(x, y).w;
                        let radius_m = crate::stage::front_position([x, y], size, 1.0).length();
                        // The polygon lies up to 0.3 % inside its ball; a pixel is 2 %.
                        if radius_m < 0.57 {
                            inside += 1;
                            // Half floats lose a step in every of 20 blends.
                            let limit = if blend == Blend::Blend { 20.0 / 2048.0 } else { 0.0 };
                            assert!(
                                (coverage - 1.0).abs() <= limit,
                                "{blend:?}, {msaa} samples: pixel {x}, {y} is {coverage}"
                            );
                        } else if radius_m > 0.63 {
                            outside += coverage;
                        }
                        assert!(radius_m < 0.83 || coverage == 0.0, "fur at {radius_m} m");
                    }
                }
                assert!(
                    inside > 1500 && outside > 100.0,
                    "{blend:?}, {msaa} samples: {inside} pixels of ball, {outside} of fur around"
                );
            }
        }
    });
}

/// Whether a ray against `backwards` meets the box [-half, half]^3.
fn meets_box(origin: DVec3, backwards: DVec3, half: f64) -> bool {
    let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let ends = [-half, half].map(|side| (side - origin[axis]) / backwards[axis]);
        enter = enter.max(ends[0].min(ends[1]));
        leave = leave.min(ends[0].max(ends[1]));
    }
    enter < leave
}

#[test]
fn shells_of_a_hard_edged_cube_stay_joined() {
    let (half_m, length_m, layers) = (0.4f64, 0.4f64, 3);
    let axes = camera_axes(BACKWARDS, Vec3::Y).as_dmat3();
    let fur = Fur { length: Length::Metres(length_m as f32), layers, ..height_coat() };
    let scene = coated(cube(half_m as f32), fur, true);
    // Corners move along the diagonals, so that each shell is a cube, too.
    let middle = (f64::from(layers) - 0.5) / f64::from(layers);
    headless(|device| {
        // A slab's shell is its upper boundary, a point's its middle; both show a height within the outermost slab.
        for (msaa, sampling, top) in
            [(1, ShellSampling::Slab, 1.0), (4, ShellSampling::Slab, 1.0), (1, ShellSampling::Point, middle)]
        {
            let size = [128u32, 128];
            let outer_m = half_m + top * length_m / 3f64.sqrt();
            let shells = Shells { sampling, ..Shells::default() };
            let picture = device.picture(&scene, &FrameOptions { shells, ..options(size, msaa) });
            let (mut inside, mut outside) = (0, 0);
            for y in 0..size[1] {
                for x in 0..size[0] {
                    let is_covered = |shift: DVec2| {
                        let clip = (DVec2::new(x.into(), y.into()) + 0.5 + shift) / f64::from(size[0]) * 2.0 - 1.0;
                        meets_box(axes.x_axis * clip.x - axes.y_axis * clip.y, axes.z_axis, outer_m)
                    };
                    let radiance = picture.radiance(x, y);
                    if AROUND.iter().all(|&step| is_covered(step)) {
                        inside += 1;
                        let height = shown_height(radiance).unwrap_or(-1.0);
                        assert!(
                            height > 1.0 - 1.0 / f64::from(layers) && radiance.w == 1.0,
                            "{msaa} samples: {x}, {y} shows {height}"
                        );
                    } else if !AROUND.iter().any(|&step| is_covered(step)) {
                        outside += 1;
                        assert_eq!(radiance.w, 0.0, "{msaa} samples: pixel {x}, {y} lies outside");
                    }
                }
            }
            assert!(inside > 4000 && outside > 2000, "{inside} inside, {outside} outside");
        }
    });
}
