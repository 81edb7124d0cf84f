//! Textures: which texel a pixel shows, and that colour is sRGB-decoded and data never is.

use crate::headless::headless;
use crate::limit::{all_hold, close, within};
use crate::stage::{NEAREST, Stage, at, options, plain, quad, unlit};
use crate::surface::{AMBIENT, radiance};
use glam::{DVec2, DVec3, Vec2, Vec3, Vec4};
use vair::asset::{Material, Primitive, Sampler, TextureRef, Wrap};
use vair::measure::twin::albedo::Fit;
use vair::measure::twin::color::linear_from_srgb;
use vair::measure::twin::occlusion;
use vair::measure::twin::standard::Surface;
use vair::measure::twin::uv::transformed;
use vair::render::Picture;
use vair::scene::Scene;

const SIDE: u32 = 4;
/// Error of a decoded texel: half a step of 8 bits at the curve's steepest (drivers decode by approximation).
const DECODED: f64 = 0.5 / 255.0;

/// Sixteen texels, all different in every channel.
fn texels() -> Vec<[u8; 4]> {
    (0..SIDE * SIDE).map(|i| [(i * 16 + 7) as u8, (i * 37 % 256) as u8, (255 - i * 15) as u8, 255]).collect()
}

fn textured(primitive: Primitive, sampler: Sampler, change: impl Fn(&mut TextureRef)) -> Scene {
    let mut stage = Stage::front(0.5);
    let mut texture = stage.texture([SIDE, SIDE], &texels(), sampler);
    change(&mut texture);
    let material = stage.material(Material { base_color_texture: Some(texture), ..unlit(Vec4::ONE) });
    stage.object(primitive, material, at(Vec3::ZERO));
    stage.scene()
}

fn wrapped(cell: i64, wrap: Wrap) -> usize {
    let side = i64::from(SIDE);
    (match wrap {
        Wrap::Repeat => cell.rem_euclid(side),
        Wrap::Clamp => cell.clamp(0, side - 1),
        Wrap::Mirror => {
            let phase = cell.rem_euclid(2 * side);
            if phase < side { phase } else { 2 * side - 1 - phase }
        }
    }) as usize
}

/// Compares every pixel that is not on a border of texels with its texel.
fn compare(picture: &Picture, map: &TextureRef, wrap: [Wrap; 2]) -> Vec<Result<(), String>> {
    let texels = texels();
    let mut checks = Vec::new();
    for y in 0..picture.size[1] {
        for x in 0..picture.size[0] {
            let uv =
                (DVec2::new(x.into(), y.into()) + 0.5) / DVec2::new(picture.size[0].into(), picture.size[1].into());
            let uv =
                transformed(uv, map.offset.as_dvec2(), map.rotation.into(), map.scale.as_dvec2()) * f64::from(SIDE);
            if (uv - uv.round()).abs().min_element() < 0.02 {
                continue;
            }
            let column = wrapped(uv.x.floor() as i64, wrap[0]);
            let row = wrapped(uv.y.floor() as i64, wrap[1]);
            let texel = texels[row * SIDE as usize + column];
            let decoded = DVec3::from_array([0, 1, 2].map(|i| linear_from_srgb(f64::from(texel[i]) / 255.0)));
            checks.push(within(
                &format!("pixel {x}, {y} shows texel {column}, {row}"),
                picture.radiance(x, y),
                decoded,
                1e-3,
                DECODED,
            ));
        }
    }
    assert!(checks.len() * 10 > picture.radiance.len() * 7, "only {} pixels can be compared", checks.len());
    checks
}

fn untransformed() -> TextureRef {
    TextureRef { texture: 0, uv_set: 0, offset: Vec2::ZERO, rotation: 0.0, scale: Vec2::ONE }
}

#[test]
fn base_colour_is_decoded_and_uv_starts_at_the_top_left() {
    headless(|device| {
        let picture = device.picture(&textured(quad(0.5, 0.5), NEAREST, |_| ()), &options([SIDE, SIDE], 1));
        all_hold(compare(&picture, &untransformed(), NEAREST.wrap));
    });
}

