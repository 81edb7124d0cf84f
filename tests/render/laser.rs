//! Laser cloth shows the colours of its twin, fetches no map of a part that is off, and does not sparkle from afar.

use crate::headless::{Headless, headless};
use crate::limit::{ABSOLUTE, RELATIVE, all_hold, within};
use crate::scenes::three_lights;
use crate::stage::{Stage, at, options, plain, quad};
use crate::surface::{AMBIENT, lit};
use glam::{DVec2, DVec3, Quat, Vec2, Vec3, Vec4};
use std::f64::consts::PI;
use vair::asset::procedural::sphere;
use vair::asset::{LightKind, Material, Transform};
use vair::material::{ColorMode, Family, FilmKind, HueCurve, HueDirection, Laser};
use vair::measure::twin::standard::{Lobes, Surface};
use vair::measure::twin::{color, film, laser};
use vair::render::FrameSetup;
use vair::scene::Scene;

/// Texel of every map: a red hue, other offsets in R and G.
const TEXEL: [u8; 4] = [128, 64, 200, 255];
/// Relative error of a decoded texel of 64 or more: half a step of 8 bits (drivers decode by approximation).
const DECODED: f64 = 2.4 * 0.5 / 64.0;
const BASE: Vec4 = Vec4::new(0.8, 0.5, 0.3, 1.0);
const IRRADIANCE: Vec3 = Vec3::new(0.3, 0.2, 0.25);

/// The twin of one quad, seen at an angle along its tangent.
fn lobes(cloth: &Laser, metallic: f64, roughness: f64, eye: DVec3) -> Lobes {
    let base_color = BASE.truncate().as_dvec3();
    let stored = TEXEL.map(|byte| f64::from(byte) / 255.0);
    if cloth.film == FilmKind::ThinFilm {
        let plain = ((f64::from(cloth.base_ior) - 1.0) / (f64::from(cloth.base_ior) + 1.0)).powi(2);
        let (least, most) = (f64::from(cloth.film_thickness_min), f64::from(cloth.film_thickness));
        let thickness_nm = if cloth.film_thickness_map.is_some() { least + (most - least) * stored[1] } else { most };
        let base_f0 = DVec3::splat(plain).lerp(base_color, metallic);
        let seen = film::Fit::shipped().reflectance(eye.z, thickness_nm, cloth.film_ior.into(), base_f0);
        let f0 = seen.to_array().map(|seen| film::f0_of_reflectance(seen, eye.z)).into();
        return Lobes { f0, diffuse: base_color * (1.0 - metallic), roughness };
    }
    let direction = match cloth.directional {
        HueDirection::Off => None,
        HueDirection::Value => Some(f64::from(cloth.color_direction).to_radians()),
        HueDirection::Map => Some(stored[0] * PI),
    };
    let whole = DVec2::new(eye.z, eye.truncate().length());
    let angle = direction.map_or(whole, |turn| laser::angle_along(eye, DVec2::from_angle(turn)));
    let u = laser::curve(angle, cloth.curve == HueCurve::Sin);
    let painted = DVec3::from_array([0, 1, 2].map(|at| color::linear_from_srgb(stored[at])));
    let layer = |offset: f64| {
        let (saturation, brightness) = (cloth.saturation.into(), cloth.brightness.into());
        let offset = offset + f64::from(cloth.hue_offset);
        match cloth.color_mode {
            // A flat quad under parallel views is of one hue: nothing to fade.
            ColorMode::Wheel => laser::wheel(u * f64::from(cloth.hue_span) + offset, 0.0, saturation, brightness),
            ColorMode::Ramp => laser::ramp(painted, offset, saturation, brightness),
        }
    };
    let color = if cloth.offset_map.is_some() { 0.5 * (layer(stored[0]) + layer(stored[1])) } else { layer(0.0) };
    Surface { base_color: base_color * color, metallic, roughness }.lobes()
}

fn cloths(stage: &mut Stage) -> Vec<Laser> {
    let map = Some(stage.texel(TEXEL));
    let plain = || Laser { hue_offset: 0.15, hue_span: 2.3, ..Laser::default() };
    let filmed = || Laser { film: FilmKind::ThinFilm, ..plain() };
    vec![
        plain(),
        Laser { curve: HueCurve::Sin, saturation: 1.0, brightness: 0.6, ..plain() },
        Laser { offset_map: map, ..plain() },
        Laser { color_mode: ColorMode::Ramp, hue_ramp: map, ..plain() },
        Laser { color_mode: ColorMode::Ramp, hue_ramp: map, offset_map: map, ..plain() },
        Laser { directional: HueDirection::Value, ..plain() },
        Laser { directional: HueDirection::Value, color_direction: 60.0, ..plain() },
        Laser { directional: HueDirection::Map, direction_map: map, ..plain() },
        Laser { classic: true, ..plain() },
        filmed(),
        Laser { film_thickness_map: map, ..filmed() },
        Laser { film_thickness: 0.0, base_ior: 2.0, ..filmed() },
    ]
}

