//! Gauze shows what lies behind it, glows with light from there, and has the computed radiance.

use crate::headless::headless;
use crate::limit::{all_hold, close, within};
use crate::scenes::three_lights;
use crate::stage::{NEAREST, Stage, at, options, plain, quad, unlit};
use crate::surface::AMBIENT;
use glam::{DVec3, Quat, Vec3, Vec4};
use vair::asset::procedural::sphere;
use vair::asset::{LightKind, Material, Transform};
use vair::material::{Family, Gauze, Weave};
use vair::measure::twin::albedo::Fit;
use vair::measure::twin::anisotropy::Lobe;
use vair::measure::twin::{gauze as twin, ggx, satin};
use vair::render::{FrameSetup, Pass};
use vair::scene::Scene;

const BASE_COLOR: Vec3 = Vec3::new(0.7, 0.4, 0.5);
const ROUGHNESS: f32 = 0.4;

/// Puts a quad of gauze, as wide as the picture when seen at that angle, into a stage.
fn hang(stage: &mut Stage, angle_deg: f32, depth_m: f32) -> usize {
    let base_color = BASE_COLOR.extend(1.0);
    let material = stage.material(Material { base_color, roughness: ROUGHNESS, double_sided: true, ..plain() });
    let rotation = Quat::from_rotation_y(angle_deg.to_radians());
    let translation = Vec3::Z * depth_m;
    stage.object(quad(8.0, 0.8), material, Transform::Trs { translation, rotation, scale: Vec3::ONE });
    material
}

fn one_quad(gauze: &Gauze, angle_deg: f32, to_light: Vec3) -> Scene {
    let mut stage = Stage::front(0.5);
    stage.light(LightKind::Directional, Vec3::ONE, Vec3::ZERO, to_light);
    let material = hang(&mut stage, angle_deg, 0.0);
    let mut scene = stage.scene();
    scene.materials_mut()[material].family = Some(Family::Gauze(gauze.clone()));
    scene
}

/// Radiance and opacity by the twin.
fn expected(gauze: &Gauze, angle_deg: f32, to_light: Vec3) -> (DVec3, f64) {
    let strength = f64::from(gauze.specular_strength * gauze.scatter_strength);
    let f0 = satin::f0(satin::reflectance(gauze.scatter_color.as_dvec3(), strength, 0.0), 1.0);
    let alpha = ggx::anisotropic_alpha(ROUGHNESS.into(), gauze.anisotropy.into());
    let density = f64::from(gauze.weave_density);
    let weave = match gauze.weave {
        Weave::Matted => twin::Weave::matted(density),
        Weave::Crossed => twin::Weave::crossed(density),
    };
    let sheet = twin::Gauze { diffuse: BASE_COLOR.as_dvec3(), weave, lobe: Lobe { f0, f90: satin::f90(f0), alpha } };
    let into_tangent = |w: Vec3| (Quat::from_rotation_y(-angle_deg.to_radians()) * w).as_dvec3();
    let (fit, v, l) = (Fit::shipped(), into_tangent(Vec3::Z), into_tangent(to_light));
    let cover = 1.0 / (1.0 + f64::from(gauze.transmittance)).log2();
    let radiance = sheet.bsdf_times_cosine(&fit, weave.mean_opacity(), v, l) + sheet.ambient(&fit, v) * AMBIENT;
    (radiance * cover, weave.opacity(v) * cover)
}

#[test]
fn lit_gauze_has_the_radiance_and_the_opacity_of_its_twin() {
    let bright = Gauze { specular_strength: 10.0, scatter_color: Vec3::new(1.0, 0.3, 0.6), ..Gauze::default() };
    let gauzes = [
        Gauze::default(),
        bright.clone(),
        Gauze { weave: Weave::Crossed, transmittance: 7.0, ..bright.clone() },
        Gauze { specular_strength: 0.0, weave_density: 200.0, ..bright },
    ];
    // In the mirror, aslant, and from behind.
    let lights = [Vec3::Z, Vec3::new(0.4, 0.5, 0.77).normalize(), Vec3::new(0.2, 0.1, -0.97).normalize()];
    headless(|device| {
        let mut checks = Vec::new();
        for gauze in &gauzes {
            for angle_deg in [0.0, 50.0, -80.0] {
                for to_light in lights {
                    let found =
                        device.picture(&one_quad(gauze, angle_deg, to_light), &options([4, 4], 1)).radiance(2, 2);
                    let (radiance, opacity) = expected(gauze, angle_deg, to_light);
                    let at = format!("{gauze:?} at {angle_deg}, light {to_light}");
                    // Coverage is a half float too, and what passes has steps of 1/4095 before.
                    checks.push(close(&at, found, radiance));
                    checks.push(within(&at, Vec4::splat(found.w), DVec3::splat(opacity), 1e-3, 0.5 / 4095.0));
                }
            }
        }
        all_hold(checks);
    });
}

