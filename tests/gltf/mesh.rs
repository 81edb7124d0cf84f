//! Meshes and skins.

use crate::builder::*;
use glam::{Mat4, Vec3, Vec4};
use serde_json::json;
use vair::asset::Topology;

// ---- meshes ----

#[test]
fn modes_become_lists_and_normals_become_flat() {
    for (mode, topology, count) in [
        (0, Topology::Points, 4),
        (1, Topology::Lines, 4),
        (2, Topology::Lines, 8),
        (3, Topology::Lines, 6),
        (4, Topology::Triangles, 3),
        (5, Topology::Triangles, 6),
        (6, Topology::Triangles, 6),
    ] {
        let mut b = Builder::new();
        let positions = b.floats(&CORNERS, "VEC3");
        b.mesh(json!({ "attributes": { "POSITION": positions }, "mode": mode }));
        let asset = b.load().unwrap();
        let primitive = &asset.meshes[0].primitives[0];
        assert_eq!((primitive.topology, primitive.indices.len()), (topology, count), "mode {mode}");
        if topology == Topology::Triangles {
            assert_eq!(primitive.vertices.normals.len(), count, "each corner has its own vertex");
            assert!(primitive.vertices.normals.iter().all(|n| n.x == 0.0 && n.y == 0.0 && n.z.abs() == 1.0));
            assert_eq!(primitive.vertices.normals[0], Vec3::Z);
        } else {
            assert!(primitive.vertices.normals.is_empty());
        }
        // Four vertices make one triangle and a rest.
        assert_eq!(asset.warnings.len(), usize::from(mode == 4), "{:?}", asset.warnings);
    }
}

#[test]
fn flat_normals_carry_every_attribute_along() {
    let mut b = Builder::new();
    let positions = b.floats(&CORNERS, "VEC3");
    let uvs = b.floats(&[0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0], "VEC2");
    let indices = b.shorts(&QUAD);
    b.mesh(json!({ "attributes": { "POSITION": positions, "TEXCOORD_0": uvs }, "indices": indices,
        "targets": [{ "POSITION": positions }] }));
    let asset = b.load().unwrap();
    let primitive = &asset.meshes[0].primitives[0];
    let expected: Vec<Vec3> = QUAD.iter().map(|&i| corners()[usize::from(i)]).collect();
    assert_eq!(primitive.vertices.positions, expected);
    assert_eq!(primitive.morph_targets[0].positions, expected);
    assert_eq!(primitive.vertices.uv_sets[0], expected.iter().map(|p| p.truncate()).collect::<Vec<_>>());
    assert_eq!(primitive.vertices.normals, vec![Vec3::Z; 6]);
    assert_eq!(primitive.indices, [0, 1, 2, 3, 4, 5]);
}

#[test]
fn tangents_are_made_only_for_normal_maps() {
    let mut b = quad();
    // The picture upright: v runs down.
    let uvs = b.floats(&[0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0], "VEC2");
    let image = b.view(&png([128, 128, 255, 255]));
    b.set(&format!("{ATTRIBUTES}/TEXCOORD_0"), json!(uvs));
    b.set("/images", json!([{ "bufferView": image, "mimeType": "image/png" }]));
    b.set("/textures", json!([{ "source": 0 }])).set("/materials", json!([{}, {}]));
    b.set("/meshes/0/primitives/0/material", json!(0));
    assert!(b.load().unwrap().meshes[0].primitives[0].vertices.tangents.is_empty());
    b.set("/materials/0/normalTexture", json!({ "index": 0, "scale": 0.5 }));
    let asset = b.load().unwrap();
    let primitive = &asset.meshes[0].primitives[0];
    assert_eq!(primitive.vertices.tangents, vec![Vec4::new(1.0, 0.0, 0.0, 1.0); 4]);
    assert_eq!(primitive.indices, QUAD.map(u32::from));
    assert_eq!(asset.materials[0].normal_scale, 0.5);
    assert_eq!(asset.images[0].rgba, [128, 128, 255, 255]);
    // Without its UV set: a warning, no tangents.
    b.set("/materials/0/normalTexture", json!({ "index": 0, "texCoord": 1 }));
    let asset = b.load().unwrap();
    assert!(asset.meshes[0].primitives[0].vertices.tangents.is_empty());
    assert!(asset.warnings[0].contains("TEXCOORD_1"), "{:?}", asset.warnings);
}