/// A row of quads, one for each cloth, seen at the angle.
fn check_row(device: &mut Headless, metallic: f32, roughness: f32, view_deg: f32) -> Vec<Result<(), String>> {
    let to_light = Vec3::new(0.5, 0.6, 0.62).normalize();
    let mut stage = Stage::front(0.5);
    stage.light(LightKind::Directional, IRRADIANCE, Vec3::ZERO, to_light);
    let cloths = cloths(&mut stage);
    let tilt = Quat::from_rotation_y(view_deg.to_radians());
    for column in 0..cloths.len() {
        let material = stage.material(Material { base_color: BASE, metallic, roughness, ..plain() });
        let translation = Vec3::X * (column as f32 - 0.5 * (cloths.len() - 1) as f32);
        let half_width_m = 0.49 / view_deg.to_radians().cos();
        stage.object(
            quad(half_width_m, 0.49),
            material,
            Transform::Trs { translation, rotation: tilt, scale: Vec3::ONE },
        );
    }
    let mut scene = stage.scene();
    for (material, cloth) in scene.materials_mut().iter_mut().zip(&cloths) {
        material.family = Some(Family::Laser(cloth.clone()));
    }
    let picture = device.picture(&scene, &options([16 * cloths.len() as u32, 16], 1));
    let in_tangent = |direction: Vec3| (tilt.inverse() * direction).as_dvec3();
    let check = |(column, cloth): (usize, &Laser)| {
        let (v, l) = (in_tangent(Vec3::Z), in_tangent(to_light));
        let expected = lit(lobes(cloth, metallic.into(), roughness.into(), v), AMBIENT, v, l, IRRADIANCE.as_dvec3());
        let what = format!("metallic {metallic} roughness {roughness} at {view_deg} degrees: {cloth:?}");
        let found = picture.radiance(16 * column as u32 + 8, 8);
        let decodes = cloth.color_mode == ColorMode::Ramp;
        within(&what, found, expected, if decodes { RELATIVE + DECODED } else { RELATIVE }, ABSOLUTE)
    };
    cloths.iter().enumerate().map(check).collect()
}

#[test]
fn a_lit_quad_has_the_radiance_of_its_film() {
    let rows =
        [(0.0, 0.5, 0.0), (0.0, 0.0, 50.0), (0.0, 0.4, 85.0), (1.0, 0.3, 0.0), (1.0, 1.0, 50.0), (0.5, 0.2, 85.0)];
    headless(|device| {
        all_hold(rows.into_iter().flat_map(|(metallic, roughness, deg)| check_row(device, metallic, roughness, deg)));
    });
}

#[test]
fn maps_of_a_part_that_is_off_are_not_bound() {
    let bound = |dress: &dyn Fn(Laser) -> Laser| {
        let mut stage = Stage::front(0.5);
        let map = Some(stage.texel(TEXEL));
        let every =
            Laser { offset_map: map, hue_ramp: map, direction_map: map, film_thickness_map: map, ..Laser::default() };
        let material = stage.material(plain());
        stage.object(quad(0.5, 0.5), material, at(Vec3::ZERO));
        let mut scene = stage.scene();
        scene.materials_mut()[material].family = Some(Family::Laser(dress(every)));
        let plan = FrameSetup::new(&scene, &options([8, 8], 1)).unwrap_or_else(|error| panic!("{error}")).staging.plan;
        let constants = plan.pipelines.iter().flat_map(|spec| spec.constants.clone());
        constants
            .filter(|(name, value)| name.starts_with("HAS_") && *value == 1)
            .map(|(name, _)| name)
            .collect::<Vec<_>>()
    };
    assert_eq!(bound(&|every| every), ["HAS_OFFSET_MAP"]);
    assert_eq!(bound(&|every| Laser { film: FilmKind::ThinFilm, ..every }), ["HAS_FILM_THICKNESS_MAP"]);
    assert_eq!(bound(&|every| Laser { offset_map: None, ..every }), [""; 0]);
}

/// A ball of that radius in pixels, somewhere within a pixel.
fn far_ball(radius_px: f32, shift_px: Vec2, classic: bool) -> Scene {
    let mut stage = Stage::front(16.0);
    let material = stage.material(Material { base_color: Vec4::ONE, metallic: 1.0, roughness: 0.6, ..plain() });
    stage.object(sphere(radius_px, 24), material, at(shift_px.extend(0.0)));
    let mut scene = stage.scene();
    let laser = Laser { hue_span: 5.0, saturation: 1.0, classic, ..Laser::default() };
    scene.materials_mut()[material].family = Some(Family::Laser(laser));
    scene
}

