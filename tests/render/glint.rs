//! Flakes are where their twin says, shine as it says, and zooming out changes their sum no more than chance does.

use crate::headless::headless;
use crate::scenes::three_lights;
use crate::stage::{Stage, at, front_position, options, plain, quad};
use crate::surface::AMBIENT;
use glam::{DVec2, DVec3, Quat, Vec3, Vec4};
use vair::asset::procedural::sphere;
use vair::asset::{LightKind, Material, Transform};
use vair::material::{Family, Glint};
use vair::measure::twin::albedo::Fit;
use vair::measure::twin::ggx;
use vair::measure::twin::glint::{self, Covered, Footprint};
use vair::measure::twin::standard::Surface;
use vair::render::{FrameSetup, PipelineSpec};
use vair::scene::Scene;
use vair::shader::{Defines, ShaderFile, ShaderKey};

const TO_LIGHTS: [Vec3; 2] = [Vec3::new(0.1, 0.15, 0.98), Vec3::new(-0.3, 0.0, 0.95)];
const CLOTH: Vec4 = Vec4::new(0.3, 0.05, 0.1, 1.0);

fn sequins() -> Glint {
    Glint { density: 14.0, coverage: 0.6, color_variation: 0.5, ..Glint::default() }
}

/// A quad with flakes, seen from the front by a camera that shows `half_m` above and below the middle.
fn front(glint: Glint, half_m: f32, transform: Transform) -> Scene {
    let mut stage = Stage::front(half_m);
    let material = stage.material(Material { base_color: CLOTH, roughness: 0.6, ..plain() });
    stage.object(quad(2.0, 2.0), material, transform);
    for to_light in TO_LIGHTS {
        stage.light(LightKind::Directional, Vec3::new(0.2, 0.3, 0.4), Vec3::ZERO, to_light.normalize());
    }
    let mut scene = stage.scene();
    scene.materials_mut()[material].family = Some(Family::Glint(glint));
    scene
}

/// Sequins, glitter and lurex.
pub fn glint_balls() -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(0.56, Vec3::new(0.0, 0.2, 1.0), Vec3::Y);
    let flakes = |density, coverage, flake_color: [f32; 3]| Glint {
        density,
        coverage,
        flake_color: Vec3::from(flake_color),
        color_variation: 0.4,
        ..Glint::default()
    };
    let kinds = [
        flakes(9.0, 0.85, [0.9, 0.5, 0.6]),
        flakes(13.0, 0.5, [0.95, 0.93, 0.88]),
        flakes(18.0, 0.4, [1.0, 0.78, 0.35]),
    ];
    let mut dressed = Vec::new();
    for (column, glint) in kinds.into_iter().enumerate() {
        let material = stage.material(Material { base_color: Vec4::new(0.05, 0.02, 0.04, 1.0), ..plain() });
        stage.object(sphere(0.28, 16), material, at(Vec3::X * 0.58 * (column as f32 - 1.0)));
        dressed.push((material, glint));
    }
    three_lights(&mut stage);
    let mut scene = stage.scene();
    for (material, glint) in dressed {
        scene.materials_mut()[material].family = Some(Family::Glint(glint));
    }
    scene
}

#[test]
fn a_quad_shows_the_flakes_of_its_twin() {
    let (glint, size) = (sequins(), [64, 64]);
    let flakes = glint.flakes();
    let fit = Fit::shipped();
    let covered = Covered {
        cloth: Surface { base_color: CLOTH.truncate().as_dvec3(), metallic: 0.0, roughness: f64::from(0.6f32) },
        color: glint.flake_color.as_dvec3(),
        roughness: glint.flake_roughness.into(),
        coverage: glint.coverage.into(),
        intensity: glint.intensity.into(),
    };
    headless(|device| {
        // Discs of 10 pixels, of two, and many in one pixel.
        for half_m in [0.04, 0.2, 1.9] {
            let picture = device.picture(&front(glint.clone(), half_m, at(Vec3::ZERO)), &options(size, 1));
            let pixel = 2.0 * f64::from(half_m) / f64::from(size[0]) * f64::from(flakes.cells_per_metre);
            let (mut error, mut lit) = (0.0, 0);
            for (x, y) in (0..size[0]).flat_map(|x| (0..size[1]).map(move |y| (x, y))) {
                let place = front_position([x, y], size, half_m.into()) * f64::from(flakes.cells_per_metre);
                let footprint = Footprint::new(&flakes, place.truncate(), DVec2::X * pixel, DVec2::NEG_Y * pixel);
                let cover = glint::cover(&flakes, &glint::discs(&flakes, &footprint, 2), glint::apart(&footprint));
                let mut expected = covered.ambient(&fit, 1.0, cover) * AMBIENT;
                for to_light in TO_LIGHTS {
                    let l = to_light.normalize().as_dvec3();
                    let square = glint::square(ggx::half_vector(DVec3::Z, l), flakes.alpha.into());
                    let flash = glint::flash(&flakes, &footprint, 2, square, 0.0);
                    expected +=
                        covered.brdf_times_cosine(&fit, DVec3::Z, l, cover.1, flash) * DVec3::new(0.2, 0.3, 0.4);
                }
                let found = picture.radiance(x, y).truncate().as_dvec3();
                let off = (found - expected) / (expected + 0.1);
                error += off.length_squared() / 3.0 / f64::from(size[0] * size[1]);
                lit += u32::from(expected.max_element() > 1.0);
            }
            // Half floats alone give 1 / (12 * 2^22) = 2e-8; the rest is where edges fall within a rounding.
            println!("half_m {half_m}: relMSE {error:e}, {lit} pixels flash");
            assert!(error <= 1e-6, "half_m {half_m}: relMSE {error:e}");
        }
    });
}

