//! Where a coat stands, seen straight down: every texel of the distribution map shows the highest shell that it
//! reaches; its colours are those of the formulas.

use crate::headless::headless;
use crate::limit::{all_hold, within};
use crate::shells::{height_coat, same_height, shown_height};
use crate::stage::{NEAREST, Stage, at, options, plain, quad};
use glam::{DVec2, DVec3, Vec2, Vec3, Vec4};
use vair::asset::Primitive;
use vair::material::{Fur, Length, Shape};
use vair::measure::twin::strand::threshold;
use vair::measure::twin::uv::projected;
use vair::render::{FrameOptions, FrameSetup, Picture};
use vair::scene::Scene;

/// Texels a side; each is a block of 4 x 4 pixels, whose middle lies in no 2 x 2 group with another block.
const SIDE: u32 = 16;
const BLOCK: u32 = 4;

/// Map values, spread over [0, 1] and off every threshold in use.
fn texels() -> Vec<[u8; 4]> {
    (0..SIDE * SIDE).map(|i| [(i * 97 % 256) as u8, (i * 31 % 256) as u8, 255, 255]).collect()
}

/// A coat of the map over a quad that fills the picture.
pub fn seen_from_above(fur: Fur) -> Scene {
    over(quad(0.5, 0.5), fur)
}

fn over(primitive: Primitive, fur: Fur) -> Scene {
    let mut stage = Stage::front(0.5);
    let map = stage.texture([SIDE, SIDE], &texels(), NEAREST);
    let material = stage.material(plain());
    stage.object(primitive, material, at(Vec3::ZERO));
    let mut scene = stage.scene();
    scene.materials_mut()[material].fur = Some(Fur { distribution_map: Some(map), ..fur });
    scene
}

pub fn frame(msaa: u32) -> FrameOptions {
    options([SIDE * BLOCK; 2], msaa)
}

/// Height of the highest of `layers` shells whose threshold the map value reaches; 0 = none. `None` when rounding may
/// decide either way.
fn highest(value: f64, fur: &Fur, layers: u32) -> Option<f64> {
    let mut height = 0.0;
    for k in 0..layers {
        let middle = (f64::from(k) + 0.5) / f64::from(layers);
        let least = threshold(middle, fur.cutoff_start.into(), fur.cutoff_end.into(), fur.shape == Shape::Paraboloid);
        if (value - least).abs() < 1e-4 {
            return None;
        }
        if value >= least {
            height = middle;
        }
    }
    Some(height)
}

/// Compares every texel with a coat of `layers` shells, and every shell's coverage with the map's.
pub fn stands_as_mapped(picture: &Picture, fur: &Fur, layers: u32) -> Result<(), String> {
    let stored = |byte: u8| f64::from(byte) / 255.0;
    let expected: Vec<Option<f64>> = texels().iter().map(|texel| highest(stored(texel[0]), fur, layers)).collect();
    let mut found = Vec::new();
    for (index, expected) in expected.iter().enumerate() {
        let (column, row) = (index as u32 % SIDE, index as u32 / SIDE);
        for (x, y) in [(1, 1), (2, 1), (1, 2), (2, 2)] {
            let height = shown_height(picture.radiance(column * BLOCK + x, row * BLOCK + y));
            found.extend(height.filter(|_| expected.is_some()));
            if let Some(expected) = expected {
                same_height(&format!("texel {column}, {row}"), height, Some(*expected), layers)?;
            }
        }
    }
    let known: Vec<f64> = expected.into_iter().flatten().collect();
    if known.len() * 10 < (SIDE * SIDE * 9) as usize {
        return Err(format!("only {} texels are off the thresholds", known.len()));
    }
    for k in 0..layers {
        let bottom = f64::from(k) / f64::from(layers) + 0.25 / f64::from(layers);
        let share =
            |heights: &[f64]| heights.iter().filter(|&&height| height > bottom).count() as f64 / heights.len() as f64;
        if share(&known) != share(&found) {
            return Err(format!("shell {k} covers {} of the surface, the map {}", share(&found), share(&known)));
        }
    }
    Ok(())
}

