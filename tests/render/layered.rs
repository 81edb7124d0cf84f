//! What glTF's material extensions say is what is seen: each lobe and all of them together have the computed radiance, a
//! texture says the same as its factor, and what is off costs nothing.

use crate::headless::{Headless, headless};
use crate::limit::{ABSOLUTE, RELATIVE, all_hold, within};
use crate::stage::{Stage, at, options, plain, quad};
use crate::surface::AMBIENT;
use glam::{DVec3, Quat, Vec3, Vec4};
use vair::asset::{
    Anisotropy, Clearcoat, DiffuseTransmission, Iridescence, LightKind, Material, MaterialExtensions, Sheen, Specular,
    TextureRef, Transform, Transmission,
};
use vair::material::{Family, SheenTable};
use vair::measure::twin::albedo::Fit;
use vair::measure::twin::color::linear_from_srgb;
use vair::measure::twin::film;
use vair::measure::twin::layered::{Base, Parameters, Stack, clearcoat, sheen_albedo, through};
use vair::render::FrameSetup;

const GREY: f32 = 0.6;
const IRRADIANCE: f64 = 0.25;
/// Texture units may place a texel of the table of fuzz to 1/256 of one.
const TABLE: f64 = 4e-3;

fn sheen() -> Sheen {
    Sheen { color: Vec3::splat(0.7), color_texture: None, roughness: 0.6, roughness_texture: None }
}

fn varnish() -> Clearcoat {
    Clearcoat {
        factor: 0.8,
        texture: None,
        roughness: 0.3,
        roughness_texture: None,
        normal_texture: None,
        normal_scale: 1.0,
    }
}

fn streak() -> Anisotropy {
    Anisotropy { strength: 0.7, rotation: 0.6, texture: None }
}

fn thin_film() -> Iridescence {
    Iridescence { factor: 0.9, texture: None, ior: 1.8, thickness_nm: [200.0, 520.0], thickness_texture: None }
}

fn reflection() -> Specular {
    Specular { factor: 0.6, texture: None, color: Vec3::splat(3.0), color_texture: None }
}

fn transmission() -> Transmission {
    Transmission { factor: 0.5, texture: None }
}

fn scattering() -> DiffuseTransmission {
    DiffuseTransmission { factor: 0.4, texture: None, color: Vec3::splat(0.9), color_texture: None }
}

/// Each extension alone, and the combinations that files use.
fn dresses() -> Vec<MaterialExtensions> {
    let none = MaterialExtensions::default;
    let sheen = || Some(Box::new(sheen()));
    let clearcoat = || Some(Box::new(varnish()));
    let anisotropy = || Some(Box::new(streak()));
    let iridescence = || Some(Box::new(thin_film()));
    let specular = || Some(Box::new(reflection()));
    vec![
        MaterialExtensions { sheen: sheen(), ..none() },
        MaterialExtensions { clearcoat: clearcoat(), ..none() },
        MaterialExtensions { anisotropy: anisotropy(), ..none() },
        MaterialExtensions { iridescence: iridescence(), ..none() },
        MaterialExtensions { specular: specular(), ..none() },
        MaterialExtensions { ior: Some(2.2), ..none() },
        MaterialExtensions { ior: Some(0.0), ..none() },
        MaterialExtensions { transmission: Some(Box::new(transmission())), ..none() },
        MaterialExtensions { diffuse_transmission: Some(Box::new(scattering())), ..none() },
        MaterialExtensions { sheen: sheen(), clearcoat: clearcoat(), anisotropy: anisotropy(), ..none() },
        MaterialExtensions {
            sheen: sheen(),
            clearcoat: clearcoat(),
            anisotropy: anisotropy(),
            iridescence: iridescence(),
            specular: specular(),
            ior: Some(1.7),
            transmission: Some(Box::new(transmission())),
            volume: None,
            diffuse_transmission: Some(Box::new(scattering())),
        },
    ]
}