#[test]
fn a_second_uv_set_is_read_where_the_texture_says() {
    let mut primitive = quad(0.5, 0.5);
    primitive.vertices.uv_sets.insert(0, vec![Vec2::splat(0.9); 4]);
    let scene = textured(primitive, NEAREST, |texture| texture.uv_set = 1);
    headless(|device| {
        let picture = device.picture(&scene, &options([SIDE, SIDE], 1));
        all_hold(compare(&picture, &untransformed(), NEAREST.wrap));
    });
}

#[test]
fn transforms_turn_scale_and_move() {
    let map =
        TextureRef { offset: Vec2::new(0.13, -0.21), rotation: 0.5, scale: Vec2::new(2.3, 1.7), ..untransformed() };
    let scene = textured(quad(0.5, 0.5), NEAREST, |texture| *texture = map);
    headless(|device| {
        let picture = device.picture(&scene, &options([32, 32], 1));
        all_hold(compare(&picture, &map, NEAREST.wrap));
    });
}

#[test]
fn wrap_modes_hold_for_each_axis() {
    let map = TextureRef { offset: Vec2::splat(-1.3), scale: Vec2::splat(3.1), ..untransformed() };
    headless(|device| {
        for wrap in [[Wrap::Repeat, Wrap::Mirror], [Wrap::Mirror, Wrap::Clamp], [Wrap::Clamp, Wrap::Repeat]] {
            let scene = textured(quad(0.5, 0.5), Sampler { wrap, ..NEAREST }, |texture| *texture = map);
            let picture = device.picture(&scene, &options([32, 32], 1));
            all_hold(compare(&picture, &map, wrap));
        }
    });
}

const GREY: u8 = 128;

/// Shows a material with one texture of one texel.
fn with_texel(texel: [u8; 4], base: Material, put: impl Fn(&mut Material, TextureRef), to_light: Vec3) -> Scene {
    let mut stage = Stage::front(0.5);
    let texture = stage.texel(texel);
    let mut material = base;
    put(&mut material, texture);
    let material = stage.material(material);
    stage.object(quad(0.5, 0.5), material, at(Vec3::ZERO));
    stage.light(vair::asset::LightKind::Directional, Vec3::ONE, Vec3::ZERO, to_light);
    stage.scene()
}

/// Holds with the value as stored, fails with the decoded one.
fn is_data(what: &str, picture: &Picture, expected: impl Fn(&dyn Fn(u8) -> f64) -> DVec3) {
    let stored = |byte: u8| f64::from(byte) / 255.0;
    let decoded = |byte: u8| linear_from_srgb(stored(byte));
    all_hold([close(what, picture.radiance(1, 1), expected(&stored))]);
    assert!(close(what, picture.radiance(1, 1), expected(&decoded)).is_err(), "{what}: the check tells nothing");
}

#[test]
fn data_maps_are_not_decoded() {
    let to_light = Vec3::new(0.3, 0.2, 0.9).normalize();
    let l = to_light.as_dvec3();
    let plain_surface = Surface { base_color: DVec3::ONE, metallic: 0.0, roughness: 1.0 };
    headless(|device| {
        let texel = [0, GREY, 64, 255];
        let put = |material: &mut Material, map| material.metallic_roughness_texture = Some(map);
        let metal = Material { metallic: 1.0, base_color: Vec4::new(0.9, 0.5, 0.2, 1.0), ..plain() };
        let picture = device.picture(&with_texel(texel, metal, put, to_light), &options([4, 4], 1));
        is_data("metallic roughness", &picture, |value| {
            let base_color = Vec3::new(0.9, 0.5, 0.2).as_dvec3();
            let surface = Surface { base_color, metallic: value(64), roughness: value(GREY) };
            radiance(surface, AMBIENT, DVec3::Z, DVec3::Z, l, DVec3::ONE)
        });

        let texel = [GREY, 0, 0, 255];
        let put = |material: &mut Material, map| {
            material.occlusion_texture = Some(map);
            material.occlusion_strength = 0.75;
        };
        let picture = device.picture(&with_texel(texel, plain(), put, to_light), &options([4, 4], 1));
        is_data("occlusion", &picture, |value| {
            let left = 1.0 + 0.75 * (value(GREY) - 1.0);
            let mirrored = Fit::shipped().compensated_albedo(0.04, 1.0, 1.0);
            let by_lobe = mirrored * occlusion::bounced(occlusion::of_lobe(1.0, 1.0, left), 0.04);
            let ambient = by_lobe + (1.0 - mirrored) * occlusion::bounced(left, 1.0);
            radiance(plain_surface, 0.0, DVec3::Z, DVec3::Z, l, DVec3::ONE) + AMBIENT * ambient
        });

        let texel = [190, 100, 220, 255];
        let put = |material: &mut Material, map| {
            material.normal_texture = Some(map);
            material.normal_scale = 0.5;
        };
        let picture = device.picture(&with_texel(texel, plain(), put, to_light), &options([4, 4], 1));
        is_data("normal", &picture, |value| {
            // The bitangent runs up the texture: OpenGL's convention.
            let mapped = DVec3::new(value(190) - 0.5, value(100) - 0.5, 2.0 * value(220) - 1.0);
            radiance(plain_surface, AMBIENT, mapped.normalize(), DVec3::Z, l, DVec3::ONE)
        });
    });
}

