//! Nodes, scenes, cameras, lights, animations, materials, extensions.

use crate::builder::*;
use glam::{Mat4, Quat, Vec2, Vec3, Vec4};
use serde_json::{Value, json};
use vair::asset::{AlphaMode, AssetError, Interpolation, Keys, LightKind, Projection, Transform, Wrap};

// ---- nodes, scenes, cameras, lights ----

#[test]
fn transforms_are_read_and_mended() {
    let mut b = Builder::new();
    let matrix = Mat4::from_cols_array(&[1., 0., 0., 0., 0.5, 1., 0., 0., 0., 0., 1., 0., 4., 5., 6., 1.]);
    b.set(
        "/nodes",
        json!([
            { "name": "Füchsin 狐", "translation": [1, 2, 3], "rotation": [0, 0, 2, 0], "scale": [1, -1, 0] },
            { "rotation": [0, 0, 0, 0] },
            { "matrix": matrix.to_cols_array() },
            {},
        ]),
    );
    let asset = b.load().unwrap();
    let rotation = Quat::from_xyzw(0.0, 0.0, 1.0, 0.0);
    let (translation, scale) = (Vec3::new(1.0, 2.0, 3.0), Vec3::new(1.0, -1.0, 0.0));
    assert_eq!(asset.nodes[0].transform, Transform::Trs { translation, rotation, scale });
    assert_eq!(asset.nodes[0].name.as_deref(), Some("Füchsin 狐"));
    assert_eq!(asset.nodes[1].transform, Transform::default());
    assert_eq!(asset.nodes[2].transform, Transform::Matrix(matrix));
    assert_eq!(asset.warnings.len(), 2, "{:?}", asset.warnings);
    assert_eq!(asset.scenes[0].roots, [0, 1, 2, 3]);
}

#[test]
fn scenes_come_in_any_number() {
    let mut b = Builder::new();
    b.set("/nodes", json!([{ "children": [1] }, {}, {}]));
    b.set("/scenes", json!([{ "nodes": [2] }, { "name": "B", "nodes": [1, 0] }]));
    let asset = b.load().unwrap();
    assert_eq!((asset.default_scene, asset.scenes.len()), (0, 2));
    // Node 1 is no root: its tree is shown, once.
    assert_eq!(asset.scenes[1].roots, [0]);
    assert_eq!(asset.warnings.len(), 1, "{:?}", asset.warnings);
    assert_eq!(b.set("/scene", json!(1)).load().unwrap().default_scene, 1);
    assert!(b.set("/scene", json!(2)).error().contains("scene: index 2"));
}

#[test]
fn cycles_and_second_parents_are_named() {
    for (nodes, culprits) in [
        (json!([{ "name": "Arm", "children": [1] }, { "children": [0] }]), &["Arm", "ancestor"][..]),
        (json!([{ "name": "Self", "children": [0] }]), &["Self", "ancestor"]),
        (json!([{ "children": [2] }, { "children": [2] }, { "name": "Hand" }]), &["Hand", "two parents"]),
        (json!([{ "children": [5] }]), &["nodes[0].children[0]", "index 5"]),
        (json!([{ "mesh": 1 }]), &["nodes[0].mesh", "index 1"]),
        (json!([{ "camera": 0 }]), &["nodes[0].camera"]),
        (json!([{ "skin": 0 }]), &["nodes[0].skin"]),
        (json!([{ "extensions": { "KHR_lights_punctual": { "light": 3 } } }]), &["KHR_lights_punctual", "index 3"]),
    ] {
        let error = Builder::new().set("/nodes", nodes).error();
        assert!(culprits.iter().all(|culprit| error.contains(culprit)), "{error}");
    }
}

#[test]
fn deep_chains_fit_a_small_stack() {
    let depth = 200_000;
    let mut nodes: Vec<Value> = (1..depth).map(|child| json!({ "children": [child] })).collect();
    nodes.push(json!({}));
    let all: Vec<usize> = (0..depth).collect();
    let mut b = Builder::new();
    b.set("/nodes", json!(nodes)).set("/scenes", json!([{ "nodes": all }]));
    let thread = std::thread::Builder::new().stack_size(256 << 10).spawn(move || b.load().unwrap()).unwrap();
    let asset = thread.join().unwrap();
    assert_eq!((asset.nodes.len(), asset.scenes[0].roots.as_slice()), (depth, &[0usize][..]));
}