/// Radiance of a grey material towards `v` and its opacity, by the twins: each channel of the film on its own.
fn radiance(material: &Material, v: DVec3, l: DVec3) -> (DVec3, f64) {
    let (fit, table, extensions) = (Fit::shipped(), SheenTable::shipped(), &material.extensions);
    let specular = extensions.specular.as_ref();
    let scattered = extensions.diffuse_transmission.as_ref();
    let metallic = f64::from(material.metallic);
    let mut base = Base::new(&Parameters {
        base_color: GREY.into(),
        metallic,
        roughness: material.roughness.into(),
        anisotropy: extensions.anisotropy.as_ref().map_or(0.0, |streak| streak.strength.into()),
        ior: extensions.ior.unwrap_or(1.5).into(),
        specular: specular.map_or(1.0, |specular| specular.factor.into()),
        specular_color: specular.map_or(1.0, |specular| specular.color.x.into()),
        diffuse_transmission: scattered.map_or(0.0, |through| through.factor.into()),
    });
    if let Some(through) = scattered {
        base.transmitted *= f64::from(through.color.x);
    }
    let straight = extensions.transmission.as_ref().map_or(0.0, |through| f64::from(through.factor));
    base.reflected *= 1.0 - straight;
    base.transmitted *= 1.0 - straight;
    if let Some(layer) = &extensions.iridescence {
        let (share, f0) = (f64::from(layer.factor), base.lobe.f0);
        let seen = film::Fit::shipped().reflectance(v.z, layer.thickness_nm[1].into(), layer.ior.into(), f0);
        let of_film = DVec3::from_array(seen.to_array().map(|seen| film::f0_of_reflectance(seen, v.z)));
        base.lobe.f0 = f0.lerp(of_film, share);
        base.lobe.f90 += (1.0 - base.lobe.f90) * share;
    }
    let (fuzz, varnish) = (extensions.sheen.as_ref(), extensions.clearcoat.as_ref());
    let turn = extensions.anisotropy.as_ref().map_or(0.0, |streak| f64::from(streak.rotation));
    let [v, l] = [v, l].map(|w| glam::DQuat::from_rotation_z(-turn) * w);
    let channel = |at: usize| {
        let mut base = base;
        base.lobe.f0 = DVec3::splat(base.lobe.f0[at]);
        let stack = Stack {
            base,
            sheen_color: fuzz.map_or(0.0, |fuzz| fuzz.color.x.into()),
            sheen_roughness: fuzz.map_or(0.5, |fuzz| fuzz.roughness.into()),
            clearcoat: varnish.map_or(0.0, |coat| coat.factor.into()),
            clearcoat_roughness: varnish.map_or(0.5, |coat| coat.roughness.into()),
            table: &table,
        };
        stack.times_cosine(&fit, v, l) * IRRADIANCE + stack.ambient(&fit, v) * AMBIENT
    };
    let own = DVec3::new(channel(0), channel(1), channel(2));
    // What shines through from behind is dimmed by every layer on the eye's side.
    let fuzz_left = fuzz.map_or(1.0, |fuzz| {
        let entry = table.at(vair::material::Sheen::Charlie, v.z, fuzz.roughness.into());
        1.0 - f64::from(fuzz.color.x) * sheen_albedo(entry.albedo)
    });
    let coat_left = varnish
        .map_or(1.0, |layer| 1.0 - f64::from(layer.factor) * clearcoat(layer.roughness.into()).albedo(&fit, v).x);
    let behind = through(straight, metallic, DVec3::splat(GREY.into()), base.lobe.albedo(&fit, v));
    // A picture has one opacity.
    let behind = behind.element_sum() / 3.0;
    (own, 1.0 - behind * fuzz_left * coat_left)
}

/// A row of quads, one a dress, seen at an angle along its tangent and lit from `to_light`.
fn check_row(
    device: &mut Headless,
    metallic: f32,
    roughness: f32,
    view_deg: f32,
    to_light: Vec3,
) -> Vec<Result<(), String>> {
    let mut stage = Stage::front(0.5);
    stage.light(LightKind::Directional, Vec3::splat(IRRADIANCE as f32), Vec3::ZERO, to_light);
    let tilt = Quat::from_rotation_y(view_deg.to_radians());
    let dresses = dresses();
    let mut materials = Vec::new();
    for (column, extensions) in dresses.iter().enumerate() {
        let base_color = Vec4::new(GREY, GREY, GREY, 1.0);
        let material = Material { base_color, metallic, roughness, extensions: extensions.clone(), ..plain() };
        let translation = Vec3::X * (column as f32 - 0.5 * (dresses.len() - 1) as f32);
        let transform = Transform::Trs { translation, rotation: tilt, scale: Vec3::ONE };
        materials.push(material.clone());
        let material = stage.material(material);
        stage.object(quad(0.49 / view_deg.to_radians().cos(), 0.49), material, transform);
    }
    let picture = device.picture(&stage.scene(), &options([16 * materials.len() as u32, 16], 1));
    let [v, l] = [Vec3::Z, to_light].map(|w| (tilt.inverse() * w).as_dvec3());
    let check = |(column, material): (usize, &Material)| {
        let what = format!(
            "metallic {metallic} roughness {roughness} at {view_deg} degrees, light {to_light}: {:?}",
            material.extensions
        );
        let found = picture.radiance(16 * column as u32 + 8, 8);
        let table = if material.extensions.sheen.is_some() { TABLE } else { 0.0 };
        let (expected, opacity) = radiance(material, v, l);
        if (f64::from(found.w) - opacity).abs() > RELATIVE + table {
            return Err(format!("{what}: opacity {} is not the computed {opacity}", found.w));
        }
        within(&what, found, expected, RELATIVE + table, ABSOLUTE)
    };
    materials.iter().enumerate().map(check).collect()
}

