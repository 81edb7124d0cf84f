//! Opacity: where a mask ends, and what stacked layers leave of what lies behind.

use crate::headless::headless;
use crate::limit::{all_hold, close};
use crate::stage::{NEAREST, Stage, at, options, quad, unlit};
use glam::{DVec3, Vec3, Vec4};
use vair::asset::{AlphaMode, Material, Sampler, Wrap};
use vair::measure::twin::color::srgb_from_linear;
use vair::render::{Background, FrameOptions};
use vair::scene::Scene;

fn blended(color: [f32; 4]) -> Material {
    Material { alpha_mode: AlphaMode::Blend, ..unlit(Vec4::from(color)) }
}

#[test]
fn a_mask_ends_where_its_opacity_crosses_the_cutoff() {
    let size = [64, 8];
    let cutoff = 0.3;
    let mut stage = Stage::front(0.5);
    // Between the middles of two texels, a quarter from each side, opacity rises from 0 to 1.
    let sampler = Sampler { wrap: [Wrap::Clamp; 2], mag_linear: true, ..NEAREST };
    let texture = stage.texture([2, 1], &[[255, 255, 255, 0], [255; 4]], sampler);
    let material =
        Material { alpha_mode: AlphaMode::Mask(cutoff), base_color_texture: Some(texture), ..unlit(Vec4::ONE) };
    let material = stage.material(material);
    stage.object(quad(4.0, 0.5), material, at(Vec3::ZERO));
    let scene = stage.scene();
    let first = f64::from(size[0]) * (0.25 + 0.5 * f64::from(cutoff));
    headless(|device| {
        for msaa in [1, 4] {
            let picture = device.picture(&scene, &options(size, msaa));
            for y in 0..size[1] {
                for x in 0..size[0] {
                    let coverage = picture.radiance(x, y).w;
                    let from_edge = f64::from(x) + 0.5 - first;
                    // Filters interpolate in steps of 1/256 texel, an eighth of a pixel here.
                    if from_edge.abs() > 1.0 {
                        assert_eq!(coverage, if from_edge > 0.0 { 1.0 } else { 0.0 }, "pixel {x}, {y} at {msaa}");
                    } else {
                        assert!((0.0..=1.0).contains(&coverage) && (msaa == 4 || coverage.fract() == 0.0));
                    }
                }
            }
        }
    });
}

/// Two layers; the near one comes first in the file.
fn two_layers(near: [f32; 4], far: [f32; 4]) -> Scene {
    let mut stage = Stage::front(0.5);
    for (color, depth_m) in [(near, 1.0), (far, -1.0)] {
        let material = stage.material(blended(color));
        stage.object(quad(0.5, 0.5), material, at(Vec3::Z * depth_m));
    }
    stage.scene()
}

#[test]
fn layers_blend_far_to_near_premultiplied() {
    let (near, far) = (Vec4::new(0.9, 0.2, 0.1, 0.25), Vec4::new(0.1, 0.3, 0.8, 0.6));
    let over = near.truncate() * near.w + (1.0 - near.w) * far.w * far.truncate();
    let opacity = near.w + (1.0 - near.w) * far.w;
    headless(|device| {
        for msaa in [1, 4] {
            let picture = device.picture(&two_layers(near.to_array(), far.to_array()), &options([4, 4], msaa));
            all_hold([
                close("colour", picture.radiance(1, 1), over.as_dvec3()),
                close("opacity", Vec4::splat(picture.radiance(1, 1).w), DVec3::splat(opacity.into())),
            ]);
        }
    });
}

#[test]
fn the_background_darkens_twice_behind_two_layers() {
    let scene = two_layers([0.0, 0.0, 0.0, 0.5], [0.0, 0.0, 0.0, 0.5]);
    let frame = FrameOptions { background: Background::Color(Vec3::ONE), ..options([4, 4], 1) };
    let shown = (255.0 * srgb_from_linear(0.25)).round() as i32;
    headless(|device| {
        let pixel = device.picture(&scene, &frame).pixel(2, 1);
        assert!(pixel[..3].iter().all(|&byte| (i32::from(byte) - shown).abs() <= 1), "{pixel:?} is not {shown}");
        assert_eq!(pixel[3], 255);
    });
}

#[test]
fn a_transparent_background_keeps_opacity_and_straight_colour() {
    let scene = two_layers([0.5, 0.25, 1.0, 0.5], [0.0, 0.0, 0.0, 0.0]);
    let frame = FrameOptions { background: Background::Transparent, ..options([4, 4], 1) };
    headless(|device| {
        let pixel = device.picture(&scene, &frame).pixel(0, 0).map(i32::from);
        let expected = [0.5, 0.25, 1.0].map(|linear| (255.0 * srgb_from_linear(linear)).round() as i32);
        let [r, g, b, a] = pixel;
        assert!(
            [r, g, b].iter().zip(expected).all(|(found, shown)| (found - shown).abs() <= 1),
            "{pixel:?}, {expected:?}"
        );
        assert!((127..=128).contains(&a), "{pixel:?}");
        let empty = Stage::front(0.5).scene();
        assert_eq!(device.picture(&empty, &frame).pixel(3, 3)[3], 0);
    });
}
