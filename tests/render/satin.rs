//! Satin has the computed radiance, and pays for what it shows.

use crate::headless::headless;
use crate::limit::{all_hold, close};
use crate::scenes::three_lights;
use crate::stage::{NEAREST, Stage, at, options, plain, quad};
use crate::surface::AMBIENT;
use glam::{DVec3, Quat, Vec3, Vec4};
use vair::asset::procedural::sphere;
use vair::asset::{LightKind, Material, Transform};
use vair::material::{Family, Satin};
use vair::measure::twin::albedo::Fit;
use vair::measure::twin::anisotropy::albedo_terms;
use vair::measure::twin::satin as twin;
use vair::scene::Scene;
use vair::shader::ShaderFile;

const BASE_COLOR: Vec3 = Vec3::new(0.5, 0.1, 0.3);
const IRRADIANCE: Vec3 = Vec3::new(0.3, 0.2, 0.25);

/// A quad of satin turned about the vertical, its threads along the tangent of the plane, under one light.
fn one_quad(satin: &Satin, roughness: f32, metallic: f32, angle_deg: f32, to_light: Vec3) -> Scene {
    let mut stage = Stage::front(0.5);
    stage.light(LightKind::Directional, IRRADIANCE, Vec3::ZERO, to_light);
    let base_color = BASE_COLOR.extend(1.0);
    let material = stage.material(Material { base_color, roughness, metallic, ..plain() });
    let rotation = Quat::from_rotation_y(angle_deg.to_radians());
    stage.object(quad(4.0, 0.8), material, Transform::Trs { translation: Vec3::ZERO, rotation, scale: Vec3::ONE });
    let mut scene = stage.scene();
    scene.materials_mut()[material].family = Some(Family::Satin(satin.clone()));
    scene
}

fn expected(satin: &Satin, roughness: f32, metallic: f32, angle_deg: f32, to_light: Vec3) -> DVec3 {
    let twin = twin::Satin {
        base_color: BASE_COLOR.as_dvec3(),
        metallic: metallic.into(),
        roughness: roughness.into(),
        anisotropy: satin.anisotropy.into(),
        specular_strength: satin.specular_strength.into(),
        specular_color: satin.specular_color.as_dvec3(),
        secondary_color: satin.secondary_color.as_dvec3(),
        secondary_width: satin.secondary_width.into(),
        two_way: satin.two_way,
        light_tint: satin.light_tint.into(),
    };
    let into_tangent = |w: Vec3| (Quat::from_rotation_y(-angle_deg.to_radians()) * w).as_dvec3();
    let (fit, v) = (Fit::shipped(), into_tangent(Vec3::Z));
    let lit = twin.brdf_times_cosine(&fit, v, into_tangent(to_light)) * IRRADIANCE.as_dvec3();
    lit + twin.ambient(&fit, v) * AMBIENT
}

#[test]
fn lit_satin_has_the_radiance_of_its_twin() {
    let silk = Satin { specular_color: Vec3::new(1.0, 0.6, 0.2), ..Satin::default() };
    let black = |satin: &Satin| Satin { secondary_color: Vec3::ZERO, ..satin.clone() };
    let satins = [
        silk.clone(),
        black(&silk),
        Satin { specular_color: Vec3::ZERO, ..silk.clone() },
        Satin { specular_strength: 0.0, ..silk.clone() },
        Satin { two_way: true, light_tint: 0.0, ..silk.clone() },
        Satin { anisotropy: -1.0, specular_strength: 30.0, light_tint: 1.0, ..silk },
    ];
    let lights = [Vec3::Z, Vec3::new(0.4, 0.5, 0.77).normalize(), Vec3::new(0.2, 0.1, -0.9).normalize()];
    headless(|device| {
        let mut checks = Vec::new();
        for satin in &satins {
            for (roughness, metallic, angle_deg) in [(0.4, 0.0, 0.0), (0.0, 0.0, 50.0), (1.0, 0.5, -80.0)] {
                for to_light in lights {
                    let scene = one_quad(satin, roughness, metallic, angle_deg, to_light);
                    let picture = device.picture(&scene, &options([4, 4], 1));
                    let wanted = expected(satin, roughness, metallic, angle_deg, to_light);
                    let at = format!("{satin:?} roughness {roughness} at {angle_deg}, light {to_light}");
                    checks.push(close(&at, picture.radiance(2, 2), wanted));
                }
            }
        }
        all_hold(checks);
    });
}