#[test]
fn a_lit_quad_has_the_radiance_of_its_layers() {
    let above = Vec3::new(0.5, 0.6, 0.62).normalize();
    let behind = Vec3::new(0.2, 0.1, -0.97).normalize();
    let rows = [
        (0.0, 0.5, 0.0, above),
        (0.0, 0.2, 50.0, above),
        (0.0, 0.9, 50.0, behind),
        (1.0, 0.4, 50.0, above),
        (0.5, 1.0, 80.0, above),
    ];
    headless(|device| {
        all_hold(rows.into_iter().flat_map(|(metallic, roughness, view_deg, to_light)| {
            check_row(device, metallic, roughness, view_deg, to_light)
        }));
    });
}

/// Texel of every map: no channel is another.
const TEXEL: [u8; 4] = [204, 102, 153, 51];

/// Pairs of a factor that has the map's value in it, and the same with the map.
fn pairs(map: TextureRef) -> Vec<(MaterialExtensions, MaterialExtensions)> {
    let [r, g, b, a] = TEXEL.map(|byte| f32::from(byte) / 255.0);
    let decoded = Vec3::from_array([0, 1, 2].map(|at| linear_from_srgb(f64::from(TEXEL[at]) / 255.0) as f32));
    let (map, none) = (Some(map), MaterialExtensions::default);
    let fuzz = |sheen| MaterialExtensions { sheen: Some(Box::new(sheen)), ..none() };
    let coat = |coat| MaterialExtensions { clearcoat: Some(Box::new(coat)), ..none() };
    let turned = |streak| MaterialExtensions { anisotropy: Some(Box::new(streak)), ..none() };
    let filmed = |film| MaterialExtensions { iridescence: Some(Box::new(film)), ..none() };
    let strong = |specular| MaterialExtensions { specular: Some(Box::new(specular)), ..none() };
    let clear = |clear| MaterialExtensions { transmission: Some(Box::new(clear)), ..none() };
    let paper = |paper| MaterialExtensions { diffuse_transmission: Some(Box::new(paper)), ..none() };
    let direction = f32::atan2(g * 2.0 - 1.0, r * 2.0 - 1.0);
    let thickness = thin_film().thickness_nm;
    let thickness = thickness[0] + (thickness[1] - thickness[0]) * g;
    vec![
        (fuzz(Sheen { color: sheen().color * decoded, ..sheen() }), fuzz(Sheen { color_texture: map, ..sheen() })),
        (fuzz(Sheen { roughness: 0.6 * a, ..sheen() }), fuzz(Sheen { roughness_texture: map, ..sheen() })),
        (coat(Clearcoat { factor: 0.8 * r, ..varnish() }), coat(Clearcoat { texture: map, ..varnish() })),
        (coat(Clearcoat { roughness: 0.3 * g, ..varnish() }), coat(Clearcoat { roughness_texture: map, ..varnish() })),
        (
            turned(Anisotropy { strength: 0.7 * b, rotation: 0.6 + direction, texture: None }),
            turned(Anisotropy { texture: map, ..streak() }),
        ),
        (filmed(Iridescence { factor: 0.9 * r, ..thin_film() }), filmed(Iridescence { texture: map, ..thin_film() })),
        (
            filmed(Iridescence { thickness_nm: [0.0, thickness], ..thin_film() }),
            filmed(Iridescence { thickness_texture: map, ..thin_film() }),
        ),
        (strong(Specular { factor: 0.6 * a, ..reflection() }), strong(Specular { texture: map, ..reflection() })),
        (
            strong(Specular { color: reflection().color * decoded, ..reflection() }),
            strong(Specular { color_texture: map, ..reflection() }),
        ),
        (
            clear(Transmission { factor: 0.5 * r, texture: None }),
            clear(Transmission { texture: map, ..transmission() }),
        ),
        (
            paper(DiffuseTransmission { factor: 0.4 * a, ..scattering() }),
            paper(DiffuseTransmission { texture: map, ..scattering() }),
        ),
        (
            paper(DiffuseTransmission { color: scattering().color * decoded, ..scattering() }),
            paper(DiffuseTransmission { color_texture: map, ..scattering() }),
        ),
    ]
}