#[test]
fn a_curtain_lit_from_behind_glows() {
    let from_behind = Vec3::new(0.2, 0.1, -0.97).normalize();
    headless(|device| {
        let mut shown = |density: f32, to_light: Vec3| {
            let gauze = Gauze { weave_density: density, specular_strength: 0.0, ..Gauze::default() };
            device.picture(&one_quad(&gauze, 0.0, to_light), &options([4, 4], 1)).radiance(2, 2)
        };
        // Sheer cloth shows nearly as much of the light from behind as of that from before it; opaque cloth nothing.
        let (sheer, lit) = (shown(200.0, from_behind), shown(200.0, -from_behind));
        assert!(sheer.x > 0.7 * lit.x && sheer.x <= lit.x, "{sheer} {lit}");
        let (opaque, ambient) = (shown(0.0, from_behind), AMBIENT as f32 * BASE_COLOR.x);
        assert!((opaque.x / ambient - 1.0).abs() < 2e-3 && opaque.w == 1.0, "{opaque}");
    });
}

/// Radiance in the middle of a white wall behind `folds` sheets of black gauze.
fn behind(folds: usize, angle_deg: f32) -> Scene {
    let mut stage = Stage::front(0.5);
    let wall = stage.material(unlit(Vec4::ONE));
    stage.object(quad(1.0, 1.0), wall, at(Vec3::NEG_Z * 20.0));
    let sheets: Vec<_> = (0..folds).map(|fold| hang(&mut stage, angle_deg, fold as f32)).collect();
    let mut scene = stage.scene();
    for sheet in sheets {
        let material = &mut scene.materials_mut()[sheet];
        material.family = Some(Family::Gauze(Gauze { specular_strength: 0.0, ..Gauze::default() }));
        material.standard.base_color = Vec4::new(0.0, 0.0, 0.0, 1.0);
    }
    scene
}

#[test]
fn two_folds_darken_twice_and_the_silhouette_is_denser() {
    headless(|device| {
        let mut wall = |folds, angle_deg| {
            f64::from(device.picture(&behind(folds, angle_deg), &options([4, 4], 1)).radiance(2, 2).x)
        };
        let (once, twice) = (wall(1, 0.0), wall(2, 0.0));
        assert!(once < 0.9 && (twice - once * once).abs() < 1e-3, "{once} {twice}");
        let (slanted, grazing) = (wall(1, 60.0), wall(1, 85.0));
        assert!(grazing < slanted && slanted < once && grazing < 0.05, "{once} {slanted} {grazing}");
    });
}

/// A quad whose left half of a map is black and whose right half is white, lit from the front.
fn mapped(map: fn(&mut Gauze) -> &mut Option<vair::asset::TextureRef>, gauze: Gauze, to_light: Vec3) -> Scene {
    let mut stage = Stage::front(0.5);
    stage.light(LightKind::Directional, Vec3::ONE, Vec3::ZERO, to_light);
    let texture = stage.texture([2, 1], &[[0, 0, 0, 255], [255; 4]], NEAREST);
    let material = stage.material(Material { roughness: ROUGHNESS, ..plain() });
    stage.object(quad(0.5, 0.5), material, at(Vec3::ZERO));
    let mut scene = stage.scene();
    let mut gauze = gauze;
    *map(&mut gauze) = Some(texture);
    scene.materials_mut()[material].family = Some(Family::Gauze(gauze));
    scene
}