#[test]
fn classic_satin_is_as_bright_as_older_engines_made_it() {
    let satin = Satin { classic: true, secondary_color: Vec3::ZERO, anisotropy: 0.5, ..Satin::default() };
    headless(|device| {
        // In the mirror the distribution is 1 / pi; half of its colour is the light's own, half its grey.
        let picture = device.picture(&one_quad(&satin, 0.5, 0.0, 0.0, Vec3::Z), &options([4, 4], 1));
        let (light, pi) = (IRRADIANCE.as_dvec3(), std::f64::consts::PI);
        let gray = light.dot(DVec3::new(0.2125, 0.7154, 0.0721));
        let tinted = 0.5 * (DVec3::splat(gray) + light);
        let lit = BASE_COLOR.as_dvec3() / pi * light + tinted * (7.0 * 0.04 / (4.0 * pi));
        let (white, fresnel) = albedo_terms(&Fit::shipped(), DVec3::Z, (0.375, 0.125));
        let surrounding = BASE_COLOR.as_dvec3() + 7.0 * (0.04 + 0.96 * fresnel) * white * 0.375 * 0.125;
        all_hold([close("classic satin", picture.radiance(2, 2), lit + surrounding * AMBIENT)]);
    });
}

#[test]
fn denormal_inputs_are_zero() {
    let picture = |tiny: f32| {
        let color = Vec3::splat(tiny);
        let satin = Satin {
            specular_strength: tiny,
            secondary_color: color,
            light_tint: tiny,
            anisotropy: tiny,
            ..Satin::default()
        };
        one_quad(&satin, tiny, tiny, 40.0, Vec3::new(0.3, 0.2, 0.93).normalize())
    };
    headless(|device| {
        let [zero, tiny] =
            [0.0, 1e-40].map(|value| device.picture(&picture(value), &options([4, 4], 1)).radiance(2, 2));
        assert!(zero.is_finite() && (zero - tiny).abs().max_element() <= 1e-6, "{zero} {tiny}");
    });
}

#[test]
fn extreme_magnitudes_stay_finite() {
    headless(|device| {
        for roughness in [0.0, 1.0] {
            let mut scene = one_quad(&Satin { anisotropy: 1.0, ..Satin::default() }, roughness, 1.0, 89.9, Vec3::Z);
            scene.materials_mut()[0].standard.base_color = Vec4::ONE;
            assert!(device.picture(&scene, &options([4, 4], 4)).radiance(2, 2).is_finite());
        }
    });
}

#[test]
fn a_black_lobe_has_no_code() {
    let constants = |satin: Satin| {
        let scene = one_quad(&satin, 0.5, 0.0, 0.0, Vec3::Z);
        let setup = vair::render::FrameSetup::new(&scene, &options([4, 4], 1)).unwrap();
        let spec = setup
            .staging
            .plan
            .pipelines
            .iter()
            .find(|spec| spec.fragment.file == ShaderFile::SatinFrag)
            .unwrap()
            .clone();
        ["NARROW", "SECONDARY", "TWO_WAY"]
            .map(|name| spec.constants.iter().any(|(of, value)| *of == name && *value != 0))
    };
    assert_eq!(constants(Satin::default()), [true, true, false]);
    assert_eq!(
        constants(Satin { secondary_color: Vec3::ZERO, two_way: true, ..Satin::default() }),
        [true, false, true]
    );
    assert_eq!(constants(Satin { specular_strength: 0.0, ..Satin::default() }), [false; 3]);
}

/// Silk above: stretched along, round, across and both ways; below: one lobe, gold thread, noise, and the classic look.
pub fn satin_balls() -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(1.0, Vec3::new(0.0, 0.2, 1.0), Vec3::Y);
    let texels: Vec<[u8; 4]> = (0..64u8).map(|at| [(at.wrapping_mul(97) >> 1) + 127; 4]).collect();
    let noise = Some(stage.texture([8, 8], &texels, NEAREST));
    let of = |anisotropy| Satin { anisotropy, ..Satin::default() };
    let gold = Vec3::new(1.0, 0.7, 0.3);
    let balls = [
        (0.0, of(0.8)),
        (0.0, of(0.0)),
        (0.0, of(-0.8)),
        (0.0, Satin { two_way: true, ..of(0.9) }),
        (0.0, Satin { secondary_color: Vec3::ZERO, ..of(1.0) }),
        (1.0, Satin { specular_color: gold, specular_strength: 20.0, light_tint: 0.1, ..of(-0.5) }),
        (0.0, Satin { specular_noise: noise, ..of(0.5) }),
        (0.0, Satin { classic: true, specular_strength: 20.0, ..of(0.8) }),
    ];
    for (index, (metallic, _)) in balls.iter().enumerate() {
        let base_color = BASE_COLOR.extend(1.0);
        let material = stage.material(Material { base_color, metallic: *metallic, roughness: 0.45, ..plain() });
        let place = Vec3::new(0.78 * (index % 4) as f32 - 1.17, 0.48 - 0.96 * (index / 4) as f32, 0.0);
        stage.object(sphere(0.37, 12), material, at(place));
    }
    three_lights(&mut stage);
    let mut scene = stage.scene();
    for (index, (_, satin)) in balls.into_iter().enumerate() {
        scene.materials_mut()[index].family = Some(Family::Satin(satin));
    }
    scene
}
