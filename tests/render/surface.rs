//! A lit quad of known BRDF has the computed radiance.

use crate::headless::{Headless, headless};
use crate::limit::{all_hold, close};
use crate::stage::{Stage, at, options, plain, quad};
use glam::{DVec3, Quat, Vec3, Vec4};
use vair::asset::{LightKind, Material, Transform};
use vair::measure::twin::albedo::Fit;
use vair::measure::twin::standard::{Lobes, Surface};
use vair::render::FrameOptions;
use vair::scene::Light;

pub const AMBIENT: f64 = crate::stage::AMBIENT as f64;

/// Radiance of two lobes towards `v` under one directional light and the ambient, by the twins; directions in the tangent
/// frame.
pub fn lit(lobes: Lobes, ambient: f64, v: DVec3, l: DVec3, irradiance: DVec3) -> DVec3 {
    let fit = Fit::shipped();
    lobes.brdf_times_cosine(&fit, v, l) * irradiance + lobes.ambient(&fit, v.z) * ambient
}

/// The same of a surface; directions in the world.
pub fn radiance(surface: Surface, ambient: f64, normal: DVec3, v: DVec3, l: DVec3, irradiance: DVec3) -> DVec3 {
    let tangent = normal.any_orthonormal_vector();
    let bitangent = normal.cross(tangent);
    let in_tangent = |w: DVec3| DVec3::new(w.dot(tangent), w.dot(bitangent), w.dot(normal));
    lit(surface.lobes(), ambient, in_tangent(v), in_tangent(l), irradiance)
}

fn tilt(angle_deg: f32) -> Quat {
    Quat::from_rotation_y(angle_deg.to_radians())
}

/// The twin of a material; its textures do not count.
fn surface_of(material: &Material) -> Surface {
    Surface {
        base_color: material.base_color.truncate().as_dvec3(),
        metallic: material.metallic.into(),
        roughness: material.roughness.into(),
    }
}

/// Every metal, roughness and view angle in a cell of its own, under one light.
fn check_cells(device: &mut Headless, to_light: Vec3) -> Vec<Result<(), String>> {
    let irradiance = Vec3::new(0.3, 0.2, 0.25);
    // 6 x 8 cells of a metre, 16 pixels each.
    let size = [96, 128];
    let mut stage = Stage::front(4.0);
    stage.light(LightKind::Directional, irradiance, Vec3::ZERO, to_light);
    let mut cells = Vec::new();
    for metallic in [0.0, 0.5, 1.0] {
        for roughness in [0.0, 0.1, 0.5, 1.0] {
            for view_deg in [0.0f32, 45.0, 80.0, 87.0] {
                let cell = [cells.len() as u32 % 6, cells.len() as u32 / 6];
                let base_color = Vec4::new(0.8, 0.4, 0.05, 1.0);
                let material = Material { base_color, metallic, roughness, ..plain() };
                let middle = Vec3::new(cell[0] as f32 - 2.5, 3.5 - cell[1] as f32, 0.0);
                let transform = Transform::Trs { translation: middle, rotation: tilt(view_deg), scale: Vec3::ONE };
                // As wide as its cell when seen at the angle.
                let half_width_m = 0.49 / view_deg.to_radians().cos();
                cells.push((cell, view_deg, surface_of(&material)));
                let material = stage.material(material);
                stage.object(quad(half_width_m, 0.49), material, transform);
            }
        }
    }
    let picture = device.picture(&stage.scene(), &options(size, 1));
    cells
        .into_iter()
        .map(|(cell, view_deg, surface)| {
            let pixel = cell.map(|cell| cell * 16 + 8);
            let normal = (tilt(view_deg) * Vec3::Z).as_dvec3();
            let l = to_light.as_dvec3();
            let expected = radiance(surface, AMBIENT, normal, DVec3::Z, l, irradiance.as_dvec3());
            close(
                &format!("{surface:?} at {view_deg} degrees, light {to_light}"),
                picture.radiance(pixel[0], pixel[1]),
                expected,
            )
        })
        .collect()
}

#[test]
fn a_lit_quad_has_the_radiance_of_its_brdf() {
    let from = |angle_deg: f32| Vec3::new(angle_deg.to_radians().sin(), 0.0, angle_deg.to_radians().cos());
    // Into the mirror at 0 degrees; beside the mirror at 45 by about the smallest lobe; across; grazing; from behind.
    let lights = [
        Vec3::Z,
        from(90.1),
        Vec3::new(0.5, 0.6, 0.62).normalize(),
        from(-88.0),
        Vec3::new(0.3, 0.1, -0.9).normalize(),
    ];
    headless(|device| all_hold(lights.into_iter().flat_map(|to_light| check_cells(device, to_light))));
}

fn one_quad(material: Material, transform: Transform, to_light: Option<Vec3>) -> Stage {
    let mut stage = Stage::front(0.5);
    let material = stage.material(material);
    stage.object(quad(0.8, 0.8), material, transform);
    if let Some(to_light) = to_light {
        stage.light(LightKind::Directional, Vec3::ONE, Vec3::ZERO, to_light);
    }
    stage
}