#[test]
fn maps_open_holes_and_turn_the_highlight() {
    let silky = Gauze { specular_strength: 20.0, weave_density: 0.0, ..Gauze::default() };
    // Half way between eye and light the normals lean along x.
    let aside = Vec3::new(0.6, 0.0, 0.8);
    headless(|device| {
        let mut sides = |scene: &Scene| {
            let picture = device.picture(scene, &options([8, 8], 1));
            [picture.radiance(2, 4), picture.radiance(5, 4)]
        };
        let [hole, thread] = sides(&mapped(|gauze| &mut gauze.mesh_map, silky.clone(), aside));
        assert_eq!(hole, Vec4::ZERO);
        assert_eq!(thread.w, 1.0);
        let [dim, bright] = sides(&mapped(|gauze| &mut gauze.specular_noise, silky.clone(), Vec3::Z));
        assert!(dim.x > 0.3 * bright.x && dim.x < 0.8 * bright.x, "half of it: {dim} {bright}");
        let [along, across] = sides(&mapped(|gauze| &mut gauze.thread_pattern, silky.clone(), aside));
        assert!(along.x > 1.5 * across.x, "the highlight runs along u, then across: {along} {across}");
        // Twice the density: each half shows both texels.
        let scene = mapped(|gauze| &mut gauze.mesh_map, Gauze { sampling_density: 2.0, ..silky }, aside);
        let picture = device.picture(&scene, &options([8, 8], 1));
        assert_eq!([0, 2, 4, 6].map(|x| picture.radiance(x, 4).w), [0.0, 1.0, 0.0, 1.0]);
    });
}

#[test]
fn opaque_gauze_does_not_blend_and_a_missing_map_is_not_bound() {
    let plan = |gauze: &Gauze| {
        let scene = one_quad(gauze, 0.0, Vec3::Z);
        FrameSetup::new(&scene, &options([4, 4], 1)).unwrap().staging.plan
    };
    let sheer = plan(&Gauze::default());
    assert!(sheer.draws_of(Pass::Opaque).is_empty() && sheer.draws_of(Pass::OitBuild).len() == 1, "both sides at once");
    assert!(sheer.textures.is_empty() && sheer.fallbacks.is_empty());
    let opaque = plan(&Gauze { weave_density: 0.0, ..Gauze::default() });
    assert!(opaque.draws_of(Pass::OitBuild).is_empty() && opaque.draws_of(Pass::Opaque).len() == 1);
}

/// Gauze over a striped wall: sheer, dense, cleared and crossed above; below: mesh, crossing threads, a ball in a ball, and
/// the classic look.
pub fn gauze_balls() -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(1.0, Vec3::new(0.0, 0.2, 1.0), Vec3::Y);
    let stripes = stage.texture([2, 1], &[[30, 60, 90, 255], [220, 210, 180, 255]], NEAREST);
    let stripes = vair::asset::TextureRef { scale: glam::Vec2::splat(16.0), ..stripes };
    let wall = stage.material(Material { base_color_texture: Some(stripes), roughness: 0.9, ..plain() });
    stage.object(quad(2.5, 2.5), wall, at(Vec3::NEG_Z * 2.0));
    let texels: Vec<[u8; 4]> =
        (0..64u8).map(|at| if at % 8 < 3 || at / 8 < 3 { [255; 4] } else { [0, 0, 0, 255] }).collect();
    let mesh = Some(stage.texture([8, 8], &texels, NEAREST));
    let of = |weave_density| Gauze { weave_density, specular_strength: 6.0, ..Gauze::default() };
    let fine = Gauze { sampling_density: 8.0, ..of(0.0) };
    let balls = [
        of(20.0),
        of(1.0),
        Gauze { transmittance: 15.0, ..of(1.0) },
        Gauze { weave: Weave::Crossed, ..of(4.0) },
        Gauze { mesh_map: mesh, ..fine.clone() },
        Gauze { thread_pattern: mesh, weave_density: 3.0, specular_strength: 20.0, ..fine },
        of(4.0),
        Gauze { classic: true, ..of(2.0) },
        Gauze { scatter_color: Vec3::new(1.0, 0.5, 0.1), ..of(2.0) },
    ];
    let mut materials = Vec::new();
    for index in 0..balls.len() {
        let base_color = BASE_COLOR.extend(1.0);
        let material = Material { base_color, roughness: ROUGHNESS, double_sided: true, ..plain() };
        materials.push(stage.material(material));
        // The last is within the seventh.
        let (cell, radius_m) = if index == 8 { (6, 0.2) } else { (index, 0.37) };
        let place = Vec3::new(0.78 * (cell % 4) as f32 - 1.17, 0.48 - 0.96 * (cell / 4) as f32, 0.0);
        stage.object(sphere(radius_m, 12), materials[index], at(place));
    }
    three_lights(&mut stage);
    let mut scene = stage.scene();
    for (material, gauze) in materials.into_iter().zip(balls) {
        scene.materials_mut()[material].family = Some(Family::Gauze(gauze));
    }
    scene
}
