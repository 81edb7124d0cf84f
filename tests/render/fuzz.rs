//! Cotton and velvet have the computed radiance, classic ones too; maps do what their help says, and what is not there
//! costs nothing.

use crate::headless::{Headless, headless};
use crate::limit::{RELATIVE, all_hold, within};
use crate::scenes::three_lights;
use crate::stage::{Stage, at, options, plain, quad};
use crate::surface::AMBIENT;
use glam::{DVec3, Quat, Vec3, Vec4};
use vair::asset::procedural::sphere;
use vair::asset::{LightKind, Material, Transform};
use vair::material::{Cotton, Family, Sheen, SheenModel, SheenTable, Velvet};
use vair::measure::twin::classic::{cotton as classic_cotton, velvet as classic_velvet};
use vair::measure::twin::fuzz::{COTTON_F0, Surface};
use vair::measure::twin::sheen::Lobe;
use vair::render::{FrameSetup, Picture};
use vair::scene::Scene;

const MODELS: [SheenModel; 3] = [SheenModel::Ltc, SheenModel::Charlie, SheenModel::Inverted];

/// Texture units may place a texel to 1/256 of one: what that moves, the table's entries change by. Roughness from 0.3, below
/// which a of the lobe doubles from one node to the next.
const TABLE: f64 = 1e-3;

/// One cloth, how it is seen, and its radiance in double precision: view, light -> BRDF times cosine, and ambient.
struct Cell {
    family: Family,
    material: Material,
    view_deg: f32,
}

fn color(color: Vec4) -> DVec3 {
    color.truncate().as_dvec3()
}

fn table_lobe(table: &SheenTable, sheet: Sheen, roughness: f32) -> Lobe<'_> {
    Lobe { table, sheet, roughness: roughness.into() }
}

/// Diffuse albedo and reflectance of the pile.
fn base(material: &Material) -> (DVec3, DVec3) {
    let metallic = f64::from(material.metallic);
    (color(material.base_color) * (1.0 - metallic), DVec3::splat(COTTON_F0).lerp(color(material.base_color), metallic))
}

fn cotton_surface<'a>(table: &'a SheenTable, cotton: &Cotton, material: &Material) -> Surface<'a> {
    let (diffuse, pile_color) = base(material);
    Surface {
        diffuse,
        pile_color,
        fibre_color: cotton.sheen_color.as_dvec3(),
        pile: table_lobe(table, cotton.sheen.sheet(), material.roughness),
        fibre: table_lobe(table, cotton.sheen.sheet(), cotton.sheen_roughness),
    }
}

fn velvet_surface<'a>(table: &'a SheenTable, velvet: &Velvet, material: &Material) -> Surface<'a> {
    let (diffuse, pile_color) = base(material);
    Surface {
        diffuse,
        pile_color,
        fibre_color: velvet.scatter_color.as_dvec3(),
        pile: table_lobe(table, velvet.sheen.sheet(), material.roughness),
        fibre: table_lobe(table, velvet.sheen.sheet(), velvet.scatter_roughness()),
    }
}

fn radiance(table: &SheenTable, cell: &Cell, v: DVec3, l: DVec3, irradiance: DVec3) -> DVec3 {
    let material = &cell.material;
    let base = color(material.base_color);
    let per_channel = |value: &dyn Fn(usize) -> f64| DVec3::new(value(0), value(1), value(2));
    match &cell.family {
        Family::Cotton(cotton) if cotton.classic => {
            let entry = |roughness: f32| table.at(Sheen::Classic, v.z, roughness.into()).albedo;
            // The base is dimmed by the largest channel of the sheen, the lobe has each channel's own.
            let sheen = cotton.sheen_color.as_dvec3();
            per_channel(&|at| {
                let of = |sheen_color| classic_cotton::Cotton {
                    base_color: base[at],
                    sheen_color,
                    roughness: material.roughness.into(),
                    sheen_roughness: cotton.sheen_roughness.into(),
                };
                let (largest, own) = (sheen.max_element(), sheen[at]);
                let scaled =
                    |of_largest: f64, largest_alone: f64, own_alone: f64| of_largest - largest_alone + own_alone;
                let fuzz = classic_cotton::fuzz_times_cosine(v, l, cotton.sheen_roughness.into());
                let lit = of(largest).brdf_times_cosine(entry(cotton.sheen_roughness), v, l);
                let lit = scaled(lit, largest * fuzz, own * fuzz);
                let pile = entry(material.roughness);
                let fibre = entry(cotton.sheen_roughness);
                let ambient = of(largest).ambient(pile, fibre, v.z, 1.0) + (own - largest) * fibre;
                irradiance[at] * lit + AMBIENT * ambient
            })
        }
        Family::Velvet(velvet) if velvet.classic => per_channel(&|at| {
            let metallic = f64::from(material.metallic);
            let twin = classic_velvet::Velvet {
                base_color: base[at] * (1.0 - metallic),
                f0: COTTON_F0 + (base[at] - COTTON_F0) * metallic,
                roughness: material.roughness.into(),
                scatter_color: velvet.scatter_color[at].into(),
                scatter_scale: velvet.scatter_scale.into(),
            };
            twin.radiance(v, l, irradiance[at]) + AMBIENT * base[at] * (1.0 - metallic)
        }),
        cloth => {
            let surface = match cloth {
                Family::Cotton(cotton) => cotton_surface(table, cotton, material),
                Family::Velvet(velvet) => velvet_surface(table, velvet, material),
                other => panic!("{} has no fuzz", other.kind()),
            };
            surface.brdf_times_cosine(v, l) * irradiance + surface.ambient(v.z, 1.0) * AMBIENT
        }
    }
}