#[test]
fn lights_of_the_frame_shine_beside_those_of_the_file() {
    let material = Material { base_color: Vec4::new(0.7, 0.5, 0.3, 1.0), roughness: 0.6, ..plain() };
    let key = Light::key();
    let surface = surface_of(&material);
    let l = key.direction_to_light_in_world.as_dvec3();
    let expected = radiance(surface, AMBIENT, DVec3::Z, DVec3::Z, l, key.intensity.as_dvec3());
    headless(|device| {
        let frame = FrameOptions { lights: vec![Light::key()], ..options([4, 4], 1) };
        let picture = device.picture(&one_quad(material, at(Vec3::ZERO), None).scene(), &frame);
        all_hold([close("key light", picture.radiance(2, 2), expected)]);
    });
}

#[test]
fn a_back_face_is_lit_with_its_normal_turned_or_is_not_there() {
    let away = Transform::Trs { translation: Vec3::ZERO, rotation: tilt(150.0), scale: Vec3::ONE };
    let to_light = Vec3::new(0.2, 0.5, 0.8).normalize();
    let material = Material { roughness: 0.4, double_sided: true, ..plain() };
    let turned = (tilt(150.0) * Vec3::NEG_Z).as_dvec3();
    let expected = radiance(surface_of(&material), AMBIENT, turned, DVec3::Z, to_light.as_dvec3(), DVec3::ONE);
    headless(|device| {
        let picture = device.picture(&one_quad(material.clone(), away, Some(to_light)).scene(), &options([4, 4], 1));
        all_hold([close("double sided", picture.radiance(2, 2), expected)]);
        let single = Material { double_sided: false, ..material };
        let picture = device.picture(&one_quad(single, away, Some(to_light)).scene(), &options([4, 4], 1));
        assert_eq!(picture.radiance(2, 2), Vec4::ZERO, "culled");
    });
}

#[test]
fn a_mirrored_node_keeps_its_front_and_its_light() {
    let to_light = Vec3::new(-0.6, 0.3, 0.74).normalize();
    let material = Material { roughness: 0.3, ..plain() };
    headless(|device| {
        for scale in [Vec3::new(-1.0, 1.0, 1.0), Vec3::new(1.0, 1.0, -1.0), Vec3::splat(-1.0), Vec3::new(2.0, 1.0, 3.0)]
        {
            // Mirrored along its own normal, the quad faces the other way: turn it to the camera again.
            let rotation = if scale.z < 0.0 { tilt(180.0 + 30.0) } else { tilt(30.0) };
            let transform = Transform::Trs { translation: Vec3::ZERO, rotation, scale };
            let normal = (rotation * (Vec3::Z * scale.z.signum())).as_dvec3();
            let expected = radiance(surface_of(&material), AMBIENT, normal, DVec3::Z, to_light.as_dvec3(), DVec3::ONE);
            let scene = one_quad(material.clone(), transform, Some(to_light)).scene();
            let picture = device.picture(&scene, &options([4, 4], 1));
            all_hold([close(&format!("scale {scale}"), picture.radiance(2, 2), expected)]);
        }
    });
}

#[test]
fn emission_adds_its_radiance_and_unlit_shows_its_colour() {
    let emissive = Vec3::new(4.0, 0.5, 60.0);
    let material = Material { base_color: Vec4::new(0.2, 0.4, 0.6, 1.0), emissive, ..plain() };
    let reflected = radiance(surface_of(&material), AMBIENT, DVec3::Z, DVec3::Z, DVec3::Z, DVec3::ZERO);
    headless(|device| {
        let lit = device.picture(&one_quad(material.clone(), at(Vec3::ZERO), None).scene(), &options([4, 4], 1));
        let unlit = Material { unlit: true, ..material.clone() };
        let unlit = device.picture(&one_quad(unlit, at(Vec3::ZERO), Some(Vec3::Z)).scene(), &options([4, 4], 1));
        all_hold([
            close("emission", lit.radiance(1, 1), reflected + emissive.as_dvec3()),
            close("unlit", unlit.radiance(1, 1), DVec3::new(0.2, 0.4, 0.6)),
        ]);
    });
}

#[test]
fn vertex_colours_multiply_the_base_colour_and_are_linear() {
    let mut primitive = quad(0.5, 0.5);
    primitive.vertices.colors = vec![Vec4::new(0.25, 0.5, 0.75, 1.0); 4];
    let color = Vec4::new(0.8, 0.4, 0.2, 1.0);
    let expected = DVec3::new(0.2, 0.2, 0.15);
    headless(|device| {
        for unlit in [true, false] {
            let mut stage = Stage::front(0.5);
            let material = Material { base_color: color, roughness: 0.7, unlit, ..plain() };
            let tinted = Surface { base_color: expected, metallic: 0.0, roughness: f64::from(material.roughness) };
            let material = stage.material(material);
            stage.object(primitive.clone(), material, at(Vec3::ZERO));
            let picture = device.picture(&stage.scene(), &options([4, 4], 1));
            let lit = radiance(tinted, AMBIENT, DVec3::Z, DVec3::Z, DVec3::Z, DVec3::ZERO);
            all_hold([close("vertex colour", picture.radiance(1, 2), if unlit { expected } else { lit })]);
        }
    });
}