#[test]
fn every_shell_covers_what_the_map_says() {
    headless(|device| {
        for shape in [Shape::Cone, Shape::Paraboloid] {
            for (cutoff_start, cutoff_end) in [(0.0, 1.0), (0.2, 0.7), (0.6, 0.1)] {
                for layers in [1, 3, 7] {
                    let fur = Fur { shape, cutoff_start, cutoff_end, layers, ..height_coat() };
                    // A falling threshold leaves tips without roots: the highest shell is shown all the same.
                    let scene = seen_from_above(fur.clone());
                    for msaa in [1, 4] {
                        let picture = device.picture(&scene, &frame(msaa));
                        let what = format!("{shape:?} {cutoff_start} to {cutoff_end}, {layers} shells, {msaa} samples");
                        all_hold([
                            stands_as_mapped(&picture, &fur, layers).map_err(|problem| format!("{what}: {problem}"))
                        ]);
                    }
                }
            }
        }
    });
}

#[test]
fn tiling_sets_density() {
    let fur = Fur { cutoff_start: 0.1, cutoff_end: 0.9, ..height_coat() };
    let mut scene = seen_from_above(fur.clone());
    if let Some(map) = scene.materials_mut()[0].fur.as_mut().and_then(|fur| fur.distribution_map.as_mut()) {
        map.scale = Vec2::splat(2.0);
    }
    headless(|device| {
        // Twice the texels a side: each quarter of a picture twice as large is the whole map.
        let picture = device.picture(&scene, &options([SIDE * BLOCK * 2; 2], 1));
        let half = SIDE * BLOCK;
        for corner in [[0, 0], [half, 0], [0, half], [half, half]] {
            let rows = (0..half).flat_map(|y| (0..half).map(move |x| (corner[0] + x, corner[1] + y)));
            let radiance = rows.map(|(x, y)| picture.radiance(x, y)).collect();
            let quarter = Picture { radiance, ..Picture::new([half; 2], Vec::new()) };
            all_hold([stands_as_mapped(&quarter, &fur, fur.layers)]);
        }
    });
}

#[test]
fn a_mesh_without_uvs_is_mapped_by_projection() {
    let mut bare = quad(0.5, 0.5);
    bare.vertices.uv_sets.clear();
    bare.vertices.tangents.clear();
    let fur = Fur { cutoff_start: 0.1, cutoff_end: 0.9, ..height_coat() };
    let scene = over(bare, fur.clone());
    let radius = 0.5f64.hypot(0.5);
    headless(|device| {
        let size = [256, 256];
        let picture = device.picture(&scene, &options(size, 1));
        let mut checks = Vec::new();
        let side = f64::from(SIDE);
        let texel_px = f64::from(size[0]) * radius / side;
        for y in 0..size[1] {
            for x in 0..size[0] {
                let position = crate::stage::front_position([x, y], picture.size, 0.5);
                let uv: DVec2 = projected(position, DVec3::Z) / radius * side;
                // Only where no pixel of the 2 x 2 group shows another texel.
                if (uv - uv.round()).abs().min_element() * texel_px < 1.5 {
                    continue;
                }
                let texel = texels()[(uv.y.floor().rem_euclid(side) * side + uv.x.floor().rem_euclid(side)) as usize];
                if let Some(expected) = highest(f64::from(texel[0]) / 255.0, &fur, fur.layers) {
                    let found = shown_height(picture.radiance(x, y));
                    checks.push(same_height(&format!("pixel {x}, {y}"), found, Some(expected), fur.layers));
                }
            }
        }
        assert!(checks.len() > 20_000, "only {} pixels can be compared", checks.len());
        all_hold(checks);
    });
}

#[test]
fn roots_are_darker_by_the_occlusion() {
    let white = Fur { root_color: Vec3::ONE, tip_color: Vec3::ONE, ..height_coat() };
    let heights = seen_from_above(height_coat_with_thresholds());
    headless(|device| {
        let heights = device.picture(&heights, &frame(1));
        let bright = device.picture(&seen_from_above(with_thresholds(white.clone())), &frame(1));
        for occlusion in [0.4, 0.9] {
            let fur = Fur { occlusion, ..with_thresholds(white.clone()) };
            let dark = device.picture(&seen_from_above(fur), &frame(1));
            let mut checks = Vec::new();
            for (index, radiance) in heights.radiance.iter().enumerate() {
                let Some(height) = shown_height(*radiance).filter(|height| *height > 0.05) else { continue };
                let left = 1.0 + f64::from(occlusion) * (height - 1.0);
                let expected = bright.radiance[index].truncate().as_dvec3() * left;
                // Heights were themselves read from half floats.
                checks.push(within(&format!("height {height}"), dark.radiance[index], expected, 6e-3, 1e-5));
            }
            all_hold(checks);
        }
    });
}

