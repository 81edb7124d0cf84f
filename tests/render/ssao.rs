//! Screen-space ambient occlusion: a corner darkens as its closed form says, what stands alone does not.

use crate::headless::headless;
use crate::stage::{Stage, at, options, plain, quad};
use glam::{Quat, Vec3, Vec4};
use std::f64::consts::TAU;
use vair::asset::Transform;
use vair::asset::procedural::sphere;
use vair::render::{Aovs, FrameOptions, ScreenOcclusion};
use vair::scene::Scene;

const OCCLUSION: Aovs = Aovs { depth: true, normal: false, motion: false, occlusion: true };

fn frame(size: [u32; 2], occlusion: ScreenOcclusion) -> FrameOptions {
    FrameOptions { screen_occlusion: Some(occlusion), aovs: OCCLUSION, ..options(size, 1) }
}

/// A floor that faces up and a wall that faces +Z behind it, seen from halfway between.
fn corner() -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(1.0, Vec3::new(0.0, 1.0, 1.0), Vec3::Y);
    let material = stage.material(plain());
    let rotation = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    stage.object(quad(4.0, 4.0), material, Transform::Trs { translation: Vec3::Z * 4.0, rotation, scale: Vec3::ONE });
    stage.object(quad(4.0, 4.0), material, at(Vec3::Y * 4.0));
    stage.scene()
}

/// Share of light on a floor at a distance from an endless wall that takes 1 - (d / radius)^2 of what comes over d.
fn beside_wall(distance_m: f64, radius_m: f64) -> f64 {
    let steps = 400;
    let mut lost = 0.0;
    for ring in 0..steps {
        // Equal shares of the cosine-weighted hemisphere.
        let sine = ((f64::from(ring) + 0.5) / f64::from(steps)).sqrt();
        for turn in 0..steps {
            let towards = sine * (TAU * (f64::from(turn) + 0.5) / f64::from(steps)).cos();
            if towards > 0.0 {
                lost += (1.0 - (distance_m / towards / radius_m).powi(2)).max(0.0);
            }
        }
    }
    1.0 - lost / f64::from(steps * steps)
}

#[test]
fn a_corner_darkens_as_its_closed_form_says() {
    let (size, radius_m) = ([128, 128], 0.5);
    // Half a metre of wall or floor is 45 pixels of height.
    let px_per_m = 64.0 * std::f64::consts::FRAC_1_SQRT_2;
    headless(|device| {
        let mut errors = Vec::new();
        for (slices, steps) in [(2, 6), (8, 16)] {
            let asked = ScreenOcclusion { radius_m: Some(radius_m as f32), slices, steps };
            let occlusion = device.picture(&corner(), &frame(size, asked)).aovs.occlusion;
            let mut worst = 0.0f64;
            for row in 64..120 {
                let distance_m = (f64::from(row) + 0.5 - 64.0) / px_per_m;
                let expected = beside_wall(distance_m, radius_m);
                let found = f64::from(occlusion[row as usize * 128 + 64]);
                worst = worst.max((found - expected).abs());
                assert!(distance_m < radius_m || found > 0.999, "{found} beyond the radius");
            }
            errors.push(worst);
        }
        // Steps that fall between two samples miss a part of the wall; more of them miss less.
        assert!(errors[0] < 0.08 && errors[1] < 0.03, "{errors:?}");
    });
}

#[test]
fn what_stands_alone_stays_as_it_is() {
    let mut stage = Stage::default();
    stage.parallel_camera(1.0, Vec3::Z, Vec3::Y);
    let material = stage.material(plain());
    stage.object(sphere(0.8, 48), material, at(Vec3::ZERO));
    let scene = stage.scene();
    headless(|device| {
        let asked = ScreenOcclusion { radius_m: Some(0.5), ..ScreenOcclusion::default() };
        let occlusion = device.picture(&scene, &frame([96, 96], asked)).aovs.occlusion;
        let least = occlusion.iter().copied().fold(1.0, f32::min);
        // The facets stand a little over the tangent planes of the smooth normals.
        assert!(least > 0.99, "{least}");
    });
}

#[test]
fn nothing_beyond_the_radius_leaves_a_halo() {
    // A square far before a wall.
    let mut stage = Stage::front(1.0);
    let material = stage.material(plain());
    stage.object(quad(4.0, 4.0), material, at(Vec3::NEG_Z));
    stage.object(quad(0.4, 0.4), material, at(Vec3::Z));
    let scene = stage.scene();
    headless(|device| {
        let asked = ScreenOcclusion { radius_m: Some(0.5), ..ScreenOcclusion::default() };
        let occlusion = device.picture(&scene, &frame([96, 96], asked)).aovs.occlusion;
        assert!(occlusion.iter().all(|share| *share == 1.0));
    });
}

#[test]
fn ambient_light_alone_darkens_and_everything_off_is_as_before() {
    headless(|device| {
        let mut scene = corner();
        // A white corner is lit by its own walls.
        scene.materials_mut()[0].standard.base_color = Vec4::new(0.1, 0.1, 0.1, 1.0);
        let off = device.picture(&scene, &options([64, 64], 4));
        let asked = ScreenOcclusion { radius_m: Some(0.5), ..ScreenOcclusion::default() };
        let on = device.picture(&scene, &FrameOptions { screen_occlusion: Some(asked), ..options([64, 64], 4) });
        let at = |picture: &vair::render::Picture, row: u32| picture.radiance(32, row).x;
        assert!(at(&on, 33) < 0.8 * at(&off, 33), "the corner: {} of {}", at(&on, 33), at(&off, 33));
        assert!((at(&on, 62) / at(&off, 62) - 1.0).abs() < 2e-3, "the open floor");
        assert_eq!(device.picture(&scene, &options([64, 64], 4)).rgba, off.rgba, "off again");
    });
}
