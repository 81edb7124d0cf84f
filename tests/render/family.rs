//! What holds for every family of cloth: dark without light, linear in it, finite at every end of every parameter and
//! under any light, the same every time, and free of what it does not use.

use crate::headless::{Headless, headless};
use crate::stage::{Stage, at, options, plain, quad};
use crate::variants::with_every_map;
use glam::{Vec3, Vec4};
use std::collections::BTreeSet;
use vair::asset::procedural::sphere;
use vair::asset::{LightKind, Material, MorphTarget, Primitive};
use vair::material::{Family, Form, ImageName, TextureSource, Value, Velvet};
use vair::render::{FrameOptions, FrameSetup, Picture};
use vair::scene::{EnvironmentLight, Scene};
use vair::shader::table;

struct NoTextures;

impl TextureSource for NoTextures {
    fn texture(&mut self, _: &ImageName) -> Result<usize, String> {
        Err("no textures here".to_owned())
    }
}

fn with(cloth: &Family, key: &str, value: Value) -> Family {
    let mut cloth = cloth.clone();
    cloth.set(key, &value, &mut NoTextures).unwrap_or_else(|error| panic!("{}: {error}", cloth.kind()));
    cloth
}

/// Every family as it is by default, and with one parameter at each of its ends or choices.
fn every_dress() -> Vec<Family> {
    let mut dresses = Vec::new();
    for cloth in Family::KINDS.iter().filter_map(|kind| Family::of_kind(kind)) {
        dresses.push(cloth.clone());
        for parameter in cloth.parameters() {
            let (least, most) = parameter.range;
            let values = match parameter.form {
                Form::Number | Form::Count => vec![Value::Number(least), Value::Number(most)],
                Form::Rgb => vec![Value::List(vec![Value::Number(0.0); 3]), Value::List(vec![Value::Number(1.0); 3])],
                Form::Switch => vec![Value::Switch(true), Value::Switch(false)],
                Form::Choice => parameter.choices.iter().map(|choice| Value::Text((*choice).to_owned())).collect(),
                _ => continue,
            };
            dresses.extend(values.into_iter().map(|value| with(&cloth, parameter.name, value)));
        }
    }
    dresses
}

/// Those that light rules. The rim of classic velvet does not ask for any, which is its known defect and what `classic`
/// asks for (fuzz.rs holds it to its twin).
fn every_lit_dress() -> Vec<Family> {
    let glows = |dress: &Family| matches!(dress, Family::Velvet(Velvet { classic: true, .. }));
    every_dress().into_iter().filter(|dress| !glows(dress)).collect()
}

/// Balls in rows, each in a dress of its own, smooth, half rough and rough in turn; the last is half metal.
fn balls(dresses: &[Family], ball: &Primitive, intensity: Vec3) -> Scene {
    let side = (dresses.len() as f32).sqrt().ceil();
    let mut stage = Stage::front(side * 0.5);
    for (index, _) in dresses.iter().enumerate() {
        let roughness = [0.0, 0.5, 1.0][index % 3];
        let metallic = if index % 3 == 2 { 0.5 } else { 0.0 };
        let material =
            stage.material(Material { base_color: Vec4::new(0.8, 0.4, 0.2, 1.0), roughness, metallic, ..plain() });
        let (x, y) = (index as f32 % side, (index as f32 / side).floor());
        stage.object(ball.clone(), material, at(Vec3::new(x + 0.5 - 0.5 * side, 0.5 * side - y - 0.5, 0.0)));
    }
    // In front, from the side, and from behind.
    for to_light in [Vec3::new(0.3, 0.4, 0.85), Vec3::X, Vec3::new(-0.2, 0.3, -0.9)] {
        stage.light(LightKind::Directional, intensity, Vec3::ZERO, to_light.normalize());
    }
    stage.asset.meshes.iter_mut().for_each(|mesh| mesh.weights.fill(1.0));
    let mut scene = stage.scene();
    for (material, cloth) in scene.materials_mut().iter_mut().zip(dresses) {
        material.family = Some(cloth.clone());
    }
    scene
}

fn size_of(dresses: &[Family]) -> [u32; 2] {
    [20 * (dresses.len() as f32).sqrt().ceil() as u32; 2]
}

/// A picture of all, with that much light from everywhere.
fn shown(device: &mut Headless, dresses: &[Family], intensity: Vec3, ambient: f32) -> Picture {
    let frame =
        FrameOptions { environment: EnvironmentLight::constant(Vec3::splat(ambient)), ..options(size_of(dresses), 1) };
    device.picture(&balls(dresses, &sphere(0.45, 8), intensity), &frame)
}

/// Kind and number of the dress that a pixel shows.
fn dress_at(dresses: &[Family], pixel: usize, picture: &Picture) -> String {
    let [width, _] = picture.size;
    let (x, y) = (pixel as u32 % width / 20, pixel as u32 / width / 20);
    dresses.get((y * (width / 20) + x) as usize).map_or_else(|| "nothing".to_owned(), |cloth| format!("{cloth:?}"))
}

