//! What blends lies over each other as it lies in space, at every sample: where sheets cross, in whatever order the file
//! names them, in colours.

use crate::headless::{Headless, headless};
use crate::limit::{all_hold, close, within};
use crate::scenes::three_lights;
use crate::stage::{Stage, at, options, plain, quad, unlit};
use glam::{DVec3, Quat, Vec3, Vec4};
use std::f32::consts::FRAC_PI_4;
use vair::asset::procedural::sphere;
use vair::asset::{AlphaMode, Material, MaterialExtensions, Specular, Transform, Transmission, Volume};
use vair::material::{Blend, Family, Fur, Gauze, Length};
use vair::measure::twin::transparency::{Layer, composed};
use vair::render::{FrameOptions, FrameSetup, Pass, Transparency};
use vair::scene::Scene;

fn blended(color: Vec4) -> Material {
    Material { alpha_mode: AlphaMode::Blend, ..unlit(color) }
}

/// As the truth sees it, at a distance.
fn layer(color: Vec4, distance: f64) -> Layer {
    let (rgb, opacity) = (color.truncate().as_dvec3(), f64::from(color.w));
    Layer { distance, radiance: rgb * opacity, transmittance: DVec3::splat(1.0 - opacity) }
}

fn turned(rotation: Quat) -> Transform {
    Transform::Trs { translation: Vec3::ZERO, rotation, scale: Vec3::ONE }
}

const RED: Vec4 = Vec4::new(0.9, 0.1, 0.2, 0.5);
const BLUE: Vec4 = Vec4::new(0.1, 0.3, 0.8, 0.75);

/// Two sheets that cross in the middle of the picture; red is nearer on the right.
fn crossed() -> Scene {
    let mut stage = Stage::front(0.5);
    for (color, angle) in [(BLUE, FRAC_PI_4), (RED, -FRAC_PI_4)] {
        let material = stage.material(blended(color));
        stage.object(quad(6.0, 1.0), material, turned(Quat::from_rotation_y(angle)));
    }
    stage.scene()
}

#[test]
fn crossed_sheets_lie_over_each_other_on_either_side_of_the_line() {
    let over = |near, far| composed(&[layer(near, 1.0), layer(far, 2.0)], DVec3::ZERO);
    let (left, right) = (over(BLUE, RED), over(RED, BLUE));
    assert!((left - right).abs().max_element() > 0.1, "the order does not show");
    headless(|device| {
        for msaa in [1, 4] {
            let picture = device.picture(&crossed(), &options([33, 5], msaa));
            let opacity = DVec3::splat(1.0 - 0.5 * 0.25);
            all_hold((0..33).filter(|x| *x != 16).flat_map(|x| {
                let (found, expected) = (picture.radiance(x, 2), if x < 16 { left } else { right });
                let what = format!("column {x} at {msaa} samples");
                [close(&what, found, expected), close(&what, Vec4::splat(found.w), opacity)]
            }));
            if msaa == 4 {
                // Two of the pixel's samples lie on either side.
                all_hold([close("on the line", picture.radiance(16, 2), 0.5 * (left + right))]);
            }
        }
        // Sorted whole, one of the sides is wrong: what this is for.
        let whole = FrameOptions { transparency: Transparency::Sorted, ..options([33, 5], 1) };
        let picture = device.picture(&crossed(), &whole);
        let wrong = [close("", picture.radiance(4, 2), left), close("", picture.radiance(28, 2), right)];
        assert_eq!(wrong.iter().filter(|side| side.is_err()).count(), 1);
    });
}

#[test]
fn three_balls_in_one_another_are_six_layers() {
    let colors = [Vec4::new(0.9, 0.1, 0.1, 0.3), Vec4::new(0.1, 0.8, 0.2, 0.5), Vec4::new(0.2, 0.2, 1.0, 0.6)];
    let radii = [0.9, 0.6, 0.3];
    let mut stage = Stage::front(1.0);
    for (color, radius_m) in colors.into_iter().zip(radii) {
        let material = stage.material(Material { double_sided: true, ..blended(color) });
        stage.object(sphere(radius_m, 16), material, at(Vec3::ZERO));
    }
    let layers: Vec<_> = colors
        .iter()
        .zip(radii)
        .flat_map(|(color, radius)| [layer(*color, -f64::from(radius)), layer(*color, f64::from(radius))])
        .collect();
    let scene = stage.scene();
    headless(|device| {
        for msaa in [1, 4] {
            let (picture, report) = device.reported(&scene, &options([32, 32], msaa));
            all_hold([close("middle", picture.radiance(16, 16), composed(&layers, DVec3::ZERO))]);
            let lists = report.lists.unwrap();
            assert!(lists.fragments > 32 * 32 && lists.entries >= lists.fragments, "did not grow: {lists:?}");
        }
    });
}