fn cells() -> Vec<Cell> {
    let mut cells = Vec::new();
    for view_deg in [0.0f32, 50.0, 80.0] {
        for roughness in [0.3, 0.9] {
            let material = Material { base_color: Vec4::new(0.8, 0.4, 0.05, 1.0), metallic: 0.7, roughness, ..plain() };
            let mut cell = |cloth| cells.push(Cell { family: cloth, material: material.clone(), view_deg });
            let sheen_color = Vec3::new(0.9, 0.2, 0.5);
            for sheen in MODELS {
                cell(Family::Cotton(Cotton { sheen, sheen_color, sheen_roughness: 0.45, ..Cotton::default() }));
                cell(Family::Velvet(Velvet { sheen, scatter_color: sheen_color, ..Velvet::default() }));
            }
            cell(Family::Cotton(Cotton { sheen_color: Vec3::ZERO, ..Cotton::default() }));
            cell(Family::Cotton(Cotton { classic: true, sheen_color, sheen_roughness: 0.4, ..Cotton::default() }));
            cell(Family::Velvet(Velvet { classic: true, scatter_scale: 0.3, ..Velvet::default() }));
        }
    }
    cells
}

fn tilt(angle_deg: f32) -> Quat {
    Quat::from_rotation_y(angle_deg.to_radians())
}

fn check(device: &mut Headless, to_light: Vec3) -> Vec<Result<(), String>> {
    let irradiance = Vec3::new(0.3, 0.2, 0.25);
    let table = SheenTable::shipped();
    let mut stage = Stage::front(4.0);
    stage.light(LightKind::Directional, irradiance, Vec3::ZERO, to_light);
    let cells = cells();
    for (index, cell) in cells.iter().enumerate() {
        let middle = Vec3::new((index % 8) as f32 - 3.5, 3.5 - (index / 8) as f32, 0.0);
        let material = stage.material(cell.material.clone());
        let half_width_m = 0.49 / cell.view_deg.to_radians().cos();
        let transform = Transform::Trs { translation: middle, rotation: tilt(cell.view_deg), scale: Vec3::ONE };
        stage.object(quad(half_width_m, 0.49), material, transform);
    }
    let mut scene = stage.scene();
    for (material, cell) in scene.materials_mut().iter_mut().zip(&cells) {
        material.family = Some(cell.family.clone());
    }
    let picture = device.picture(&scene, &options([128, 128], 1));
    let one = |(index, cell): (usize, &Cell)| {
        let pixel = [index as u32 % 8 * 16 + 8, index as u32 / 8 * 16 + 8];
        let rotation = tilt(cell.view_deg).inverse();
        let in_tangent = |w: Vec3| (rotation * w).as_dvec3();
        let expected = radiance(&table, cell, in_tangent(Vec3::Z), in_tangent(to_light), irradiance.as_dvec3());
        let what = format!("{:?} roughness {} at {} degrees", cell.family, cell.material.roughness, cell.view_deg);
        within(&what, picture.radiance(pixel[0], pixel[1]), expected, RELATIVE + TABLE, 1e-6)
    };
    cells.iter().enumerate().map(one).collect()
}