fn mean(picture: &vair::render::Picture, size: [u32; 2]) -> Vec3 {
    let pixels = (0..size[0] * size[1]).map(|index| picture.radiance(index % size[0], index / size[0]).truncate());
    pixels.sum::<Vec3>() / (size[0] * size[1]) as f32
}

#[test]
fn glint_mean_stays_when_zooming_out() {
    let glint = Glint { density: 22.0, ..Glint::default() };
    let (size, zooms) = ([128, 128], 9);
    headless(|device| {
        let means: Vec<_> = (0..zooms)
            .map(|zoom| {
                let half_m = 0.15 * 1.35f32.powi(zoom);
                mean(&device.picture(&front(glint.clone(), half_m, at(Vec3::ZERO)), &options(size, 1)), size)
            })
            .collect();
        let last = means[zooms as usize - 1];
        println!("{means:?}");
        for found in &means {
            assert!(((found / last) - 1.0).abs().max_element() <= 0.02, "{means:?}");
        }
    });
}

#[test]
fn flakes_turn_with_the_cloth() {
    // Turned by 90 degrees with camera and light straight ahead, the picture turns with it, texel for texel.
    let glint = sequins();
    let scene = |turn: f32| {
        let rotation = Quat::from_rotation_z(turn.to_radians());
        let mut stage = Stage::front(0.1);
        let material = stage.material(Material { base_color: CLOTH, ..plain() });
        stage.object(quad(1.0, 1.0), material, Transform::Trs { translation: Vec3::ZERO, rotation, scale: Vec3::ONE });
        stage.light(LightKind::Directional, Vec3::ONE, Vec3::ZERO, Vec3::Z);
        let mut scene = stage.scene();
        scene.materials_mut()[material].family = Some(Family::Glint(glint.clone()));
        scene
    };
    headless(|device| {
        let (still, turned) =
            (device.picture(&scene(0.0), &options([64, 64], 1)), device.picture(&scene(90.0), &options([64, 64], 1)));
        let mut far = 0;
        for (x, y) in (0..64).flat_map(|x| (0..64).map(move |y| (x, y))) {
            let (a, b) = (still.radiance(x, y), turned.radiance(y, 63 - x));
            far += u32::from(!(a - b).abs().cmple(Vec4::splat(0.01) + 0.02 * a.abs()).all());
        }
        assert!(far <= 8, "{far} of 4096 pixels differ");
    });
}

#[test]
fn cloth_without_a_mask_fetches_nothing() {
    let scene = front(sequins(), 0.5, at(Vec3::ZERO));
    let plan = FrameSetup::new(&scene, &options([4, 4], 1)).unwrap().staging.plan;
    assert!(plan.textures.is_empty() && plan.fallbacks.is_empty());
    let PipelineSpec { vertex, fragment, .. } = plan.pipelines[0];
    assert_eq!(fragment, ShaderKey::new(ShaderFile::GlintFrag, Defines::TANGENT));
    assert_eq!(vertex, ShaderKey::new(ShaderFile::StandardVert, Defines::TANGENT | Defines::REST));
}

#[test]
fn extremes_stay_finite() {
    headless(|device| {
        for (density, coverage, roughness, variation) in [
            (0.0, 0.0, 0.0, 0.0),
            (32.0, 0.9, 0.0, 1.0),
            (0.0, 0.9, 1.0, 1.0),
            (20.0, 0.9, 0.0, 0.0),
            (32.0, 1e-7, 1.0, 1.0),
        ] {
            for microfacet_roughness in [0.0, 1.0] {
                for intensity in [1e-38, 1.0, 1e38] {
                    let glint = Glint {
                        density,
                        coverage,
                        flake_roughness: roughness,
                        microfacet_roughness,
                        color_variation: variation,
                        ..Glint::default()
                    };
                    let mut stage = Stage::front(0.6);
                    let material = stage.material(Material { base_color: CLOTH, ..plain() });
                    // Grazing at its rim, with tangents that lie along the normals.
                    let mut ball = sphere(0.5, 8);
                    ball.vertices.tangents = ball.vertices.normals.iter().map(|normal| normal.extend(1.0)).collect();
                    stage.object(ball, material, at(Vec3::ZERO));
                    for to_light in [Vec3::Z, Vec3::NEG_Z, Vec3::X] {
                        stage.light(LightKind::Directional, Vec3::splat(intensity), Vec3::ZERO, to_light);
                    }
                    let mut scene = stage.scene();
                    scene.materials_mut()[material].family = Some(Family::Glint(glint));
                    let picture = device.picture(&scene, &options([48, 48], 1));
                    let is_finite = |index: u32| picture.radiance(index % 48, index / 48).is_finite();
                    assert!((0..48 * 48).all(is_finite), "{density} {coverage} {roughness} {intensity}");
                }
            }
        }
    });
}