#[test]
fn cameras_and_lights_are_read() {
    let mut b = Builder::new();
    b.set(
        "/cameras",
        json!([
            { "type": "perspective", "name": "P", "perspective": { "yfov": 0.5, "znear": 0.25 } },
            { "type": "orthographic", "orthographic": { "xmag": 2, "ymag": 3, "znear": 0, "zfar": 10 } },
        ]),
    );
    let lights = json!([
        { "type": "directional", "intensity": 3 },
        { "type": "point", "range": 4, "color": [1, 0.5, 0] },
        { "type": "spot", "spot": { "innerConeAngle": 0.25, "outerConeAngle": 0.5 } },
    ]);
    b.set("/extensions", json!({ "KHR_lights_punctual": { "lights": lights } }));
    b.set("/nodes", json!([{ "camera": 1, "extensions": { "KHR_lights_punctual": { "light": 2 } } }]));
    b.set("/extensionsUsed", json!(["KHR_lights_punctual"]));
    let asset = b.load().unwrap();
    let perspective = Projection::Perspective { vertical_fov: 0.5, aspect: None, near_m: 0.25, far_m: None };
    assert_eq!(asset.cameras[0].projection, perspective);
    let parallel = Projection::Orthographic { half_width_m: 2.0, half_height_m: 3.0, near_m: 0.0, far_m: 10.0 };
    assert_eq!(asset.cameras[1].projection, parallel);
    assert_eq!((asset.lights[0].intensity, asset.lights[0].kind), (3.0, LightKind::Directional));
    assert_eq!(asset.lights[1].color, Vec3::new(1.0, 0.5, 0.0));
    assert_eq!(asset.lights[1].kind, LightKind::Point { range_m: Some(4.0) });
    assert_eq!(asset.lights[2].kind, LightKind::Spot { range_m: None, inner_angle: 0.25, outer_angle: 0.5 });
    assert_eq!((asset.nodes[0].camera, asset.nodes[0].light), (Some(1), Some(2)));
    assert!(asset.warnings.is_empty());
    let error = b.set("/cameras/0/perspective/znear", json!(0)).error();
    assert!(error.contains("cameras[0].perspective") && error.contains("znear"), "{error}");
}

// ---- animation ----

#[test]
fn clips_are_read_in_every_interpolation() {
    let mut b = quad();
    let target = b.floats(&[0.0; 12], "VEC3");
    b.set("/meshes/0/primitives/0/targets", json!([{ "POSITION": target }, { "POSITION": target }]));
    let times = b.floats(&[0.0, 1.5], "SCALAR");
    let doubled = b.floats(&[0.0, 0.0, 2.0], "SCALAR");
    let moves = b.floats(&[0.0, 0.0, 0.0, 1.0, 2.0, 3.0], "VEC3");
    let three = b.floats(&[1.0, 1.0, 1.0, 9.0, 9.0, 9.0, 2.0, 2.0, 2.0], "VEC3");
    let turns = b.accessor(&[0, 0, 0, 127, 0, 0, 127, 0], BYTE, "VEC4", 2);
    b.set(&format!("/accessors/{turns}/normalized"), json!(true));
    let weights = b.floats(&(0..12).map(|i| i as f32).collect::<Vec<_>>(), "SCALAR");
    let channel = |sampler, node: Value, path| json!({ "sampler": sampler, "target": { "node": node, "path": path } });
    b.push("nodes", json!({ "matrix": Mat4::IDENTITY.to_cols_array() }));
    b.set("/animations", json!([{ "name": "Walk",
        "samplers": [{ "input": times, "output": moves, "interpolation": "STEP" }, { "input": times, "output": turns },
            { "input": doubled, "output": three }, { "input": times, "output": weights, "interpolation": "CUBICSPLINE" }],
        "channels": [channel(0, json!(0), "translation"), channel(1, json!(0), "rotation"), channel(2, json!(0), "scale"),
            channel(3, json!(0), "weights"), channel(0, json!(1), "translation"), channel(0, Value::Null, "pointer"),
            channel(0, json!(0), "colour")] }]));
    let asset = b.load().unwrap();
    let clip = &asset.animations[0];
    assert_eq!((clip.name.as_deref(), clip.duration_s, clip.channels.len()), (Some("Walk"), 2.0, 4));
    assert_eq!(clip.channels[0].interpolation, Interpolation::Step);
    assert!(matches!(&clip.channels[0].values, Keys::Translation(v) if v[1] == Vec3::new(1.0, 2.0, 3.0)));
    assert!(
        matches!(&clip.channels[1].values, Keys::Rotation(q) if q[..] == [Quat::IDENTITY, Quat::from_xyzw(0.0, 0.0, 1.0, 0.0)])
    );
    assert_eq!(clip.channels[2].times_s, [0.0, 2.0], "a time that does not increase is dropped");
    assert!(matches!(&clip.channels[2].values, Keys::Scale(v) if v[..] == [Vec3::ONE, Vec3::splat(2.0)]));
    assert_eq!(clip.channels[3].interpolation, Interpolation::CubicSpline);
    assert!(
        matches!(&clip.channels[3].values, Keys::Weights { targets: 2, values } if values.len() == 12 && values[11] == 11.0)
    );
    assert_eq!(asset.warnings.len(), 4, "{:?}", asset.warnings);
    assert_eq!(asset.meshes[0].weights, [0.0, 0.0]);
    let error = b.set("/animations/0/samplers/0/output", json!(three)).error();
    assert!(error.contains("animations[0].samplers[0].output") && error.contains("3 elements"), "{error}");
    let error = b.set("/animations/0/channels/0/sampler", json!(8)).error();
    assert!(error.contains("animations[0].channels[0].sampler") && error.contains("index 8"), "{error}");
}

// ---- materials ----

