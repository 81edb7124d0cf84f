//! Containers, buffers, accessors, limits.

use crate::builder::*;
use glam::{Vec2, Vec3, Vec4};
use serde_json::json;
use vair::asset::{AssetError, LoadOptions, Topology, load};

// ---- containers and buffers ----

#[test]
fn a_plain_quad_arrives_whole() {
    let asset = quad().load().unwrap();
    let primitive = &asset.meshes[0].primitives[0];
    assert_eq!(primitive.vertices.positions, corners());
    assert_eq!(primitive.vertices.normals, vec![Vec3::Z; 4]);
    assert_eq!(primitive.indices, QUAD.map(u32::from));
    assert_eq!(primitive.topology, Topology::Triangles);
    // No material in the file: one default is appended.
    assert_eq!((primitive.material, asset.materials.len()), (0, 1));
    assert_eq!((asset.scenes.len(), asset.scenes[0].roots.as_slice()), (1, &[0usize][..]));
    assert!(asset.warnings.is_empty(), "{:?}", asset.warnings);
}

#[test]
fn gltf_reads_external_data_uri_and_percent_encoded_parts() {
    let folder = tempfile::tempdir().unwrap();
    let mut b = quad();
    b.set("/buffers", json!([{ "byteLength": b.binary.len(), "uri": "b%C3%BCffer%201.bin" }]));
    b.set("/images", json!([{ "uri": "tex.png" }, { "uri": "never/there.png" }]));
    b.set("/textures", json!([{ "source": 0 }, { "source": 1 }, { "source": 0 }]));
    let info = |texture: usize| json!({ "baseColorTexture": { "index": texture } });
    b.set("/materials", json!([{ "pbrMetallicRoughness": info(0) }, { "pbrMetallicRoughness": info(2) }]));
    std::fs::write(folder.path().join("büffer 1.bin"), &b.binary).unwrap();
    std::fs::write(folder.path().join("tex.png"), png([1, 2, 3, 4])).unwrap();
    let path = folder.path().join("scène.gltf");
    // A byte order mark is forgiven.
    std::fs::write(&path, [b"\xEF\xBB\xBF".to_vec(), serde_json::to_vec(&b.json).unwrap()].concat()).unwrap();
    let asset = load(&path, &LoadOptions::default()).unwrap();
    assert_eq!(asset.meshes[0].primitives[0].vertices.positions, corners());
    assert_eq!(asset.images.len(), 2, "shared by two materials, decoded once");
    assert_eq!(asset.images[0].rgba, [1, 2, 3, 4]);
    assert_eq!(asset.images[1].width, 0, "an image that no material uses is not even opened");

    let encode = |bytes: &[u8]| {
        use base64::Engine;
        format!("data:application/octet-stream;base64,{}", base64::engine::general_purpose::STANDARD.encode(bytes))
    };
    b.set("/buffers", json!([{ "byteLength": b.binary.len(), "uri": encode(&b.binary) }]));
    b.set("/images/0/uri", json!(encode(&png([9, 8, 7, 6]))));
    std::fs::write(&path, serde_json::to_vec(&b.json).unwrap()).unwrap();
    let asset = load(&path, &LoadOptions::default()).unwrap();
    assert_eq!(asset.meshes[0].primitives[0].vertices.positions, corners());
    assert_eq!(asset.images[0].rgba, [9, 8, 7, 6]);
}