#[test]
fn a_sheet_through_an_opaque_ball_shows_where_it_stands_out() {
    let ball = Vec3::new(0.2, 0.6, 0.3);
    let mut stage = Stage::front(1.0);
    let opaque = stage.material(unlit(ball.extend(1.0)));
    stage.object(sphere(0.8, 64), opaque, at(Vec3::ZERO));
    let sheet = stage.material(blended(RED));
    // Through the middle, nearer on the right.
    stage.object(quad(2.0, 2.0), sheet, turned(Quat::from_rotation_y(-FRAC_PI_4)));
    let scene = stage.scene();
    let over = composed(&[layer(RED, 1.0)], ball.as_dvec3());
    let alone = composed(&[layer(RED, 1.0)], DVec3::ZERO);
    // The sheet leaves the ball where x = z: at 0.8 / sqrt 2.
    let leaves = 0.8 / 2f64.sqrt();
    headless(|device| {
        for msaa in [1, 4] {
            let picture = device.picture(&scene, &options([65, 65], msaa));
            all_hold((0..65).filter_map(|column| {
                let x = (f64::from(column) + 0.5) / 32.5 - 1.0;
                let expected = match x {
                    _ if x.abs() > 0.85 => alone,
                    _ if x.abs() > 0.75 || (x - leaves).abs() < 0.06 => return None,
                    _ if x > leaves => over,
                    _ => ball.as_dvec3(),
                };
                Some(close(&format!("column {column} at {msaa} samples"), picture.radiance(column, 32), expected))
            }));
        }
    });
}

#[test]
fn a_sheet_in_the_plane_of_an_opaque_one_is_over_it_everywhere() {
    let wall = Vec3::new(0.8, 0.7, 0.1);
    for angle in [0.0, 0.7, 1.4] {
        let mut stage = Stage::front(0.4);
        let rotation = Quat::from_rotation_y(angle) * Quat::from_rotation_x(0.3);
        let (opaque, sheet) = (stage.material(unlit(wall.extend(1.0))), stage.material(blended(BLUE)));
        stage.object(quad(6.0, 6.0), opaque, turned(rotation));
        stage.object(quad(6.0, 6.0), sheet, turned(rotation));
        let scene = stage.scene();
        let expected = composed(&[layer(BLUE, 0.0)], wall.as_dvec3());
        headless(|device| {
            for msaa in [1, 4] {
                let picture = device.picture(&scene, &options([24, 24], msaa));
                let pixels = (0..24 * 24).map(|pixel| (pixel % 24, pixel / 24));
                all_hold(pixels.map(|(x, y)| {
                    close(&format!("{x}, {y} at {angle}, {msaa} samples"), picture.radiance(x, y), expected)
                }));
            }
        });
    }
}

/// Clear glass that only tints: it reflects nothing.
fn glass(tint: Vec3) -> Material {
    let specular = Specular { factor: 0.0, texture: None, color: Vec3::ONE, color_texture: None };
    let extensions = MaterialExtensions {
        specular: Some(Box::new(specular)),
        transmission: Some(Box::new(Transmission { factor: 1.0, texture: None })),
        ..MaterialExtensions::default()
    };
    Material { base_color: tint.extend(1.0), extensions, ..plain() }
}

