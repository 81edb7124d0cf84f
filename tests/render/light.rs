//! Point and spot lights fall off as KHR_lights_punctual says, pixel by pixel.

use crate::headless::headless;
use crate::limit::{all_hold, close};
use crate::stage::{Stage, at, front_position, options, plain, quad};
use crate::surface::{AMBIENT, radiance};
use glam::{DVec3, Vec3};
use vair::asset::{LightKind, Material};
use vair::material::{Fur, Length};
use vair::measure::twin::light::{cone, range_window};
use vair::measure::twin::standard::Surface;

#[test]
fn irradiance_follows_distance_range_and_cone() {
    let size = [16, 16];
    let position = Vec3::new(0.3, -0.2, 0.7);
    let to_light = Vec3::new(0.2, 0.1, 1.0).normalize();
    let intensity = Vec3::new(2.0, 1.0, 0.5);
    let (inner_angle, outer_angle) = (0.35, 0.9);
    let kinds = [
        LightKind::Point { range_m: None },
        LightKind::Point { range_m: Some(1.1) },
        LightKind::Spot { range_m: None, inner_angle, outer_angle },
        LightKind::Spot { range_m: Some(1.1), inner_angle, outer_angle },
    ];
    headless(|device| {
        for kind in kinds {
            let mut stage = Stage::front(1.0);
            let material = stage.material(Material { roughness: 0.8, ..plain() });
            stage.object(quad(1.0, 1.0), material, at(Vec3::ZERO));
            stage.light(kind, intensity, position, to_light);
            let picture = device.picture(&stage.scene(), &options(size, 1));

            let surface = Surface { base_color: DVec3::ONE, metallic: 0.0, roughness: f64::from(0.8f32) };
            let mut least = f64::INFINITY;
            let checks: Vec<_> = (0..size[0] * size[1])
                .map(|index| {
                    let pixel = [index % size[0], index / size[0]];
                    let away = position.as_dvec3() - front_position(pixel, size, 1.0);
                    let (distance_m, l) = (away.length(), away.normalize());
                    let (range_m, spot) = match kind {
                        LightKind::Spot { range_m, .. } => (range_m, true),
                        LightKind::Point { range_m } => (range_m, false),
                        LightKind::Directional => (None, false),
                    };
                    let window = range_m.map_or(1.0, |range_m| range_window(distance_m.powi(2), range_m.into()));
                    let angle = l.dot(to_light.as_dvec3()).acos();
                    let cone = if spot { cone(angle, inner_angle.into(), outer_angle.into()) } else { 1.0 };
                    let share = window * cone / distance_m.powi(2);
                    least = least.min(share);
                    let expected = radiance(surface, AMBIENT, DVec3::Z, DVec3::Z, l, intensity.as_dvec3() * share);
                    close(&format!("{kind:?} at {pixel:?}"), picture.radiance(pixel[0], pixel[1]), expected)
                })
                .collect();
            let ends = !matches!(kind, LightKind::Point { range_m: None });
            assert_eq!(least == 0.0, ends, "the picture reaches beyond the light's end where it has one");
            all_hold(checks);
        }
    });
}

/// What light adds to a frame, channel by channel, over the ambient.
#[test]
fn frames_are_linear_in_light_and_dark_without() {
    let scene = |intensity: Vec3| {
        let mut stage = Stage::front(1.0);
        let material = stage.material(Material { roughness: 0.6, ..plain() });
        stage.object(quad(0.7, 0.7), material, at(Vec3::ZERO));
        stage.light(LightKind::Directional, intensity, Vec3::Z, Vec3::new(0.3, 0.2, 1.0).normalize());
        let mut scene = stage.scene();
        scene.materials_mut()[material].fur = Some(Fur { length: Length::Metres(0.1), ..Fur::default() });
        scene
    };
    headless(|device| {
        let mut lit = |intensity| device.picture(&scene(intensity), &options([32, 32], 4)).radiance;
        let (dark, once, twice, blue) =
            (lit(Vec3::ZERO), lit(Vec3::splat(0.5)), lit(Vec3::ONE), lit(Vec3::new(0.0, 0.0, 0.5)));
        let brightest = once.iter().zip(&dark).map(|(once, dark)| (once - dark).x).fold(0.0f32, f32::max);
        assert!(brightest > 0.01, "the light is seen");
        for index in 0..dark.len() {
            let [added, doubled, of_blue] = [&once, &twice, &blue].map(|lit| (lit[index] - dark[index]).truncate());
            // Three half floats were rounded.
            let rounding = 3.0 * twice[index].max_element() / 1024.0;
            assert!((doubled - 2.0 * added).abs().max_element() <= rounding, "{doubled} for twice {added}");
            assert_eq!((of_blue.x, of_blue.y), (0.0, 0.0), "blue light adds blue alone");
        }
    });
}
