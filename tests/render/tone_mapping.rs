//! From linear radiance to the bytes of the picture; formats, sizes and samples of the targets.

use crate::headless::headless;
use crate::scenes::balls;
use crate::stage::{Stage, at, options, plain, quad, unlit};
use glam::{DVec3, Quat, Vec3, Vec4};
use vair::asset::{LightKind, Material, Transform};
use vair::measure::twin::color::srgb_from_linear;
use vair::measure::twin::tone_mapping;
use vair::render::{Background, FrameOptions, HdrFormat, Tonemap};

/// The twin of a tone curve.
fn curve(operator: Tonemap, radiance: DVec3) -> DVec3 {
    match operator {
        Tonemap::None => tone_mapping::none(radiance),
        Tonemap::Aces => tone_mapping::aces(radiance),
        Tonemap::Agx => tone_mapping::agx(radiance),
        Tonemap::Neutral => tone_mapping::neutral(radiance),
    }
}

#[test]
fn tone_curves_and_exposure_are_those_of_the_twins() {
    // One column a colour, from darkness to far beyond white.
    let colors: Vec<Vec3> =
        (0..16).map(|i| Vec3::new(1.0, 0.6, 0.2) * 0.002 * 2f32.powi(i) + Vec3::splat(0.001 * i as f32)).collect();
    let size = [colors.len() as u32, 1];
    let mut stage = Stage::front(0.5);
    for (index, color) in colors.iter().enumerate() {
        let material = stage.material(unlit(color.extend(1.0)));
        stage.object(quad(0.5, 0.5), material, at(Vec3::X * (index as f32 + 0.5 - 0.5 * colors.len() as f32)));
    }
    let scene = stage.scene();
    headless(|device| {
        for operator in [Tonemap::None, Tonemap::Aces, Tonemap::Agx, Tonemap::Neutral] {
            for exposure_ev in [-2.0, 0.0, 1.5] {
                let frame = FrameOptions { tonemap: operator, exposure_ev, ..options(size, 1) };
                let picture = device.picture(&scene, &frame);
                for (x, color) in colors.iter().enumerate() {
                    // What the target holds: the colour as half floats.
                    let radiance = picture.radiance(x as u32, 0).truncate();
                    assert!((radiance - *color).length() <= 1e-3 * color.length(), "{radiance} is not {color}");
                    let display = curve(operator, radiance.as_dvec3() * 2f64.powf(exposure_ev.into()));
                    let pixel = picture.pixel(x as u32, 0);
                    for channel in 0..3 {
                        let expected = 255.0 * srgb_from_linear(display[channel]);
                        let found = f64::from(pixel[channel]);
                        assert!(
                            (found - expected).abs() <= 1.0,
                            "{operator:?} {exposure_ev} {color}: {pixel:?}, {expected}"
                        );
                    }
                }
            }
        }
    });
}

#[test]
fn the_environment_is_tone_mapped_and_a_colour_is_not() {
    let empty = || Stage::front(0.5).scene();
    headless(|device| {
        let frame = FrameOptions { tonemap: Tonemap::Aces, exposure_ev: 2.0, ..options([2, 2], 1) };
        let ambient = crate::surface::AMBIENT;
        for (background, linear) in [
            (Background::Environment, tone_mapping::aces(DVec3::splat(4.0 * ambient)).x),
            (Background::Color(Vec3::splat(0.3)), 0.3),
        ] {
            let pixel = device.picture(&empty(), &FrameOptions { background, ..frame.clone() }).pixel(1, 1);
            let expected = 255.0 * srgb_from_linear(linear);
            assert!((f64::from(pixel[1]) - expected).abs() <= 1.0, "{background:?}: {pixel:?}, {expected}");
        }
    });
}

#[test]
fn the_small_format_holds_the_same_light_within_its_bits() {
    headless(|device| {
        let scene = balls();
        let frame = options([96, 64], 1);
        let half = device.picture(&scene, &frame);
        let small = device.picture(&scene, &FrameOptions { hdr_format: HdrFormat::B10g11r11, ..frame });
        let mut compared = 0;
        for (half, small) in half.radiance.iter().zip(&small.radiance).filter(|(half, _)| half.w == 1.0) {
            compared += 1;
            // Six bits of mantissa in red and green, five in blue; a driver may round or cut.
            for (channel, step) in [(0, 1.0 / 64.0), (1, 1.0 / 64.0), (2, 1.0 / 32.0)] {
                let limit = half[channel] * (step + 1e-3) + 2f32.powi(-19);
                assert!((half[channel] - small[channel]).abs() <= limit, "{half} and {small}");
            }
        }
        assert!(compared > 1000, "only {compared} pixels are covered");
    });
}