#[test]
fn a_pane_of_coloured_glass_multiplies_channels() {
    let (wall, tint) = (Vec3::new(0.9, 0.6, 0.4), Vec3::new(0.9, 0.3, 0.05));
    let (left_of_white, distance_m, thickness, scale) = (Vec3::new(0.5, 0.25, 1.0), 2.0, 1.5, 0.5);
    let mut stage = Stage::front(0.5);
    let opaque = stage.material(unlit(wall.extend(1.0)));
    stage.object(quad(2.0, 0.5), opaque, at(-Vec3::Z));
    let thin = stage.material(glass(tint));
    stage.object(quad(0.5, 0.5), thin, at(Vec3::X * -0.5));
    let volume = Volume {
        thickness,
        thickness_texture: None,
        attenuation_color: left_of_white,
        attenuation_distance_m: distance_m,
    };
    let mut thick = glass(tint);
    thick.extensions.volume = Some(Box::new(volume));
    let thick = stage.material(thick);
    let place = Transform::Trs { translation: Vec3::X * 0.5, rotation: Quat::IDENTITY, scale: Vec3::splat(scale) };
    stage.object(quad(1.0, 1.0), thick, place);
    let scene = stage.scene();
    let through = (wall * tint).as_dvec3();
    let body = left_of_white.as_dvec3().powf(f64::from(thickness * scale / distance_m));
    headless(|device| {
        for msaa in [1, 4] {
            let picture = device.picture(&scene, &options([16, 8], msaa));
            // A transmittance has steps of 1/4095.
            all_hold([
                within("pane", picture.radiance(4, 4), through, 2e-3, 0.5 / 4095.0),
                within("body", picture.radiance(12, 4), through * body, 2e-3, 0.5 / 4095.0),
            ]);
        }
    });
}

/// Four objects that cross each other: a coat that blends, a ball of gauze, a sheet and a pane.
fn crossing(order: [usize; 4]) -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(1.2, Vec3::new(0.3, 0.4, 1.0), Vec3::Y);
    three_lights(&mut stage);
    let mut dressed = Vec::new();
    for index in order {
        let tilt = Quat::from_rotation_y(index as f32 * 0.8 - 0.9);
        let (primitive, material, transform) = match index {
            0 => (sphere(0.4, 16), plain(), at(Vec3::new(0.2, 0.0, 0.1))),
            1 => (sphere(0.7, 16), Material { double_sided: true, ..plain() }, at(Vec3::ZERO)),
            2 => (quad(1.0, 0.8), blended(RED), turned(tilt)),
            _ => (quad(0.8, 1.0), glass(Vec3::new(0.2, 0.9, 0.5)), turned(tilt)),
        };
        let material = stage.material(material);
        stage.object(primitive, material, transform);
        dressed.push((material, index));
    }
    let mut scene = stage.scene();
    for (material, index) in dressed {
        let material = &mut scene.materials_mut()[material];
        match index {
            0 => {
                let (length, strand_spacing) = (Length::Relative(0.3), Length::Relative(0.08));
                material.fur = Some(Fur { blend: Blend::Blend, length, strand_spacing, layers: 4, ..Fur::default() });
            }
            1 => material.family = Some(Family::Gauze(Gauze { weave_density: 3.0, ..Gauze::default() })),
            _ => {}
        }
    }
    scene
}

fn orders() -> Vec<[usize; 4]> {
    let all = (0..256).map(|number: usize| [number >> 6 & 3, number >> 4 & 3, number >> 2 & 3, number & 3]);
    all.filter(|order| (0..4).all(|index| order.contains(&index))).collect()
}

#[test]
fn twenty_four_orders_of_the_file_give_the_same_bytes() {
    assert_eq!(orders().len(), 24);
    headless(|device| {
        for msaa in [1, 4] {
            let mut first = None;
            for order in orders() {
                let picture = device.picture(&crossing(order), &options([40, 40], msaa));
                let bytes: Vec<Vec4> = (0..40 * 40).map(|pixel| picture.radiance(pixel % 40, pixel / 40)).collect();
                assert!(bytes.iter().any(|pixel| pixel.w > 0.0 && pixel.w < 1.0));
                assert!(*first.get_or_insert(bytes.clone()) == bytes, "{order:?} looks otherwise at {msaa}");
            }
        }
    });
}

/// A coat that blends and a sheet of gauze at that depth.
fn coat_and_gauze(depth_m: f32) -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(1.0, Vec3::Z, Vec3::Y);
    three_lights(&mut stage);
    let skin = stage.material(plain());
    stage.object(sphere(0.5, 24), skin, at(Vec3::ZERO));
    let sheet = stage.material(Material { double_sided: true, ..plain() });
    stage.object(quad(0.9, 0.9), sheet, at(Vec3::Z * depth_m));
    let mut scene = stage.scene();
    let (length, strand_spacing) = (Length::Relative(0.4), Length::Relative(0.08));
    let fur = Fur { blend: Blend::Blend, length, strand_spacing, layers: 8, ..Fur::default() };
    scene.materials_mut()[skin].fur = Some(fur);
    scene.materials_mut()[sheet].family = Some(Family::Gauze(Gauze { weave_density: 2.0, ..Gauze::default() }));
    scene
}

