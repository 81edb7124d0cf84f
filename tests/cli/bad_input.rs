//! Scenes and outputs that cannot be used: status 1, one line that names file and field, nothing written.

use crate::program::{Folder, bent, data_uri, png, quad_glb, with_quad};
use serde_json::json;
use std::time::{Duration, Instant};

#[test]
fn files_that_are_no_scene() {
    let folder = Folder::new();
    let glb = quad_glb();
    folder.write("empty.glb", b"");
    folder.write("truncated.glb", &glb[..glb.len() / 2]);
    folder.write("zeros.glb", vec![0; 4096]);
    folder.write("text.gltf", "{ \"asset\": ");
    folder.write("deep.gltf", "[".repeat(100_000));
    folder.write("version.gltf", "{ \"asset\": { \"version\": \"1.0\" } }");
    std::fs::create_dir(folder.path().join("folder.glb")).unwrap();
    for (file, named) in [
        ("missing.glb", "cannot be read"),
        ("empty.glb", "empty.glb"),
        ("truncated.glb", "truncated.glb"),
        ("zeros.glb", "zeros.glb"),
        ("text.gltf", "JSON"),
        ("deep.gltf", "JSON"),
        ("version.gltf", "asset.version"),
        ("folder.glb", "folder"),
    ] {
        folder.fails(1, ["render", file], &[file, named]);
        folder.fails(1, ["inspect", file, "--json"], &[file, named]);
    }
}

#[test]
fn scenes_that_break_the_format_are_refused_by_field() {
    let folder = Folder::new();
    let nan: Vec<u8> = f32::NAN.to_le_bytes().repeat(15);
    let fields = [
        ("/meshes/0/primitives/0/attributes/POSITION", json!(7), "POSITION"),
        ("/meshes/0/primitives/0/indices", json!(1_000_000_000_000_000_000u64), "indices"),
        ("/meshes/0/primitives/0/material", json!(9), "material"),
        ("/buffers/0/uri", json!(data_uri(&nan)), "POSITION"),
        ("/buffers/0/uri", json!("../secret.bin"), "buffers[0].uri"),
        ("/buffers/0/uri", json!("http://example.org/a.bin"), "buffers[0].uri"),
        ("/buffers/0/byteLength", json!(1e30), "JSON"),
        ("/accessors/0/count", json!(4_000_000_000u32), "accessors[0]"),
        ("/accessors/0/count", json!(-1), "JSON"),
        ("/accessors/0/type", json!(5), "JSON"),
        ("/bufferViews/0/byteOffset", json!(u64::MAX), "bufferViews[0]"),
        ("/nodes/0/children", json!([0]), "nodes[0]"),
        ("/nodes/0/scale", json!([1e39, 1.0, 1.0]), "nodes[0].scale"),
        ("/extensionsRequired", json!(["EXT_moon"]), "EXT_moon"),
        ("/images", json!([{ "uri": "../out.png" }]), "images[0]"),
    ];
    for (pointer, value, field) in fields {
        bent(&folder, pointer, value);
        if pointer == "/images" {
            textured(&folder, json!({ "uri": "../out.png" }));
        }
        folder.fails(1, ["render", "quad.gltf"], &["quad.gltf", field]);
    }
}

/// The quad with one image, used as base colour.
fn textured(folder: &Folder, image: serde_json::Value) {
    let mut json = crate::program::quad();
    json["images"] = json!([image]);
    json["textures"] = json!([{ "source": 0 }]);
    json["materials"][0]["pbrMetallicRoughness"] = json!({ "baseColorTexture": { "index": 0 } });
    folder.write("quad.gltf", json.to_string());
}

#[test]
fn pictures_that_cannot_be_used() {
    let folder = Folder::new();
    let good = png(64, 64);
    folder.write("cut.png", &good[..good.len() / 2]);
    let mut bomb = good.clone();
    bomb[16..24].copy_from_slice(&[0, 0, 0xff, 0xff, 0, 0, 0xff, 0xff]);
    folder.write("bomb.png", bomb);
    folder.write("text.png", b"no picture");
    for name in ["cut.png", "bomb.png", "text.png", "missing.png"] {
        textured(&folder, json!({ "uri": name }));
        folder.fails(1, ["render", "quad.gltf"], &["quad.gltf", "images[0]", name]);
    }
}

#[cfg(unix)]
#[test]
fn a_link_that_leads_outside_is_refused() {
    let (folder, outside) = (Folder::new(), Folder::new());
    let target = outside.write("a.png", png(1, 1));
    std::os::unix::fs::symlink(target, folder.path().join("a.png")).unwrap();
    textured(&folder, json!({ "uri": "a.png" }));
    folder.fails(1, ["inspect", "quad.gltf"], &["quad.gltf", "images[0]", "outside"]);
    folder.run(["inspect", "quad.gltf", "--allow-outside"]).success();
}

#[test]
fn what_the_scene_lacks_is_named_with_what_it_has() {
    let folder = with_quad();
    for (option, value, named) in [
        ("--animation", "run", "no animation \"run\""),
        ("--camera", "front", "no camera \"front\""),
        ("--camera", "7", "no camera \"7\""),
        ("--variant", "red", "no variant \"red\""),
        ("--scene", "4", "choose one of 0"),
        ("--preset", "foks", "did you mean `fox`?"),
        ("--preset", "fox=Skim", "did you mean `Skin`?"),
        ("--memory-limit", "500", "over the limit of 500"),
    ] {
        folder.fails(1, ["render", "quad.gltf", option, value], &[named]);
    }
    folder.fails(1, ["render", "quad.gltf", "--animation", "run"], &["quad.gltf"]);
}

#[test]
fn outputs_that_cannot_be_written_fail_before_rendering() {
    let folder = with_quad();
    std::fs::create_dir(folder.path().join("folder.png")).unwrap();
    let out = |name: &'static str| ["render", "quad.gltf", "--size", "4000x4000", "--out", name];
    let start = Instant::now();
    folder.fails(1, out("folder.png"), &["folder.png", "is a folder"]);
    folder.fails(1, out("nowhere/a.png"), &["nowhere/a.png", "no folder nowhere"]);
    folder.fails(1, out("quad.gltf/a.png"), &["quad.gltf/a.png"]);
    assert!(start.elapsed() < Duration::from_secs(10), "{:?}", start.elapsed());
}

#[test]
fn sizes_beyond_the_device_are_refused_at_once() {
    let folder = with_quad();
    let start = Instant::now();
    folder.fails(1, ["render", "quad.gltf", "--size", "100000x100000"], &["100000x100000", "on this device"]);
    folder.fails(1, ["render", "quad.gltf", "--size", "4294967295x4294967295"], &["on this device"]);
    folder.fails(1, ["render", "quad.gltf", "--device", "no such device"], &["no such device", "found"]);
    assert!(start.elapsed() < Duration::from_secs(30), "{:?}", start.elapsed());
}
