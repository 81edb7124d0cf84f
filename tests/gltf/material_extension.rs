//! The material extensions that add lobes: what the file says, and what it must not say.

use crate::builder::*;
use glam::{Vec2, Vec3};
use serde_json::{Value, json};
use vair::asset::{MaterialExtensions, TextureRef};

/// Every extension with every key, the textures on a UV set and a transform of their own.
pub(crate) fn everything() -> Value {
    let transform = json!({ "offset": [0.5, 0.25], "rotation": 1.5, "scale": [2, 3], "texCoord": 1 });
    let texture = json!({ "index": 0, "extensions": { "KHR_texture_transform": transform } });
    json!({
        "KHR_materials_sheen": { "sheenColorFactor": [0.1, 0.2, 0.3], "sheenColorTexture": texture,
            "sheenRoughnessFactor": 0.4, "sheenRoughnessTexture": texture },
        "KHR_materials_clearcoat": { "clearcoatFactor": 0.5, "clearcoatTexture": texture,
            "clearcoatRoughnessFactor": 0.6, "clearcoatRoughnessTexture": texture,
            "clearcoatNormalTexture": { "index": 0, "scale": 0.7 } },
        "KHR_materials_anisotropy": { "anisotropyStrength": 0.8, "anisotropyRotation": -2.5, "anisotropyTexture": texture },
        "KHR_materials_iridescence": { "iridescenceFactor": 0.9, "iridescenceTexture": texture, "iridescenceIor": 1.7,
            "iridescenceThicknessMinimum": 50, "iridescenceThicknessMaximum": 900, "iridescenceThicknessTexture": texture },
        "KHR_materials_specular": { "specularFactor": 0.3, "specularTexture": texture,
            "specularColorFactor": [2, 0.5, 0], "specularColorTexture": texture },
        "KHR_materials_ior": { "ior": 2.4 },
        "KHR_materials_transmission": { "transmissionFactor": 0.25, "transmissionTexture": texture },
        "KHR_materials_volume": { "thicknessFactor": 0.1, "thicknessTexture": texture, "attenuationDistance": 2,
            "attenuationColor": [1, 0.5, 0.25] },
        "KHR_materials_diffuse_transmission": { "diffuseTransmissionFactor": 0.35, "diffuseTransmissionTexture": texture,
            "diffuseTransmissionColorFactor": [1, 0.9, 0.8], "diffuseTransmissionColorTexture": texture },
    })
}

/// A quad of a material with these extensions.
fn dressed(extensions: Value) -> Builder {
    let mut b = quad();
    let image = b.view(&png([1, 2, 3, 4]));
    b.set("/images", json!([{ "bufferView": image }])).set("/textures", json!([{ "source": 0 }]));
    b.set("/materials", json!([{ "extensions": extensions }])).set("/meshes/0/primitives/0/material", json!(0));
    b
}

#[test]
fn extensions_say_what_the_file_says() {
    let asset = dressed(everything()).load().unwrap();
    let MaterialExtensions {
        sheen,
        clearcoat,
        anisotropy,
        iridescence,
        specular,
        ior,
        transmission,
        volume,
        diffuse_transmission,
    } = &asset.materials[0].extensions;
    let (offset, scale) = (Vec2::new(0.5, 0.25), Vec2::new(2.0, 3.0));
    let texture = Some(TextureRef { texture: 0, uv_set: 1, offset, rotation: 1.5, scale });

    let sheen = sheen.as_ref().unwrap();
    assert_eq!((sheen.color, sheen.roughness), (Vec3::new(0.1, 0.2, 0.3), 0.4));
    assert_eq!((sheen.color_texture, sheen.roughness_texture), (texture, texture));
    let coat = clearcoat.as_ref().unwrap();
    assert_eq!((coat.factor, coat.roughness, coat.normal_scale), (0.5, 0.6, 0.7));
    assert_eq!((coat.texture, coat.roughness_texture), (texture, texture));
    assert_eq!(coat.normal_texture.unwrap().uv_set, 0);
    let anisotropy = anisotropy.as_ref().unwrap();
    assert_eq!((anisotropy.strength, anisotropy.rotation, anisotropy.texture), (0.8, -2.5, texture));
    let film = iridescence.as_ref().unwrap();
    assert_eq!((film.factor, film.ior, film.thickness_nm), (0.9, 1.7, [50.0, 900.0]));
    assert_eq!((film.texture, film.thickness_texture), (texture, texture));
    let specular = specular.as_ref().unwrap();
    assert_eq!((specular.factor, specular.color), (0.3, Vec3::new(2.0, 0.5, 0.0)), "a colour above 1 is meant");
    assert_eq!((specular.texture, specular.color_texture), (texture, texture));
    assert_eq!(*ior, Some(2.4));
    let through = transmission.as_ref().unwrap();
    assert_eq!((through.factor, through.texture), (0.25, texture));
    let volume = volume.as_ref().unwrap();
    assert_eq!((volume.thickness, volume.attenuation_distance_m), (0.1, 2.0));
    assert_eq!((volume.attenuation_color, volume.thickness_texture), (Vec3::new(1.0, 0.5, 0.25), texture));
    let scattered = diffuse_transmission.as_ref().unwrap();
    assert_eq!((scattered.factor, scattered.color), (0.35, Vec3::new(1.0, 0.9, 0.8)));
    assert_eq!((scattered.texture, scattered.color_texture), (texture, texture));

    assert_eq!(asset.materials[0].extensions.textures().count(), 14);
    assert_eq!(asset.images[0].width, 1, "an image that an extension alone uses is decoded");
    // What is not shown as glTF means it.
    assert_eq!(asset.warnings.len(), 1, "{:?}", asset.warnings);
    assert!(asset.warnings[0].contains("KHR_materials_transmission.transmissionFactor"), "{:?}", asset.warnings);
}

