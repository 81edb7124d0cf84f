//! Damaged files: an error or a whole asset, never a panic.

use crate::builder::*;
use proptest::prelude::*;
use serde_json::{Value, json};
use vair::asset::{Asset, AssetError, Topology};

/// A file that uses most of the reader.
fn rich() -> Vec<u8> {
    let mut b = skinned(&[0, 1, 0, 0].repeat(4), &[0.5, 0.5, 0.0, 0.0].repeat(4));
    let uvs = b.floats(&[0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0], "VEC2");
    b.set(&format!("{ATTRIBUTES}/TEXCOORD_0"), json!(uvs));
    let image = b.view(&png([128, 128, 255, 255]));
    b.set("/images", json!([{ "bufferView": image }])).set("/textures", json!([{ "source": 0 }]));
    let extensions = crate::material_extension::everything();
    b.set("/materials", json!([{ "normalTexture": { "index": 0 }, "extensions": extensions }]));
    b.set("/meshes/0/primitives/0/material", json!(0));
    let (at, by) = (b.view(&[0, 0, 2, 0]), b.view(bytemuck::cast_slice(&[1.0f32; 6])));
    let target = b.push(
        "accessors",
        json!({ "componentType": FLOAT, "type": "VEC3", "count": 4, "sparse": { "count": 2,
            "indices": { "bufferView": at, "componentType": UNSIGNED_SHORT }, "values": { "bufferView": by } } }),
    );
    b.set("/meshes/0/primitives/0/targets", json!([{ "POSITION": target }]));
    let times = b.floats(&[0.0, 1.0], "SCALAR");
    b.set(
        "/animations",
        json!([{ "samplers": [{ "input": times, "output": times }],
        "channels": [{ "sampler": 0, "target": { "node": 0, "path": "weights" } }] }]),
    );
    let glb = b.glb();
    let asset = load_bytes(&glb).unwrap();
    // The extension that is shown as something simpler.
    assert_eq!(asset.warnings.len(), 1, "{:?}", asset.warnings);
    assert_eq!((asset.images[0].width, asset.animations[0].channels.len()), (1, 1));
    glb
}

/// What later rooms rely on: every index inside its list, every list as long as it says.
pub(crate) fn assert_promises(asset: &Asset) {
    assert!(asset.default_scene < asset.scenes.len());
    assert!(asset.scenes.iter().flat_map(|scene| &scene.roots).all(|root| *root < asset.nodes.len()));
    for node in &asset.nodes {
        assert!(node.children.iter().all(|child| *child < asset.nodes.len()));
        assert!(node.mesh.is_none_or(|mesh| mesh < asset.meshes.len()));
        assert!(node.skin.is_none_or(|skin| skin < asset.skins.len()));
        let meshes = node.mesh.map(|mesh| &asset.meshes[mesh]);
        for primitive in meshes.iter().flat_map(|mesh| &mesh.primitives) {
            let joints = node.skin.map_or(usize::MAX, |skin| asset.skins[skin].joints.len());
            assert!(primitive.vertices.joints.iter().all(|(joint, _)| usize::from(*joint) < joints));
        }
    }
    for mesh in &asset.meshes {
        for primitive in &mesh.primitives {
            let vertices = &primitive.vertices;
            let count = vertices.positions.len();
            let per = match primitive.topology {
                Topology::Points => 1,
                Topology::Lines => 2,
                Topology::Triangles => 3,
            };
            assert!(!primitive.indices.is_empty() && primitive.indices.len() % per == 0);
            assert!(primitive.indices.iter().all(|index| (*index as usize) < count));
            assert!(primitive.material < asset.materials.len());
            assert!(
                primitive
                    .variant_materials
                    .iter()
                    .all(|(v, m)| *v < asset.variants.len() && *m < asset.materials.len())
            );
            let full = |len: usize| len == 0 || len == count;
            assert!(full(vertices.normals.len()) && full(vertices.tangents.len()) && full(vertices.colors.len()));
            assert!(per < 3 || vertices.normals.len() == count);
            assert!(vertices.uv_sets.iter().all(|set| full(set.len())));
            assert_eq!(vertices.joints.len(), count * vertices.influences_per_vertex);
            assert!(vertices.normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1e-5));
            assert!(vertices.tangents.iter().all(|tangent| (tangent.truncate().length() - 1.0).abs() < 1e-5));
            assert_eq!(primitive.morph_targets.len(), mesh.weights.len());
            for target in &primitive.morph_targets {
                assert!(full(target.positions.len()) && full(target.normals.len()) && full(target.tangents.len()));
            }
        }
    }
    assert!(asset.textures.iter().all(|texture| texture.image < asset.images.len()));
    assert!(
        asset
            .images
            .iter()
            .all(|image| image.rgba.len() as u64 == u64::from(image.width) * u64::from(image.height) * 4)
    );
    for channel in asset.animations.iter().flat_map(|clip| &clip.channels) {
        assert!(channel.node < asset.nodes.len() && !channel.times_s.is_empty());
        assert!(channel.times_s.windows(2).all(|pair| pair[0] < pair[1]));
    }
}