/// Largest difference of two pictures.
fn difference(device: &mut Headless, scene: &Scene, msaa: u32, methods: [Transparency; 2]) -> f32 {
    let [a, b] =
        methods.map(|transparency| device.picture(scene, &FrameOptions { transparency, ..options([48, 48], msaa) }));
    let pixels = (0..48 * 48).map(|pixel| (pixel % 48, pixel / 48));
    pixels.map(|(x, y)| (a.radiance(x, y) - b.radiance(x, y)).abs().max_element()).fold(0.0, f32::max)
}

#[test]
fn gauze_over_fur_and_fur_over_gauze_are_what_sorting_objects_gives_where_that_is_right() {
    use Transparency::{PerPixel, Sorted};
    headless(|device| {
        for msaa in [1, 4] {
            for depth_m in [1.5, -1.5] {
                let found = difference(device, &coat_and_gauze(depth_m), msaa, [PerPixel, Sorted]);
                // Sorting blends a sheet and eight shells of two sides in half floats, which some devices cut.
                assert!(found < 17.0 / 1024.0, "{found} at {depth_m} m, {msaa} samples");
            }
            let within = difference(device, &coat_and_gauze(0.45), msaa, [PerPixel, Sorted]);
            assert!(within > 0.05, "a sheet within the coat looks sorted: {within}");
        }
    });
}

#[test]
fn more_layers_than_lists_hold_stay_plausible_and_are_reported() {
    let mut stage = Stage::front(0.5);
    for index in 0..40 {
        let color = Vec4::new(0.2 + 0.6 * (index % 2) as f32, 0.5, 0.3, 0.1);
        let material = stage.material(blended(color));
        stage.object(quad(0.5, 0.5), material, at(Vec3::Z * index as f32 * 0.1));
    }
    let scene = stage.scene();
    headless(|device| {
        let (picture, report) = device.reported(&scene, &options([8, 8], 1));
        let lists = report.lists.unwrap();
        assert_eq!((lists.fragments, lists.entries), (40 * 64, 32 * 64));
        let opacity = 1.0 - 0.9f64.powi(40);
        for pixel in 0..64 {
            let found = picture.radiance(pixel % 8, pixel / 8);
            // No layer is lost; what is wrong is which of them are farthest.
            assert!((f64::from(found.w) - opacity).abs() < 2e-3, "{found} of {opacity}");
            let color = found.truncate() / found.w;
            assert!((0.2..0.8).contains(&color.x) && (color.y - 0.5).abs() < 5e-3, "{color}");
        }
    });
}

#[test]
fn what_blends_changes_only_what_it_covers() {
    let scene = |blends: bool| {
        let mut stage = Stage::front(1.0);
        three_lights(&mut stage);
        let ball = stage.material(plain());
        stage.object(sphere(0.9, 24), ball, at(Vec3::ZERO));
        if blends {
            let sheet = stage.material(blended(RED));
            stage.object(quad(0.3, 0.3), sheet, at(Vec3::new(0.7, 0.7, 2.0)));
        }
        stage.scene()
    };
    let plan = |blends| {
        FrameSetup::new(&scene(blends), &options([32, 32], 4)).unwrap_or_else(|error| panic!("{error}")).staging.plan
    };
    let (without, with) = (plan(false), plan(true));
    assert!(without.draws_of(Pass::OitBuild).is_empty() && !without.passes.contains(&Pass::OitResolve));
    assert!(!with.draws_of(Pass::OitBuild).is_empty() && with.passes.contains(&Pass::OitResolve));
    headless(|device| {
        for msaa in [1, 4] {
            let [with, without] = [true, false].map(|blends| device.picture(&scene(blends), &options([32, 32], msaa)));
            let same = (0..32 * 32).map(|pixel| (pixel % 32, pixel / 32)).filter(|&(x, y)| x < 20 || y > 11);
            for (x, y) in same {
                assert_eq!(with.radiance(x, y), without.radiance(x, y), "{x}, {y} at {msaa} samples");
            }
            assert_ne!(with.radiance(27, 5), without.radiance(27, 5));
        }
    });
}