#[test]
fn materials_say_what_the_file_says() {
    let mut b = quad();
    let image = b.view(&png([1, 1, 1, 1]));
    b.set("/images", json!([{ "bufferView": image, "name": "Bild" }]));
    b.set("/samplers", json!([{ "wrapS": 33071, "wrapT": 33648, "magFilter": 9728, "minFilter": 9985 }]));
    b.set("/textures", json!([{ "source": 0, "sampler": 0 }, { "source": 0 }, {}]));
    let transform = json!({ "offset": [0.5, 0.25], "rotation": 1.5, "scale": [2, 3], "texCoord": 1 });
    b.set(
        "/materials",
        json!([{
        "name": "Fell",
        "pbrMetallicRoughness": { "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 7,
            "baseColorTexture": { "index": 0, "extensions": { "KHR_texture_transform": transform } } },
        "occlusionTexture": { "index": 1, "strength": 0.25 }, "emissiveFactor": [1, 0.5, 0], "alphaMode": "MASK",
        "alphaCutoff": 0.75, "doubleSided": true, "emissiveTexture": { "index": 2 },
        "extensions": { "KHR_materials_unlit": {}, "KHR_materials_emissive_strength": { "emissiveStrength": 4 },
            "VAIR_material": { "length_m": 0.03 } },
        "extras": { "other": 1, "vair": { "length_m": 1, "family": "fur" } },
    }, { "alphaMode": "BLEND" }]),
    );
    b.set(
        "/extensions",
        json!({ "KHR_materials_variants": { "variants": [{ "name": "Winter" }, { "name": "Sommer" }] } }),
    );
    b.set("/meshes/0/primitives/0/material", json!(1));
    let mappings = json!({ "mappings": [{ "material": 0, "variants": [1, 0] }] });
    b.set("/meshes/0/primitives/0/extensions", json!({ "KHR_materials_variants": mappings }));
    let asset = b.load().unwrap();
    let m = &asset.materials[0];
    assert_eq!((m.name.as_deref(), m.base_color), (Some("Fell"), Vec4::new(0.1, 0.2, 0.3, 0.4)));
    assert_eq!((m.metallic, m.roughness, m.alpha_mode), (0.5, 1.0, AlphaMode::Mask(0.75)));
    assert_eq!((m.double_sided, m.unlit, m.emissive), (true, true, Vec3::new(4.0, 2.0, 0.0)));
    let base = m.base_color_texture.unwrap();
    assert_eq!((base.texture, base.uv_set, base.rotation), (0, 1, 1.5));
    assert_eq!((base.offset, base.scale), (Vec2::new(0.5, 0.25), Vec2::new(2.0, 3.0)));
    assert_eq!((m.occlusion_texture.unwrap().texture, m.occlusion_strength), (1, 0.25));
    assert_eq!(m.emissive_texture, None, "its texture has no image");
    assert_eq!(Value::from(m.vair.clone().unwrap()), json!({ "length_m": 0.03, "family": "fur" }));
    assert_eq!((asset.materials.len(), asset.materials[1].alpha_mode), (2, AlphaMode::Blend));
    let sampler = asset.textures[0].sampler;
    assert_eq!((sampler.wrap, sampler.mag_linear), ([Wrap::Clamp, Wrap::Mirror], false));
    assert_eq!((sampler.min_linear, sampler.mip_linear), (true, Some(false)));
    assert_eq!(asset.variants, ["Winter", "Sommer"]);
    assert_eq!(asset.meshes[0].primitives[0].variant_materials, [(1, 0), (0, 0)]);
    assert_eq!(asset.images[0].name, "Bild");
    assert!(asset.textures.iter().all(|texture| texture.image < asset.images.len()));
    // Roughness 7 and the texture without an image.
    assert_eq!(asset.warnings.len(), 2, "{:?}", asset.warnings);
    for (pointer, value, culprit) in [
        ("/materials/0/alphaMode", json!("FADE"), "FADE"),
        ("/materials/0/occlusionTexture/index", json!(9), "occlusionTexture.index: index 9"),
        ("/textures/0/source", json!(5), "textures[0].source: index 5"),
        ("/textures/0/sampler", json!(5), "textures[0].sampler: index 5"),
        ("/samplers/0/wrapS", json!(1), "samplers[0].wrapS"),
    ] {
        let mut broken = Builder { json: b.json.clone(), binary: b.binary.clone() };
        let error = broken.set(pointer, value).error();
        assert!(error.contains(culprit), "{error}");
    }
}

#[test]
fn extensions_are_warned_about_or_refused_by_name() {
    let mut b = quad();
    b.set("/extensionsUsed", json!(["EXT_new", "KHR_materials_sheen", "KHR_materials_unlit", "EXT_new"]));
    b.set("/extensionsRequired", json!(["KHR_materials_sheen", "KHR_texture_transform", "VAIR_material"]));
    let warnings = b.load().unwrap().warnings;
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(warnings[0].contains("EXT_new") && warnings[0].contains("ignored"));
    for name in ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_texture_basisu", "EXT_texture_webp"] {
        let error = b.set("/extensionsRequired", json!([name])).load().unwrap_err();
        assert!(matches!(error, AssetError::Unsupported { .. }) && error.to_string().contains(name), "{error}");
    }
}
