//! Fragments are counted before `discard` and after the depth tests that stand before it: cases that can be counted by
//! hand, and counts against pictures.

use crate::headless::{Headless, headless};
use crate::scenes::{fur_ball, plain_cube};
use crate::shells::height_coat;
use crate::stage::{NEAREST, Stage, at, options, plain, quad};
use glam::{Vec3, Vec4};
use vair::asset::{AlphaMode, Material};
use vair::material::Fur;
use vair::measure::{PassFragments, count_fragments};
use vair::render::{FrameOptions, Pass, ShellOrder, Shells};
use vair::scene::Scene;

const SIDE: u32 = 16;
const PIXELS: u64 = (SIDE * SIDE) as u64;

/// Rasterized, shaded and covered of a pass.
fn count(device: &mut Headless, scene: &Scene, frame: &FrameOptions, pass: Pass) -> [u64; 3] {
    let counts = count_fragments(&mut device.renderer, scene, frame).unwrap_or_else(|error| panic!("{error}"));
    let found = counts.into_iter().find(|counted| counted.pass == pass);
    let PassFragments { rasterized, shaded, covered_pixels, .. } = found.unwrap_or_else(|| panic!("no {pass:?}"));
    [rasterized, shaded, covered_pixels]
}

/// Squares that fill the picture, in this order, at these distances towards the camera.
fn squares(materials: &[(Material, f32)]) -> Scene {
    let mut stage = Stage::front(1.0);
    for (material, z) in materials {
        let material = stage.material(material.clone());
        stage.object(quad(1.0, 1.0), material, at(Vec3::Z * *z));
    }
    stage.scene()
}

fn blended() -> Material {
    Material { alpha_mode: AlphaMode::Blend, base_color: Vec4::splat(0.5), ..plain() }
}

#[test]
fn what_hidden_surfaces_cost_depends_on_their_order() {
    let frame = options([SIDE; 2], 1);
    let (near, far) = ((plain(), 1.0), (plain(), -1.0));
    headless(|device| {
        let mut opaque = |materials: &[_]| count(device, &squares(materials), &frame, Pass::Opaque);
        assert_eq!(opaque(std::slice::from_ref(&near)), [PIXELS, PIXELS, PIXELS]);
        assert_eq!(opaque(&[near.clone(), far.clone()]), [2 * PIXELS, PIXELS, PIXELS]);
        assert_eq!(opaque(&[far.clone(), near.clone()]), [2 * PIXELS, 2 * PIXELS, PIXELS]);
        // Equal depth passes, as in the pipelines.
        assert_eq!(opaque(&[near.clone(), near.clone()]), [2 * PIXELS, 2 * PIXELS, PIXELS]);
    });
}

#[test]
fn what_blends_hides_nothing_and_is_hidden() {
    let frame = options([SIDE; 2], 1);
    headless(|device| {
        let pair = squares(&[(blended(), 1.0), (blended(), 2.0)]);
        assert_eq!(count(device, &pair, &frame, Pass::Opaque), [0, 0, 0]);
        assert_eq!(count(device, &pair, &frame, Pass::OitBuild), [2 * PIXELS, 2 * PIXELS, PIXELS]);
        let hidden = squares(&[(plain(), 1.0), (blended(), 0.0)]);
        assert_eq!(count(device, &hidden, &frame, Pass::OitBuild), [PIXELS, 0, 0]);
        assert_eq!(count(device, &hidden, &frame, Pass::ToneMapping), [PIXELS; 3]);
    });
}

#[test]
fn holes_are_shaded_and_neither_cover_nor_hide() {
    let mut stage = Stage::front(1.0);
    let half = stage.texture([2, 1], &[[255, 255, 255, 0], [255; 4]], NEAREST);
    let masked = Material { alpha_mode: AlphaMode::Mask(0.5), base_color_texture: Some(half), ..plain() };
    let (masked, behind) = (stage.material(masked), stage.material(plain()));
    stage.object(quad(1.0, 1.0), masked, at(Vec3::Z));
    let alone = Stage { asset: stage.asset.clone() }.scene();
    stage.object(quad(1.0, 1.0), behind, at(Vec3::ZERO));
    let both = stage.scene();
    let frame = options([SIDE; 2], 1);
    headless(|device| {
        assert_eq!(count(device, &alone, &frame, Pass::Opaque), [PIXELS, PIXELS, PIXELS / 2]);
        assert_eq!(count(device, &both, &frame, Pass::Opaque), [2 * PIXELS, PIXELS + PIXELS / 2, PIXELS]);
    });
}