#[test]
fn every_size_is_filled_to_its_borders() {
    let mut stage = Stage::front(0.5);
    let material = stage.material(unlit(Vec4::new(0.5, 0.25, 0.125, 1.0)));
    stage.object(quad(1000.0, 1000.0), material, at(Vec3::ZERO));
    let scene = stage.scene();
    headless(|device| {
        for size in [[1, 1], [3, 2], [641, 3], [2, 333]] {
            for msaa in [1, 4] {
                let picture = device.picture(&scene, &options(size, msaa));
                assert_eq!(picture.size, size);
                assert_eq!(picture.radiance.len() as u32, size[0] * size[1]);
                assert_eq!(picture.rgba.len() as u32, size[0] * size[1] * 4);
                let expected = Vec4::new(0.5, 0.25, 0.125, 1.0);
                assert!(picture.radiance.iter().all(|radiance| *radiance == expected), "{size:?} at {msaa} samples");
            }
        }
    });
}

#[test]
fn more_samples_change_edges_alone() {
    let mut stage = Stage::front(1.0);
    let material = stage.material(Material { roughness: 0.3, ..plain() });
    let rotation = Quat::from_rotation_z(0.2) * Quat::from_rotation_y(0.7);
    stage.object(quad(0.8, 0.6), material, Transform::Trs { translation: Vec3::ZERO, rotation, scale: Vec3::ONE });
    stage.light(LightKind::Point { range_m: None }, Vec3::ONE, Vec3::new(0.2, 0.4, 1.0), Vec3::Z);
    let scene = stage.scene();
    headless(|device| {
        let size = [64, 64];
        let [one, four] = [1, 4].map(|msaa| device.picture(&scene, &options(size, msaa)));
        let (mut inside, mut partial) = (0, 0);
        for (one, four) in one.radiance.iter().zip(&four.radiance) {
            match four.w {
                0.0 => assert_eq!(*one, Vec4::ZERO),
                1.0 => {
                    inside += 1;
                    // Along the diagonal a pixel is the mean of two triangles' values.
                    assert!((*one - *four).abs().max_element() <= 2e-3 * one.max_element(), "{one} and {four}");
                }
                share => {
                    partial += 1;
                    assert_eq!((share * 4.0).fract(), 0.0, "coverage comes in quarters");
                }
            }
        }
        assert!(inside > 500 && partial > 50, "{inside} inside, {partial} on edges");
    });
}

#[test]
fn an_edge_shows_its_share_and_does_not_glow() {
    // Far beyond white: were the curve to bend what is covered in part, a quarter of it would be white, too.
    let bright = Vec3::new(12.0, 6.0, 3.0);
    let mut stage = Stage::front(1.0);
    let material = stage.material(unlit(bright.extend(1.0)));
    let rotation = Quat::from_rotation_z(0.2);
    stage.object(quad(0.8, 0.6), material, Transform::Trs { translation: Vec3::ZERO, rotation, scale: Vec3::ONE });
    let scene = stage.scene();
    headless(|device| {
        for tonemap in [Tonemap::None, Tonemap::Aces, Tonemap::Agx, Tonemap::Neutral] {
            let frame = FrameOptions { tonemap, ..options([64, 64], 4) };
            let shown = curve(tonemap, bright.as_dvec3());
            let [clear, black] = [Background::Transparent, Background::Color(Vec3::ZERO)]
                .map(|background| device.picture(&scene, &FrameOptions { background, ..frame.clone() }));
            let mut partial = 0;
            for index in 0..clear.radiance.len() {
                let share = clear.radiance[index].w;
                partial += usize::from(share > 0.0 && share < 1.0);
                // Linear light is premultiplied, bit for bit: quarters of whole numbers.
                assert_eq!(clear.radiance[index], (bright * share).extend(share));
                let bytes = |picture: &vair::render::Picture| [0, 1, 2, 3].map(|at| picture.rgba[index * 4 + at]);
                let (clear, black) = (bytes(&clear), bytes(&black));
                let near = |byte: u8, linear: f64| (f64::from(byte) - 255.0 * srgb_from_linear(linear)).abs() <= 1.0;
                for channel in 0..3 {
                    // The file's colour is straight: at every share that of the whole.
                    assert!(share == 0.0 || near(clear[channel], shown[channel]), "{tonemap:?}: {clear:?} at {share}");
                    let mixed = f64::from(share) * shown[channel];
                    assert!(near(black[channel], mixed), "{tonemap:?}: {black:?} at {share}");
                }
                assert_eq!((clear[3], black[3]), ((share * 255.0).round() as u8, 255));
            }
            assert!(partial > 50, "only {partial} pixels on edges");
        }
    });
}