#[test]
fn unlit_zero() {
    let dresses = every_lit_dress();
    assert!(dresses.len() > 50);
    headless(|device| {
        let picture = shown(device, &dresses, Vec3::ZERO, 0.0);
        for (pixel, radiance) in picture.radiance.iter().enumerate() {
            let dress = || dress_at(&dresses, pixel, &picture);
            assert_eq!(radiance.truncate(), Vec3::ZERO, "{}", dress());
        }
    });
}

#[test]
fn every_end_of_every_parameter_is_finite_under_any_light() {
    let dresses = every_dress();
    headless(|device| {
        for intensity in [1e-38, 1.0, 1e38] {
            let picture = shown(device, &dresses, Vec3::new(intensity, intensity, 0.0), 0.05);
            for (pixel, radiance) in picture.radiance.iter().enumerate() {
                let dress = || dress_at(&dresses, pixel, &picture);
                let is_right = radiance.is_finite() && radiance.min_element() >= 0.0;
                assert!(is_right, "{radiance} under {intensity}: {}", dress());
            }
        }
    });
}

#[test]
fn twice_the_light_is_twice_the_radiance() {
    let dresses = every_lit_dress();
    headless(|device| {
        let single = shown(device, &dresses, Vec3::new(0.01, 0.02, 0.0), 0.01);
        let double = shown(device, &dresses, Vec3::new(0.02, 0.04, 0.0), 0.02);
        for (pixel, (one, two)) in single.radiance.iter().zip(&double.radiance).enumerate() {
            let (one, two) = (one.truncate() * 2.0, two.truncate());
            // Half floats keep 11 bits, whichever way the device rounds them; below 2^-14 they have fixed steps.
            let is_linear = (one - two).abs().cmple(one.max(two) / 512.0 + 2.4e-7).all();
            assert!(is_linear, "{one} {two}: {}", dress_at(&dresses, pixel, &single));
        }
    });
}

#[test]
fn pictures_of_cloth_are_the_same_every_time() {
    let dresses = every_dress();
    headless(|device| {
        let first = shown(device, &dresses, Vec3::ONE, 0.05);
        assert!(first.rgba == shown(device, &dresses, Vec3::ONE, 0.05).rgba);
    });
}

/// Normals that are nothing, tangents that are nothing or lie along the normal, and one place of the map for all. No mesh
/// comes with such frames: morphs bring them about.
#[test]
fn degenerate_frames_are_finite() {
    let families: Vec<Family> = Family::KINDS.iter().filter_map(|kind| Family::of_kind(kind)).collect();
    headless(|device| {
        for tangent in [Vec3::ZERO, Vec3::Z, Vec3::X] {
            for normal in [Vec3::Z, Vec3::ZERO] {
                let mut primitive = quad(0.45, 0.45);
                let (normals, tangents) = (vec![normal - Vec3::Z; 4], vec![tangent - Vec3::X; 4]);
                primitive.morph_targets = vec![MorphTarget { positions: vec![Vec3::ZERO; 4], normals, tangents }];
                primitive.vertices.uv_sets[0].fill(glam::Vec2::ZERO);
                let scene = balls(&families, &primitive, Vec3::ONE);
                let picture = device.picture(&scene, &options(size_of(&families), 1));
                assert!(picture.radiance.iter().all(|radiance| radiance.is_finite()), "{tangent} {normal}");
            }
        }
    });
}

/// Descriptors of the family's own in the pipelines of a scene.
fn own_bindings(kind: &str, own_maps: bool) -> BTreeSet<&'static str> {
    let mut stage = Stage::front(0.5);
    let map = stage.texel([128, 128, 255, 255]);
    let material = stage.material(plain());
    stage.object(quad(0.5, 0.5), material, at(Vec3::ZERO));
    let mut scene = stage.scene();
    let cloth = Family::of_kind(kind).unwrap_or_else(|| panic!("{kind}"));
    scene.materials_mut()[material].family = Some(if own_maps { with_every_map(cloth, map) } else { cloth });
    let plan = FrameSetup::new(&scene, &options([4, 4], 1)).unwrap_or_else(|error| panic!("{error}")).staging.plan;
    // Those of its material: light has maps of its own.
    plan.pipelines.iter().flat_map(|spec| spec.bindings_of(1)).collect()
}

#[test]
fn a_cloth_without_maps_samples_none_and_no_family_carries_another() {
    for kind in Family::KINDS {
        let plain = own_bindings(kind, false);
        assert!(plain.iter().all(|name| !name.ends_with("_map")), "{kind} without maps: {plain:?}");
        let with_maps = own_bindings(kind, true);
        let has_maps =
            Family::of_kind(kind).is_some_and(|cloth| cloth.parameters().iter().any(|p| p.form == Form::Map));
        assert_eq!(with_maps.iter().any(|name| name.ends_with("_map")), has_maps, "{kind}: {with_maps:?}");
        for (_, shader) in table::ALL.iter().filter(|(key, _)| key.file.name() == format!("{kind}.frag")) {
            let foreign = |name: &str| {
                name.ends_with("Block")
                    && !name.to_lowercase().starts_with(kind)
                    && !["FrameBlock", "StandardBlock"].contains(&name)
            };
            assert!(shader.bindings.iter().all(|binding| !foreign(binding.name)), "{}", shader.name);
        }
    }
}