#[test]
fn empty_extensions_have_the_defaults_of_their_texts() {
    let names = everything().as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    let empty: serde_json::Map<String, Value> = names.iter().map(|name| (name.clone(), json!({}))).collect();
    let asset = dressed(empty.into()).load().unwrap();
    let extensions = &asset.materials[0].extensions;
    assert_eq!((extensions.sheen.as_ref().unwrap().color, extensions.ior), (Vec3::ZERO, Some(1.5)));
    let film = extensions.iridescence.as_ref().unwrap();
    assert_eq!((film.factor, film.ior, film.thickness_nm), (0.0, 1.3, [100.0, 400.0]));
    let specular = extensions.specular.as_ref().unwrap();
    assert_eq!((specular.factor, specular.color), (1.0, Vec3::ONE));
    assert_eq!(extensions.clearcoat.as_ref().unwrap().normal_scale, 1.0);
    assert_eq!(extensions.diffuse_transmission.as_ref().unwrap().color, Vec3::ONE);
    assert!(asset.warnings.is_empty() && extensions.textures().next().is_none(), "{:?}", asset.warnings);
    let none: serde_json::Map<String, Value> = names.iter().map(|name| (name.clone(), Value::Null)).collect();
    let asset = dressed(none.into()).load().unwrap();
    assert_eq!(asset.materials[0].extensions, MaterialExtensions::default());
}

#[test]
fn numbers_outside_their_ranges_are_clamped_with_a_warning() {
    for (name, key, value, field) in [
        ("sheen", "sheenColorFactor", json!([2, 0, 0]), "in [0, 1]"),
        ("sheen", "sheenRoughnessFactor", json!(-1), "in [0, 1]"),
        ("clearcoat", "clearcoatFactor", json!(7), "in [0, 1]"),
        ("anisotropy", "anisotropyStrength", json!(-0.5), "in [0, 1]"),
        ("iridescence", "iridescenceIor", json!(0.5), ">= 1"),
        ("iridescence", "iridescenceThicknessMaximum", json!(-1), ">= 0"),
        ("specular", "specularColorFactor", json!([-1, 0, 0]), ">= 0"),
        ("ior", "ior", json!(0.5), ">= 1"),
        ("diffuse_transmission", "diffuseTransmissionColorFactor", json!([1.5, 1, 1]), "in [0, 1]"),
    ] {
        let asset = dressed(json!({ (format!("KHR_materials_{name}")): { (key): value } })).load().unwrap();
        let [warning] = &asset.warnings[..] else { panic!("{key}: {:?}", asset.warnings) };
        assert!(warning.starts_with(&format!("materials[0].extensions.KHR_materials_{name}.{key}")), "{warning}");
        assert!(warning.contains(field), "{warning}");
    }
    let total = dressed(json!({ "KHR_materials_ior": { "ior": 0 } })).load().unwrap();
    assert_eq!((total.materials[0].extensions.ior, total.warnings.len()), (Some(0.0), 0), "0 reflects everything");
}

#[test]
fn wrong_values_are_named() {
    for (name, value, culprit) in [
        ("sheen", json!(3), "KHR_materials_sheen: is no object"),
        ("sheen", json!({ "sheenColorFactor": 1 }), "sheenColorFactor: must be three numbers"),
        ("sheen", json!({ "sheenColorFactor": [1, 1] }), "sheenColorFactor: must be three numbers"),
        ("sheen", json!({ "sheenColorFactor": [1, "red", 1] }), "sheenColorFactor: must be a number"),
        ("sheen", json!({ "sheenRoughnessFactor": "rough" }), "sheenRoughnessFactor: must be a number"),
        ("sheen", json!({ "sheenColorTexture": { "index": 9 } }), "sheenColorTexture.index: index 9"),
        ("clearcoat", json!({ "clearcoatTexture": {} }), "clearcoatTexture: missing field `index`"),
        (
            "clearcoat",
            json!({ "clearcoatNormalTexture": { "index": 0, "scale": 1e39 } }),
            "clearcoatNormalTexture.scale",
        ),
        ("anisotropy", json!({ "anisotropyRotation": 1e39 }), "anisotropyRotation"),
        ("ior", json!({ "ior": -1e39 }), "ior"),
        ("volume", json!({ "attenuationColor": [1, 1, 1e39] }), "attenuationColor"),
        ("iridescence", json!({ "iridescenceTexture": { "index": -1 } }), "iridescenceTexture"),
    ] {
        let error = dressed(json!({ (format!("KHR_materials_{name}")): value })).error();
        assert!(error.contains(culprit) && error.contains("materials[0]"), "{error}");
    }
}