fn must_not_panic(bytes: &[u8]) {
    match load_limited(bytes, 16 << 20) {
        Ok(asset) => assert_promises(&asset),
        Err(error) => assert!(!error.to_string().contains('\n'), "{error}"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn damaged_files_never_panic(
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in prop::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        static GOOD: std::sync::LazyLock<Vec<u8>> = std::sync::LazyLock::new(rich);
        let mut bytes = GOOD.clone();
        for (at, value) in flips {
            let at = at.index(bytes.len());
            // Digits for digits find more than noise, which mostly breaks the JSON.
            bytes[at] = if bytes[at].is_ascii_digit() { b'0' + value % 10 } else { value };
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        must_not_panic(&bytes);
    }
}

/// Every number of the JSON replaced by each of these, one at a time.
#[test]
fn hostile_numbers_never_panic() {
    fn numbers(value: &Value, pointer: String, found: &mut Vec<String>) {
        match value {
            Value::Number(_) => found.push(pointer),
            Value::Array(list) => {
                list.iter().enumerate().for_each(|(i, v)| numbers(v, format!("{pointer}/{i}"), found))
            }
            Value::Object(map) => map.iter().for_each(|(k, v)| numbers(v, format!("{pointer}/{k}"), found)),
            _ => {}
        }
    }
    let glb = rich();
    let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    let json: Value = serde_json::from_slice(&glb[20..20 + length]).unwrap();
    let mut pointers = Vec::new();
    numbers(&json, String::new(), &mut pointers);
    assert!(pointers.len() > 60, "{}", pointers.len());
    for pointer in &pointers {
        for bad in
            [json!(0), json!(1), json!(-1), json!(65_535), json!(u32::MAX), json!(u64::MAX), json!(1e39), json!(0.5)]
        {
            let mut b = Builder { json: json.clone(), binary: glb[28 + length..].to_vec() };
            b.set(pointer, bad);
            must_not_panic(&b.glb());
        }
    }
}

/// Thousands of triangles in one point are the worst case of welding; they must not take minutes.
#[test]
fn collapsed_triangles_get_tangents_in_time() {
    let corners = 150_000;
    let mut b = Builder::new();
    let positions = b.floats(&vec![1.0; corners * 3], "VEC3");
    let uvs = b.floats(&vec![0.5; corners * 2], "VEC2");
    let image = b.view(&png([128, 128, 255, 255]));
    b.set("/images", json!([{ "bufferView": image }])).set("/textures", json!([{ "source": 0 }]));
    b.set("/materials", json!([{ "normalTexture": { "index": 0 } }]));
    b.mesh(json!({ "attributes": { "POSITION": positions, "TEXCOORD_0": uvs }, "material": 0 }));
    let start = std::time::Instant::now();
    assert_promises(&b.load().unwrap());
    assert!(start.elapsed().as_secs() < 20, "{:?}", start.elapsed());
}

fn over_memory(result: Result<Asset, AssetError>, field: &str) {
    let error = result.expect_err("must be refused");
    assert!(matches!(error, AssetError::Memory { .. }), "{error}");
    assert!(error.to_string().contains(field), "{error}");
}

/// A million vertices that take no bytes, times targets of two bytes each.
#[test]
fn empty_morph_targets_count_as_what_they_become() {
    let mut b = Builder::new();
    let vertices = json!({ "componentType": FLOAT, "type": "VEC3", "count": 1_000_000 });
    let vertices = b.push("accessors", vertices);
    let indices = b.shorts(&[0, 1, 2]);
    let targets = vec![json!({}); 1000];
    let attributes = json!({ "POSITION": vertices, "NORMAL": vertices });
    b.mesh(json!({ "attributes": attributes, "indices": indices, "targets": targets }));
    over_memory(b.load(), "meshes[0].primitives[0].targets");
    b.set("/meshes/0/primitives/0/targets", json!([{}]));
    assert_eq!(b.load().unwrap().meshes[0].primitives[0].morph_targets.len(), 1);
}

#[test]
fn short_json_counts_as_what_it_becomes() {
    let mut b = quad();
    b.set("/materials", json!(vec![json!({}); 100_000]));
    over_memory(load_limited(&b.glb(), 64 << 20), "JSON");
    let mut b = skinned(&[0; 16], &[1.0, 0.0, 0.0, 0.0].repeat(4));
    b.set("/skins/0/joints", json!(vec![1; 600_000]));
    over_memory(load_limited(&b.glb(), 64 << 20), "JSON");
}

#[test]
fn long_names_and_many_warnings_are_cut() {
    let mut b = quad();
    let name = "é".repeat(500_000);
    b.set("/nodes/0/children", json!([1])).push("nodes", json!({ "name": name }));
    b.set("/scenes", json!([{ "nodes": vec![1; 20_000] }])).set("/meshes/0/name", json!("m".repeat(100_000)));
    let asset = b.load().unwrap();
    assert_eq!(asset.nodes[1].name.as_deref(), Some("é".repeat(128).as_str()));
    assert_eq!(asset.meshes[0].name.as_ref().map(String::len), Some(256));
    assert!(asset.warnings.iter().any(|line| line.starts_with("nodes: 1 names are longer")), "{}", asset.warnings[0]);
    assert!(asset.warnings.len() <= 201 && asset.warnings.iter().all(|line| line.len() <= 503));
    let last = asset.warnings.last().unwrap();
    assert!(last.starts_with("and 198") && last.ends_with(" more"), "{last}");
}