#[test]
fn cloth_with_fuzz_has_the_computed_radiance() {
    let from = |angle_deg: f32| Vec3::new(angle_deg.to_radians().sin(), 0.0, angle_deg.to_radians().cos());
    let lights = [from(5.0), Vec3::new(0.5, 0.6, 0.62).normalize(), from(-75.0), Vec3::new(0.3, 0.1, -0.9).normalize()];
    headless(|device| all_hold(lights.into_iter().flat_map(|to_light| check(device, to_light))));
}

/// A facing quad of that cloth, with the ambient and one light.
fn one_quad(dress: impl FnOnce(&mut Stage) -> Family, irradiance: Vec3, material: Material) -> Scene {
    let mut stage = Stage::front(0.5);
    let cloth = dress(&mut stage);
    let index = stage.material(material);
    stage.object(quad(0.8, 0.8), index, at(Vec3::ZERO));
    stage.light(LightKind::Directional, irradiance, Vec3::ZERO, Vec3::new(0.8, 0.0, 0.6));
    let mut scene = stage.scene();
    scene.materials_mut()[0].family = Some(cloth);
    scene
}

fn seen(device: &mut Headless, scene: &Scene) -> Picture {
    device.picture(scene, &options([4, 4], 1))
}

#[test]
fn lut_consistency() {
    // A map of one half and its half as the factor: were lobe and table asked for different roughnesses, this would show.
    let plain_cotton = Cotton { sheen_color: Vec3::ONE, sheen_roughness: 0.4, ..Cotton::default() };
    headless(|device| {
        for (sheen, classic) in [(SheenModel::Ltc, false), (SheenModel::Charlie, false), (SheenModel::Ltc, true)] {
            let plain_cotton = Cotton { sheen, classic, ..plain_cotton.clone() };
            let mapped = |stage: &mut Stage| {
                // 0.4 = 102 / 255: data is not decoded.
                let map = stage.texel([102, 0, 0, 255]);
                Family::Cotton(Cotton { sheen_roughness: 1.0, sheen_roughness_map: Some(map), ..plain_cotton.clone() })
            };
            let with_map = seen(device, &one_quad(mapped, Vec3::ONE, plain()));
            let without = seen(device, &one_quad(|_| Family::Cotton(plain_cotton.clone()), Vec3::ONE, plain()));
            let (found, expected) = (with_map.radiance(2, 2), without.radiance(2, 2).truncate().as_dvec3());
            all_hold([within(&format!("{sheen:?} classic {classic}"), found, expected, RELATIVE, 1e-6)]);
        }
    });
}

#[test]
fn sheen_colours_are_decoded_and_sheen_maps_are_not() {
    let table = SheenTable::shipped();
    headless(|device| {
        for (is_color, share) in [(true, 0.214_041_1), (false, 127.5 / 255.0)] {
            let cotton = Cotton { sheen_color: Vec3::splat(0.8), ..Cotton::default() };
            let mapped = |stage: &mut Stage| {
                let map = Some(stage.texel([128, 128, 128, 255]));
                Family::Cotton(if is_color {
                    Cotton { sheen_color_texture: map, ..cotton.clone() }
                } else {
                    Cotton { sheen_map: map, ..cotton.clone() }
                })
            };
            let picture = seen(device, &one_quad(mapped, Vec3::ZERO, plain()));
            let sheen_color = Vec3::splat(0.8 * share);
            let surface = cotton_surface(&table, &Cotton { sheen_color, ..cotton.clone() }, &plain());
            // 128 is half a step above one half.
            all_hold([within("map", picture.radiance(2, 2), surface.ambient(1.0, 1.0) * AMBIENT, 0.01, 1e-6)]);
        }
    });
}