#[test]
fn bad_containers_are_named() {
    let good = quad().glb();
    let word = |at: usize, value: u32| {
        let mut bytes = good.clone();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        bytes
    };
    for (bytes, culprit) in [
        (vec![], "is empty"),
        (vec![0; 4096], "00 00 00 00"),
        (good[..11].to_vec(), "truncated"),
        (good[..good.len() - 5].to_vec(), "truncated"),
        (word(4, 1), "version 1"),
        (word(8, 15), "length 15"),
        (word(8, u32::MAX), "truncated"),
        (word(12, u32::MAX), "truncated"),
        (word(16, 0), "not JSON"),
        (b"{".to_vec(), "JSON"),
        (b"{}".to_vec(), "asset"),
        (br#"{"asset":{"version":"1.0"},"meshes":{}}"#.to_vec(), "1.0"),
        (br#"{"asset":{"version":"2.0"},"meshes":[{}]}"#.to_vec(), "primitives"),
        (vec![b'['; 100_000], "no glTF"),
        ([br#"{"asset":"#.to_vec(), vec![b'['; 100_000]].concat(), "JSON"),
    ] {
        let error = load_bytes(&bytes).unwrap_err().to_string();
        assert!(error.contains(culprit) && error.contains("file.glb") && !error.contains('\n'), "{culprit}: {error}");
    }
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("nothing.glb");
    assert!(load(&missing, &LoadOptions::default()).unwrap_err().to_string().contains("nothing.glb"));
    assert!(load(folder.path(), &LoadOptions::default()).unwrap_err().to_string().contains("folder"));
    // Bytes after the end are only odd.
    assert_eq!(load_bytes(&[good.clone(), vec![7; 8]].concat()).unwrap().warnings.len(), 1);
}

#[test]
fn nothing_outside_the_folder_is_read() {
    let outer = tempfile::tempdir().unwrap();
    let folder = outer.path().join("in");
    std::fs::create_dir(&folder).unwrap();
    std::fs::write(outer.path().join("t.png"), png([1, 2, 3, 4])).unwrap();
    let absolute = outer.path().join("t.png").display().to_string();
    for uri in ["../t.png", "%2E%2E/t.png", absolute.as_str()] {
        let mut b = quad();
        b.set("/images", json!([{ "uri": uri }])).set("/textures", json!([{ "source": 0 }]));
        b.set("/materials", json!([{ "emissiveTexture": { "index": 0 } }]));
        let path = folder.join("file.glb");
        std::fs::write(&path, b.glb()).unwrap();
        let error = load(&path, &LoadOptions::default()).unwrap_err();
        assert!(matches!(error, AssetError::Outside { .. }), "{error}");
        assert!(error.to_string().contains("images[0].uri") && error.to_string().contains("t.png"), "{error}");
        let allowed = load(&path, &LoadOptions { allow_outside: true, ..LoadOptions::default() }).unwrap();
        assert_eq!(allowed.images[0].rgba, [1, 2, 3, 4]);
    }
}

// ---- accessors ----

#[test]
fn every_component_type_normalises() {
    let mut b = quad();
    let uvs = b.accessor(&[0, 255, 51, 0, 255, 255, 0, 0], UNSIGNED_BYTE, "VEC2", 4);
    b.set(&format!("/accessors/{uvs}/normalized"), json!(true));
    let short_uvs: Vec<u8> = [0u16, 65_535, 13_107, 0, 1, 0, 0, 0].iter().flat_map(|v| v.to_le_bytes()).collect();
    let more_uvs = b.accessor(&short_uvs, UNSIGNED_SHORT, "VEC2", 4);
    b.set(&format!("/accessors/{more_uvs}/normalized"), json!(true));
    // KHR_mesh_quantization: signed bytes, padded to 4.
    let positions = b.accessor(&[127, 128, 0, 0, 64, 0, 0, 0, 1, 2, 3, 0, 0, 0, 0, 0], BYTE, "VEC3", 4);
    b.set(&format!("/accessors/{positions}/normalized"), json!(true));
    let view = b.json["accessors"][positions]["bufferView"].clone();
    b.set(&format!("/bufferViews/{view}/byteStride"), json!(4));
    b.set(&format!("{ATTRIBUTES}/POSITION"), json!(positions));
    b.set(&format!("{ATTRIBUTES}/TEXCOORD_0"), json!(uvs)).set(&format!("{ATTRIBUTES}/TEXCOORD_1"), json!(more_uvs));
    b.set(&format!("{ATTRIBUTES}/TEXCOORD_2"), json!(uvs));
    b.set("/extensionsRequired", json!(["KHR_mesh_quantization"]));
    let asset = b.load().unwrap();
    let vertices = &asset.meshes[0].primitives[0].vertices;
    assert_eq!(vertices.positions[0], Vec3::new(1.0, -1.0, 0.0));
    assert_eq!(vertices.positions[1], Vec3::new(64.0 / 127.0, 0.0, 0.0));
    assert_eq!(vertices.uv_sets[0][..2], [Vec2::new(0.0, 1.0), Vec2::new(0.2, 0.0)]);
    assert_eq!(vertices.uv_sets[1][..2], [Vec2::new(0.0, 1.0), Vec2::new(0.2, 0.0)]);
    assert_eq!(vertices.uv_sets.len(), 2);
    assert!(asset.warnings.len() == 1 && asset.warnings[0].contains("TEXCOORD_2"), "{:?}", asset.warnings);
}

#[test]
fn colours_come_in_three_types_and_two_lengths() {
    let shorts: Vec<u8> = [0u16, 65_535, 13_107].repeat(4).iter().flat_map(|v| v.to_le_bytes()).collect();
    let floats: Vec<u8> = [0.0f32, 1.0, 0.2, 0.5].repeat(4).iter().flat_map(|v| v.to_le_bytes()).collect();
    for (bytes, component, shape, alpha) in [
        ([0u8, 255, 51, 255].repeat(4), UNSIGNED_BYTE, "VEC4", 1.0),
        (shorts, UNSIGNED_SHORT, "VEC3", 1.0),
        (floats, FLOAT, "VEC4", 0.5),
    ] {
        let mut b = quad();
        let colors = b.accessor(&bytes, component, shape, 4);
        b.set(&format!("{ATTRIBUTES}/COLOR_0"), json!(colors));
        let asset = b.load().unwrap();
        let expected = vec![Vec4::new(0.0, 1.0, 0.2, alpha); 4];
        assert_eq!(asset.meshes[0].primitives[0].vertices.colors, expected, "{component} {shape}");
    }
}

#[test]
fn interleaved_sparse_and_absent_views_read_right() {
    let mut b = Builder::new();
    // Position and normal in turns, 24 bytes apart.
    let mixed: Vec<f32> = corners().iter().flat_map(|p| [p.x, p.y, p.z, 0.0, 0.0, 1.0]).collect();
    let positions = b.accessor(bytemuck::cast_slice(&mixed), FLOAT, "VEC3", 4);
    let view = b.json["accessors"][positions]["bufferView"].clone();
    b.set(&format!("/bufferViews/{view}/byteStride"), json!(24));
    let normals = b.push(
        "accessors",
        json!({ "bufferView": view, "byteOffset": 12, "componentType": FLOAT, "type": "VEC3", "count": 4 }),
    );
    // A morph target without a view: zeros, but element 2 replaced.
    let at = b.view(&[2]);
    let by = b.view(bytemuck::cast_slice(&[5.0f32, 6.0, 7.0]));
    let sparse = json!({ "count": 1, "indices": { "bufferView": at, "componentType": UNSIGNED_BYTE },
        "values": { "bufferView": by } });
    let target = b.push("accessors", json!({ "componentType": FLOAT, "type": "VEC3", "count": 4, "sparse": sparse }));
    b.mesh(json!({ "attributes": { "POSITION": positions, "NORMAL": normals }, "mode": 5,
        "targets": [{ "POSITION": target }] }));
    b.set("/meshes/0/weights", json!([0.25]));
    let asset = b.load().unwrap();
    let primitive = &asset.meshes[0].primitives[0];
    assert_eq!(primitive.vertices.positions, corners());
    assert_eq!(primitive.vertices.normals, vec![Vec3::Z; 4]);
    assert_eq!(primitive.indices, [0, 1, 2, 1, 3, 2]);
    let moved = vec![Vec3::ZERO, Vec3::ZERO, Vec3::new(5.0, 6.0, 7.0), Vec3::ZERO];
    assert_eq!(primitive.morph_targets[0].positions, moved);
    assert_eq!(asset.meshes[0].weights, [0.25]);
}

#[test]
fn bad_accessors_are_named() {
    type Break = fn(&mut Builder) -> &mut Builder;
    let cases: [(Break, &[&str]); 14] = [
        (|b| b.set("/accessors/0/bufferView", json!(99)), &["accessors[0]", "99", "3 entries"]),
        (|b| b.set("/accessors/0/count", json!(5)), &["accessors[0]", "run past"]),
        (|b| b.set("/accessors/0/byteOffset", json!(u64::MAX)), &["accessors[0]", "run past"]),
        (|b| b.set("/accessors/0/componentType", json!(7)), &["accessors[0]", "7"]),
        (|b| b.set("/accessors/0/type", json!("VEC2")), &["POSITION", "VEC2", "VEC3"]),
        (|b| b.set("/accessors/1/count", json!(3)), &["NORMAL", "3", "4"]),
        (|b| b.set("/bufferViews/0/byteStride", json!(8)), &["bufferViews[0].byteStride", "8"]),
        (|b| b.set("/bufferViews/0/buffer", json!(1)), &["bufferViews[0].buffer", "index 1"]),
        (|b| b.set("/bufferViews/0/byteLength", json!(u64::MAX)), &["bufferViews[0]", "run past"]),
        (|b| b.set("/buffers", json!([{ "byteLength": 1000 }])), &["buffers[0].byteLength", "1000"]),
        (|b| b.set(&format!("{ATTRIBUTES}/POSITION"), json!(9)), &["POSITION", "index 9", "accessors"]),
        (|b| b.set("/meshes/0/primitives/0/indices", json!(0)), &["indices", "unsigned"]),
        (|b| b.set("/meshes/0/primitives/0/mode", json!(7)), &["mode", "7"]),
        (|b| b.set("/meshes/0/primitives/0/material", json!(3)), &["primitives[0].material", "index 3"]),
    ];
    for (change, culprits) in cases {
        let mut b = quad();
        change(&mut b);
        let error = b.error();
        assert!(culprits.iter().all(|culprit| error.contains(culprit)), "{culprits:?}: {error}");
    }
}

#[test]
fn numbers_that_are_not_finite_are_named() {
    for bad in [f32::NAN, f32::INFINITY] {
        let mut b = quad();
        let mut numbers = CORNERS;
        numbers[7] = bad;
        let positions = b.floats(&numbers, "VEC3");
        b.set(&format!("{ATTRIBUTES}/POSITION"), json!(positions));
        let error = b.error();
        assert!(
            error.contains("meshes[0].primitives[0].attributes.POSITION") && error.contains("element 2"),
            "{error}"
        );
    }
    let mut b = quad();
    let mut matrix = vec![0.0; 16];
    matrix[4] = 1e39;
    b.set("/nodes/0/matrix", json!(matrix));
    let error = b.error();
    assert!(error.contains("nodes[0].matrix") && error.contains("number 4"), "{error}");
    // What becomes a parameter of a shader; texels are bytes and cannot be anything else.
    let factors: [(&str, serde_json::Value); 5] = [
        ("pbrMetallicRoughness", json!({ "baseColorFactor": [1.0, 1e39, 1.0, 1.0] })),
        ("pbrMetallicRoughness", json!({ "roughnessFactor": 1e39 })),
        ("emissiveFactor", json!([0.0, 0.0, 1e39])),
        ("alphaCutoff", json!(1e39)),
        ("normalTexture", json!({ "index": 0, "scale": -1e39 })),
    ];
    for (key, value) in factors {
        let mut b = quad();
        b.set("/materials", json!([{ key: value }]));
        b.set("/textures", json!([{}]));
        let error = b.error();
        assert!(error.contains("materials[0]") && error.contains("finite"), "{key}: {error}");
    }
}

#[test]
fn indices_out_of_range_are_named() {
    let mut b = quad();
    let indices = b.shorts(&[0, 1, 4]);
    b.set("/meshes/0/primitives/0/indices", json!(indices));
    let error = b.error();
    for culprit in ["meshes[0].primitives[0].indices", "element 2 is 4", "4 vertices"] {
        assert!(error.contains(culprit), "{error}");
    }
}

#[test]
fn memory_is_counted_before_it_is_taken() {
    let mut b = quad();
    let at = b.view(&[0, 0, 0, 0]);
    let by = b.view(&[0; 12]);
    let huge = b.push(
        "accessors",
        json!({ "componentType": FLOAT, "type": "VEC3", "count": 4_000_000_000u64, "sparse": { "count": 1,
            "indices": { "bufferView": at, "componentType": UNSIGNED_INT }, "values": { "bufferView": by } } }),
    );
    b.set(&format!("{ATTRIBUTES}/POSITION"), json!(huge));
    let error = b.load().unwrap_err();
    assert!(matches!(error, AssetError::Memory { limit_bytes, .. } if limit_bytes == 4 << 30), "{error}");
    assert!(error.to_string().contains("POSITION"), "{error}");
    assert!(matches!(load_limited(&quad().glb(), 100), Err(AssetError::Memory { .. })));
}