#[test]
fn a_pixel_that_two_triangles_share_counts_for_each() {
    let frame = options([SIDE; 2], 4);
    let cut = PIXELS + u64::from(SIDE);
    headless(|device| {
        let mut opaque = |materials: &[_]| count(device, &squares(materials), &frame, Pass::Opaque);
        // The diagonal of the square cuts one pixel a row.
        assert_eq!(opaque(&[(plain(), 0.0)]), [cut, cut, PIXELS]);
        assert_eq!(opaque(&[(plain(), 1.0), (plain(), 0.0)]), [2 * cut, cut, PIXELS]);
        assert_eq!(opaque(&[(plain(), 0.0), (plain(), 1.0)]), [2 * cut, 2 * cut, PIXELS]);
    });
}

fn coated(fur: Fur, with_map: bool) -> Scene {
    let mut stage = Stage::front(1.0);
    let white = stage.texel([255; 4]);
    let material = stage.material(plain());
    stage.object(quad(1.0, 1.0), material, at(Vec3::ZERO));
    let mut scene = stage.scene();
    scene.materials_mut()[material].fur = Some(Fur { distribution_map: with_map.then_some(white), ..fur });
    scene
}

#[test]
fn the_outermost_shell_first_hides_the_others() {
    let outer = options([SIDE; 2], 1);
    let inner = FrameOptions { shells: Shells { order: ShellOrder::InnerFirst, ..Shells::default() }, ..outer.clone() };
    let blended = FrameOptions { shells: Shells { order: ShellOrder::Blended, ..Shells::default() }, ..outer.clone() };
    let layers = height_coat().layers;
    let all = u64::from(layers) * PIXELS;
    headless(|device| {
        let closed = coated(height_coat(), true);
        assert_eq!(count(device, &closed, &outer, Pass::Fur), [all, PIXELS, PIXELS]);
        assert_eq!(count(device, &closed, &inner, Pass::Fur), [all, all, PIXELS]);
        assert_eq!(count(device, &closed, &blended, Pass::OitBuild), [all, all, PIXELS]);
        // Between strands one sees further down.
        let open = coated(Fur { layers, force_strength: 0.0, ..Fur::default() }, false);
        let [rasterized, shaded, covered] = count(device, &open, &outer, Pass::Fur);
        assert_eq!(rasterized, all);
        assert!(covered < PIXELS && PIXELS < shaded && shaded < all, "{shaded} shaded, {covered} covered");
        assert_eq!(count(device, &open, &inner, Pass::Fur), [all, all, covered]);
    });
}

#[test]
fn counted_pixels_are_those_of_the_picture() {
    headless(|device| {
        for msaa in [1, 4] {
            let frame = options([96, 54], msaa);
            for (scene, pass) in [(plain_cube(), Pass::Opaque), (coated(height_coat(), true), Pass::Fur)] {
                let picture = device.picture(&scene, &frame);
                let drawn = picture.radiance.iter().filter(|radiance| radiance.w > 0.0).count() as u64;
                let [rasterized, shaded, covered] = count(device, &scene, &frame, pass);
                assert_eq!(covered, drawn, "{msaa} samples");
                assert!(rasterized >= shaded && shaded >= covered);
            }
            // Counting leaves the picture as it is.
            let scene = fur_ball();
            let before = device.picture(&scene, &frame);
            let first = count_fragments(&mut device.renderer, &scene, &frame).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(device.picture(&scene, &frame).rgba, before.rgba);
            let second =
                count_fragments(&mut device.renderer, &scene, &frame).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(first, second);
        }
    });
}