fn with_thresholds(fur: Fur) -> Fur {
    Fur { cutoff_start: 0.1, cutoff_end: 0.9, ..fur }
}

fn height_coat_with_thresholds() -> Fur {
    with_thresholds(height_coat())
}

#[test]
fn spots_are_mixed_by_the_map_as_stored() {
    let mut stage = Stage::front(0.5);
    let (white, grey) = (stage.texel([255; 4]), stage.texel([128, 255, 0, 255]));
    let material = stage.material(plain());
    stage.object(quad(0.5, 0.5), material, at(Vec3::ZERO));
    let mut scene = stage.scene();
    let fur = Fur {
        distribution_map: Some(white),
        spot_map: Some(grey),
        spot_color: Vec3::Z,
        base_color: Some(Vec3::X),
        root_color: Vec3::ONE,
        tip_color: Vec3::ONE,
        ..height_coat()
    };
    scene.materials_mut()[material].fur = Some(fur);
    headless(|device| {
        let color = device.picture(&scene, &frame(1)).radiance(9, 9);
        let weight = f64::from(color.z / (color.x + color.z));
        assert!((weight - 128.0 / 255.0).abs() < 2e-3, "the spot map weighs {weight}");
    });
}

#[test]
fn vertex_colours_tint_the_strands() {
    let mut tinted = quad(0.5, 0.5);
    tinted.vertices.colors = vec![Vec4::new(0.25, 0.5, 1.0, 1.0); 4];
    let white = Fur { root_color: Vec3::ONE, tip_color: Vec3::ONE, cutoff_end: 0.0, ..height_coat() };
    headless(|device| {
        let plain = device.picture(&seen_from_above(white.clone()), &frame(1)).radiance(9, 9);
        let tinted = device.picture(&over(tinted, white), &frame(1)).radiance(9, 9);
        let expected = plain.truncate().as_dvec3() * DVec3::new(0.25, 0.5, 1.0);
        all_hold([within("tint", tinted, expected, 2e-3, 1e-6)]);
    });
}

#[test]
fn a_coat_is_one_draw_and_an_instance_a_shell() {
    headless(|device| {
        for layers in [1, 20, 33] {
            let scene = seen_from_above(Fur { layers: 20, ..height_coat() });
            let (_, report) = device.reported(&scene, &FrameOptions { layers: Some(layers), ..frame(1) });
            let pass = report.passes.iter().find(|pass| pass.name == "fur").expect("a fur pass");
            assert_eq!((pass.draws, pass.instances), (1, u64::from(layers)));
            assert_eq!(pass.triangles, 2 * u64::from(layers));
            let [coat] = &report.fur[..] else { panic!("{:?}", report.fur) };
            assert_eq!((coat.layers, coat.instances, coat.vertices_stored), (layers, layers, 4));
        }
    });
}

#[test]
fn values_do_not_make_pipelines_and_unused_maps_are_not_loaded() {
    let plan = |fur: Fur| {
        let mut scene = seen_from_above(Fur::default());
        scene.materials_mut()[0].fur = Some(fur);
        FrameSetup::new(&scene, &frame(1)).unwrap_or_else(|error| panic!("{error}")).staging.plan
    };
    let base = plan(Fur::default());
    let other = Fur {
        length: Length::Metres(3.0),
        layers: 7,
        thickness: 0.2,
        cutoff_start: 0.3,
        cutoff_end: 0.4,
        edge_fade: 0.5,
        tip_fade: 0.5,
        taper: 1.0,
        occlusion: 0.1,
        color_variation: 0.9,
        force_strength: 1.0,
        specular: 1.0,
        roughness: 0.9,
        ..Fur::default()
    };
    let combed = plan(Fur { comb: Vec2::X, ..Fur::default() });
    assert_ne!(base.streams, combed.streams, "the axes of a comb are a stream of their own");
    let other = plan(other);
    assert_eq!(base.pipelines, other.pipelines);
    assert_eq!(base.streams, other.streams);
    assert!(base.textures.is_empty(), "the scene's one image is not in use");
    assert!(base.streams.values().all(|streams| streams.iter().all(|stream| !format!("{stream:?}").starts_with("Uv"))));
}