#[test]
fn a_texture_says_the_same_as_its_factor() {
    let mut stage = Stage::front(1.0);
    let map = stage.texel(TEXEL);
    stage.light(LightKind::Directional, Vec3::ONE, Vec3::ZERO, Vec3::new(0.3, 0.4, 0.86).normalize());
    let tilt = Quat::from_rotation_x(-0.7);
    let pairs = pairs(map);
    for (column, (by_factor, by_map)) in pairs.iter().enumerate() {
        for (row, extensions) in [by_factor, by_map].into_iter().enumerate() {
            let base_color = Vec4::new(GREY, GREY, GREY, 1.0);
            let material = Material { base_color, roughness: 0.4, extensions: extensions.clone(), ..plain() };
            let material = stage.material(material);
            let translation = Vec3::new(column as f32 + 0.5 - 0.5 * pairs.len() as f32, 0.5 - row as f32, 0.0);
            let transform = Transform::Trs { translation, rotation: tilt, scale: Vec3::ONE };
            stage.object(quad(0.49, 0.49), material, transform);
        }
    }
    headless(|device| {
        let picture = device.picture(&stage.scene(), &options([16 * pairs.len() as u32, 32], 1));
        all_hold(pairs.iter().enumerate().map(|(column, (_, by_map))| {
            let [expected, found] = [8, 24].map(|y| picture.radiance(16 * column as u32 + 8, y));
            // Decoded by approximation: half a step of 8 bits of a byte of 102, times the slope 2.4 of the decoding.
            let decoded = 2.4 * 0.5 / 102.0;
            within(&format!("{by_map:?}"), found, expected.truncate().as_dvec3(), RELATIVE + decoded, ABSOLUTE)
        }));
    });
}

#[test]
fn maps_and_lobes_that_are_off_cost_nothing() {
    let switched_on = |extensions: MaterialExtensions| {
        let mut stage = Stage::front(0.5);
        stage.texel(TEXEL);
        let material = stage.material(Material { extensions, ..plain() });
        stage.object(quad(0.5, 0.5), material, at(Vec3::ZERO));
        let scene = stage.scene();
        let plan = FrameSetup::new(&scene, &options([8, 8], 1)).unwrap_or_else(|error| panic!("{error}")).staging.plan;
        let constants = plan.pipelines.iter().flat_map(|spec| spec.constants.clone());
        let is_shared = |name: &str| ["ALPHA_MODE", "SAMPLE_COUNT", "DOUBLE_SIDED"].contains(&name);
        let on = constants.filter(|(name, value)| *value != 0 && !is_shared(name)).map(|(name, _)| name);
        (scene.materials()[0].kind(), on.collect::<Vec<_>>(), plan.tables.len())
    };
    let mut stage = Stage::front(0.5);
    let map = Some(stage.texel(TEXEL));
    let off = MaterialExtensions {
        sheen: Some(Box::new(Sheen { color: Vec3::ZERO, color_texture: map, ..sheen() })),
        clearcoat: Some(Box::new(Clearcoat { factor: 0.0, texture: map, ..varnish() })),
        ior: Some(1.5),
        ..MaterialExtensions::default()
    };
    assert_eq!(switched_on(off.clone()), ("standard", vec![], 0), "what changes nothing is the standard surface");
    let one = MaterialExtensions { ior: Some(1.3), ..off };
    assert_eq!(switched_on(one), ("layered", vec![], 0), "no lobe, and no map of a lobe that is off");
    let coat = MaterialExtensions { clearcoat: Some(Box::new(varnish())), ..MaterialExtensions::default() };
    assert_eq!(switched_on(coat), ("layered", vec!["CLEARCOAT"], 0));
    let fuzz = MaterialExtensions { sheen: Some(Box::new(sheen())), ..MaterialExtensions::default() };
    assert_eq!(switched_on(fuzz), ("layered", vec![], 1), "the table of its fuzz");
}

#[test]
fn a_file_with_extensions_becomes_layered() {
    let mut stage = Stage::front(0.5);
    let clearcoat = Some(Box::new(varnish()));
    let anisotropy = Some(Box::new(streak()));
    let extensions = MaterialExtensions { clearcoat, anisotropy, ..MaterialExtensions::default() };
    let material = Material { name: Some("Paint".to_owned()), extensions, ..plain() };
    let material = stage.material(material);
    stage.object(quad(0.5, 0.5), material, at(Vec3::ZERO));
    let scene = stage.scene();
    let Some(Family::Layered(layered)) = &scene.materials()[0].family else { panic!("layered") };
    assert_eq!((layered.clearcoat, layered.clearcoat_roughness, layered.anisotropy), (0.8, 0.3, 0.7));
    assert!((layered.anisotropy_rotation - 0.6f32.to_degrees()).abs() < 1e-4);
}