#[test]
fn emission_textures_are_decoded() {
    let put = |material: &mut Material, map| material.emissive_texture = Some(map);
    let base = Material { emissive: Vec3::splat(2.0), base_color: Vec4::new(0.0, 0.0, 0.0, 1.0), ..plain() };
    let surface = Surface { base_color: DVec3::ZERO, metallic: 0.0, roughness: 1.0 };
    let reflected = radiance(surface, AMBIENT, DVec3::Z, DVec3::Z, DVec3::NEG_Z, DVec3::ZERO);
    let texel = [GREY, 200, 20, 255];
    let emitted = DVec3::from_array([0, 1, 2].map(|i| 2.0 * linear_from_srgb(f64::from(texel[i]) / 255.0)));
    headless(|device| {
        let picture = device.picture(&with_texel(texel, base, put, Vec3::NEG_Z), &options([4, 4], 1));
        all_hold([within("emission", picture.radiance(1, 1), reflected + emitted, 1e-3, 2.0 * DECODED)]);
    });
}

#[test]
fn detail_maps_multiply_the_colour_and_add_their_slopes() {
    let to_light = Vec3::new(0.3, 0.2, 0.9).normalize();
    let (albedo, normal, detail) = ([150, 100, 188, 255], [170, 120, 235, 255], [110, 160, 230, 255]);
    let mut stage = Stage::front(0.5);
    let maps = [albedo, normal, detail].map(|texel| stage.texel(texel));
    let material = stage.material(Material { normal_texture: Some(maps[1]), base_color: Vec4::splat(0.5), ..plain() });
    stage.object(quad(0.5, 0.5), material, at(Vec3::ZERO));
    stage.light(vair::asset::LightKind::Directional, Vec3::ONE, Vec3::ZERO, to_light);
    let mut scene = stage.scene();
    scene.materials_mut()[0].standard.detail_albedo_texture = Some(maps[0]);
    scene.materials_mut()[0].standard.detail_normal_texture = Some(maps[2]);
    scene.materials_mut()[0].standard.detail_normal_scale = 0.5;

    let stored = |texel: [u8; 4]| DVec3::from_array([0, 1, 2].map(|i| f64::from(texel[i]) / 255.0));
    let grey = linear_from_srgb(0.5);
    let tint = DVec3::from_array([0, 1, 2].map(|i| linear_from_srgb(stored(albedo)[i]) / grey));
    let (normal, detail) = (stored(normal) * 2.0 - 1.0, stored(detail) * 2.0 - 1.0);
    let mapped = (normal.truncate() + 0.5 * detail.truncate()).extend(normal.z * detail.z).normalize();
    let surface = Surface { base_color: (tint * 0.5).min(DVec3::ONE), metallic: 0.0, roughness: 1.0 };
    let expected = radiance(surface, AMBIENT, mapped, DVec3::Z, to_light.as_dvec3(), DVec3::ONE);
    headless(|device| {
        let picture = device.picture(&scene, &options([4, 4], 1));
        // Decoding by approximation counts 2.3 times, as much as the map's factor over its slope.
        all_hold([within("detail", picture.radiance(1, 1), expected, 2e-3, 2.5 * DECODED)]);
    });
}