#[test]
fn unlit_zero() {
    let velvet = |classic| Family::Velvet(Velvet { classic, scatter_color: Vec3::ONE, ..Velvet::default() });
    let cotton = Family::Cotton(Cotton { sheen_color: Vec3::ONE, ..Cotton::default() });
    headless(|device| {
        let mut of_light = |cloth: &Family, irradiance| {
            let mut stage = Stage::front(0.5);
            let material = stage.material(plain());
            let turned = Transform::Trs { translation: Vec3::ZERO, rotation: tilt(60.0), scale: Vec3::ONE };
            stage.object(quad(1.6, 0.8), material, turned);
            if let Some(irradiance) = irradiance {
                stage.light(LightKind::Directional, irradiance, Vec3::ZERO, Vec3::new(0.8, 0.0, 0.6));
            }
            // Another light, so that the ambient is that of a file with lights.
            stage.light(LightKind::Directional, Vec3::ONE, Vec3::ZERO, Vec3::Y);
            let mut scene = stage.scene();
            scene.materials_mut()[0].family = Some(cloth.clone());
            seen(device, &scene).radiance(2, 2)
        };
        for cloth in [velvet(false), cotton] {
            assert_eq!(of_light(&cloth, Some(Vec3::ZERO)), of_light(&cloth, None), "{}", cloth.kind());
        }
        // The classic scatter glows where a light brings nothing: the check sees it. Without any intensity a light is not
        // asked.
        assert_ne!(of_light(&velvet(true), Some(Vec3::splat(1e-20))), of_light(&velvet(true), None));
    });
}

#[test]
fn extremes_are_finite() {
    headless(|device| {
        for roughness in [0.0, 1e-8, 1.0] {
            for sheen in MODELS {
                for classic in [false, true] {
                    let material = Material { roughness, ..plain() };
                    let cotton = Cotton {
                        sheen,
                        classic,
                        sheen_color: Vec3::ONE,
                        sheen_roughness: roughness,
                        ..Cotton::default()
                    };
                    let velvet = Velvet { sheen, classic, scatter_color: Vec3::ONE, ..Velvet::default() };
                    for cloth in [Family::Cotton(cotton), Family::Velvet(velvet)] {
                        let scene = one_quad(|_| cloth.clone(), Vec3::splat(1e38), material.clone());
                        let shown = seen(device, &scene).radiance(2, 2);
                        assert!(shown.is_finite() && shown.min_element() >= 0.0, "{cloth:?} {roughness}: {shown}");
                    }
                }
            }
        }
    });
}

#[test]
fn fibres_that_do_not_stand_cost_nothing() {
    let mapped = |sheen_color: Vec3| {
        one_quad(
            |stage| {
                let map = Some(stage.texel([255; 4]));
                Family::Cotton(Cotton { sheen_color, sheen_map: map, sheen_color_texture: map, ..Cotton::default() })
            },
            Vec3::ONE,
            plain(),
        )
    };
    let textures = |scene: &Scene| FrameSetup::new(scene, &options([4, 4], 1)).unwrap().staging.plan.textures.len();
    assert!(textures(&mapped(Vec3::ZERO)) < textures(&mapped(Vec3::ONE)));
}

/// Cotton above: ltc, Charlie, classic; velvet below: ltc, inverted, classic.
pub fn fuzz_balls() -> Scene {
    let mut stage = Stage::default();
    stage.parallel_camera(1.0, Vec3::new(0.0, 0.2, 1.0), Vec3::Y);
    let cotton = Cotton { sheen_color: Vec3::new(0.6, 0.5, 0.7), ..Cotton::default() };
    let velvet = Velvet { scatter_color: Vec3::new(0.9, 0.15, 0.25), ..Velvet::default() };
    let rows = [
        (
            Vec3::new(0.12, 0.16, 0.35),
            [
                Family::Cotton(cotton.clone()),
                Family::Cotton(Cotton { sheen: SheenModel::Charlie, ..cotton.clone() }),
                Family::Cotton(Cotton { classic: true, ..cotton }),
            ],
        ),
        (
            Vec3::new(0.07, 0.002, 0.012),
            [
                Family::Velvet(velvet.clone()),
                Family::Velvet(Velvet { sheen: SheenModel::Inverted, ..velvet.clone() }),
                Family::Velvet(Velvet { classic: true, ..velvet }),
            ],
        ),
    ];
    for (row, (color, cloths)) in rows.iter().enumerate() {
        for column in 0..cloths.len() {
            let material = Material { base_color: color.extend(1.0), roughness: 0.6, ..plain() };
            let material = stage.material(material);
            let place = Vec3::new(column as f32 - 1.0, 0.48 - 0.96 * row as f32, 0.0);
            stage.object(sphere(0.42, 12), material, at(place));
        }
    }
    three_lights(&mut stage);
    let mut scene = stage.scene();
    let cloths = rows.into_iter().flat_map(|(_, cloths)| cloths);
    scene.materials_mut().iter_mut().zip(cloths).for_each(|(material, cloth)| material.family = Some(cloth));
    scene
}