/// Root mean square over pixels and shifts of how far a pixel's colour, less its grey, is from its own mean.
fn sparkle(device: &mut Headless, radius_px: f32, classic: bool) -> f64 {
    let shifts = (0..16).map(|at| Vec2::new((at % 4) as f32, (at / 4) as f32) / 4.0);
    let pictures: Vec<_> =
        shifts.map(|shift| device.picture(&far_ball(radius_px, shift, classic), &options([32, 32], 1))).collect();
    let (mut sum, mut count) = (0.0, 0);
    for pixel in (0..32 * 32).map(|at| [at % 32, at / 32]) {
        let seen = pictures.iter().map(|picture| picture.radiance(pixel[0], pixel[1]));
        // Only what all pictures show of the ball: its edge against nothing is not the film's.
        let seen: Vec<_> = seen.filter(|seen| seen.w == 1.0).map(|seen| seen.truncate().as_dvec3()).collect();
        if seen.len() < pictures.len() {
            continue;
        }
        let colors: Vec<_> = seen.iter().map(|seen| *seen - seen.element_sum() / 3.0).collect();
        let mean = colors.iter().sum::<DVec3>() / colors.len() as f64;
        sum += colors.iter().map(|color| (*color - mean).length_squared()).sum::<f64>();
        count += colors.len();
    }
    assert!(count > 0);
    (sum / count as f64).sqrt()
}

#[test]
fn a_far_ball_does_not_sparkle() {
    headless(|device| {
        // The smaller the ball, the more hues fall in a pixel of it.
        for (radius_px, left) in [(3.0, 0.25), (6.0, 0.4), (12.0, 0.5)] {
            let (faded, classic) = (sparkle(device, radius_px, false), sparkle(device, radius_px, true));
            assert!(faded <= left * classic, "radius {radius_px} px: {faded:.4} faded, {classic:.4} classic");
        }
    });
}

/// Laser vinyl above: mirror, rough, along 0 and along 90 degrees; below: cloth of five turns, a painted ramp in two
/// layers, a film on dark cloth and one on metal.
pub fn laser_balls() -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(1.0, Vec3::new(0.0, 0.2, 1.0), Vec3::Y);
    let ramp: Vec<[u8; 4]> = (0..16u8).map(|at| [40 + 12 * at, 220 - 10 * at, 120 + 8 * at, 255]).collect();
    let ramp = Some(stage.texture([16, 1], &ramp, crate::stage::NEAREST));
    let checks: Vec<[u8; 4]> =
        (0..64u8).map(|at| if (at + at / 8) % 2 == 0 { [0, 20, 0, 255] } else { [90, 70, 0, 255] }).collect();
    let layers = Some(stage.texture([8, 8], &checks, crate::stage::NEAREST));
    let filmed = || Laser { film: FilmKind::ThinFilm, ..Laser::default() };
    let along = |color_direction| Laser {
        directional: HueDirection::Value,
        color_direction,
        hue_span: 2.0,
        ..Laser::default()
    };
    let balls = [
        (1.0, 0.0, 0.9, Laser::default()),
        (1.0, 1.0, 0.9, Laser::default()),
        (1.0, 0.4, 0.9, along(0.0)),
        (1.0, 0.4, 0.9, along(90.0)),
        (0.0, 0.6, 0.8, Laser { hue_span: 5.0, curve: HueCurve::Sin, ..Laser::default() }),
        (0.0, 0.6, 0.8, Laser { color_mode: ColorMode::Ramp, hue_ramp: ramp, offset_map: layers, ..Laser::default() }),
        (0.0, 0.2, 0.02, filmed()),
        (1.0, 0.3, 0.5, filmed()),
    ];
    for (index, (metallic, roughness, albedo, _)) in balls.iter().enumerate() {
        let base_color = Vec3::splat(*albedo).extend(1.0);
        let material = Material { base_color, metallic: *metallic, roughness: *roughness, ..plain() };
        let material = stage.material(material);
        let place = Vec3::new(0.78 * (index % 4) as f32 - 1.17, 0.48 - 0.96 * (index / 4) as f32, 0.0);
        stage.object(sphere(0.37, 12), material, at(place));
    }
    three_lights(&mut stage);
    let mut scene = stage.scene();
    for (material, (.., laser)) in scene.materials_mut().iter_mut().zip(balls) {
        material.family = Some(Family::Laser(laser));
    }
    scene
}

/// A direction in the cloth is the same from both sides of it.
#[test]
fn threads_run_the_same_way_on_the_back() {
    let along = Vec2::from_angle(std::f32::consts::FRAC_PI_4);
    let colors = |device: &mut Headless, eye_in_cloth: Vec3| {
        let mut stage = Stage::front(0.2);
        let material = stage.material(Material { base_color: BASE, double_sided: true, ..plain() });
        let rotation = Quat::from_rotation_arc(eye_in_cloth.normalize(), Vec3::Z);
        stage.object(quad(1.0, 1.0), material, Transform::Trs { translation: Vec3::ZERO, rotation, scale: Vec3::ONE });
        let mut scene = stage.scene();
        let directional = HueDirection::Value;
        let laser = Laser { directional, color_direction: 45.0, hue_span: 2.0, ..Laser::default() };
        scene.materials_mut()[material].family = Some(Family::Laser(laser));
        device.picture(&scene, &options([4, 4], 1)).radiance(2, 2).truncate()
    };
    headless(|device| {
        let front = colors(device, (0.8 * along).extend(0.6));
        let back = colors(device, (0.8 * along).extend(-0.6));
        let across = colors(device, (0.8 * along.perp()).extend(0.6));
        assert!((front - back).abs().max_element() < 1e-4, "{front} {back}");
        assert!((front - across).abs().max_element() > 1e-3, "{front} {across}");
    });
}