#[test]
fn degenerate_normals_and_tangents_are_replaced_with_one_warning_each() {
    let mut b = quad();
    let normals = b.floats(&[0.0; 12], "VEC3");
    let tangents = b.floats(&[0.0, 0.0, 0.0, -1.0].repeat(4), "VEC4");
    b.set(&format!("{ATTRIBUTES}/NORMAL"), json!(normals)).set(&format!("{ATTRIBUTES}/TANGENT"), json!(tangents));
    let asset = b.load().unwrap();
    let vertices = &asset.meshes[0].primitives[0].vertices;
    assert_eq!(vertices.normals, vec![Vec3::Z; 4]);
    for tangent in &vertices.tangents {
        assert!(tangent.truncate().dot(Vec3::Z).abs() < 1e-6 && (tangent.truncate().length() - 1.0).abs() < 1e-6);
        assert_eq!(tangent.w, -1.0);
    }
    assert_eq!(asset.warnings.len(), 2, "{:?}", asset.warnings);
}

#[test]
fn a_primitive_without_positions_is_skipped() {
    let mut b = quad();
    b.json["meshes"][0]["primitives"].as_array_mut().unwrap().push(json!({ "attributes": {} }));
    let asset = b.load().unwrap();
    assert_eq!(asset.meshes[0].primitives.len(), 1);
    assert!(asset.warnings[0].contains("primitives[1]") && asset.warnings[0].contains("POSITION"));
}

// ---- skins ----

#[test]
fn skins_renormalise_weights_and_default_their_matrices() {
    let weights = [[1.0, 3.0, 0.0, 0.0], [0.0; 4], [1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0]].concat();
    let mut b = skinned(&[0, 1, 9, 9].repeat(4), &weights);
    // A second set, of shorts and normalised bytes.
    let more: Vec<u8> = [1u16, 0, 0, 0].repeat(4).iter().flat_map(|v| v.to_le_bytes()).collect();
    let more = b.accessor(&more, UNSIGNED_SHORT, "VEC4", 4);
    let bytes = b.accessor(&[[0u8; 12].to_vec(), vec![255, 0, 0, 0]].concat(), UNSIGNED_BYTE, "VEC4", 4);
    b.set(&format!("{ATTRIBUTES}/JOINTS_1"), json!(more)).set(&format!("{ATTRIBUTES}/WEIGHTS_1"), json!(bytes));
    let asset = b.load().unwrap();
    let vertices = &asset.meshes[0].primitives[0].vertices;
    assert_eq!((vertices.influences_per_vertex, vertices.joints.len()), (8, 32));
    // Joint 9 does not exist but weighs nothing.
    assert_eq!(vertices.joints[..4], [(0, 0.25), (1, 0.75), (0, 0.0), (0, 0.0)]);
    assert_eq!(vertices.joints[8], (0, 1.0), "without weights the first joint has it all");
    assert_eq!([vertices.joints[24], vertices.joints[25], vertices.joints[28]], [(0, 0.25), (1, 0.25), (1, 0.5)]);
    assert_eq!(asset.skins[0].inverse_bind, vec![Mat4::IDENTITY; 2]);
    assert_eq!(asset.skins[0].joints, [1, 2]);
    assert_eq!(asset.warnings.len(), 1, "{:?}", asset.warnings);
}

#[test]
fn bad_skins_are_named() {
    let error = skinned(&[0, 2, 0, 0].repeat(4), &[0.5, 0.5, 0.0, 0.0].repeat(4)).error();
    assert!(error.contains("JOINTS_0") && error.contains("joint 2") && error.contains("2 joints"), "{error}");
    let weights = [1.0, 0.0, 0.0, 0.0].repeat(4);
    let mut b = skinned(&[0; 16], &weights);
    assert!(b.set("/skins/0/joints", json!([1, 77])).error().contains("skins[0].joints[1]: index 77"));
    assert!(b.set("/skins/0/joints", json!([])).error().contains("skins[0].joints"));
    let mut b = skinned(&[0; 16], &weights);
    let matrix = b.floats(&Mat4::from_translation(Vec3::ONE).to_cols_array(), "MAT4");
    b.set("/skins/0/inverseBindMatrices", json!(matrix));
    assert!(b.error().contains("1 matrices for 2 joints"));
    b.set("/skins/0/joints", json!([1]));
    assert_eq!(b.load().unwrap().skins[0].inverse_bind, [Mat4::from_translation(Vec3::ONE)]);
}
