//! Pictures and sequences: names, shards, formats, standard output, names that are not UTF-8.

use crate::program::{SMALL, data_uri, png, quad, with_quad};
use serde_json::json;

fn render<'a>(more: &[&'a str]) -> Vec<&'a str> {
    ["render", "quad.gltf"].iter().chain(&SMALL).chain(more).copied().collect()
}

#[test]
fn sequences_are_numbered_and_sharded() {
    let folder = with_quad();
    folder.run(render(&["--frames", "8..12", "--out", "a{frame}b.png", "--shard", "1/2"])).success();
    assert_eq!(folder.names(), ["a0009b.png", "a0011b.png", "quad.gltf"]);
    let report = folder.run(render(&["--frames", "8..10", "--out", "c.exr", "--json"])).success().json();
    assert_eq!(folder.names(), ["a0009b.png", "a0011b.png", "c0008.exr", "c0009.exr", "quad.gltf"]);
    assert_eq!((&report["image"]["path"], &report["ms"]["frame_count"]), (&"c0009.exr".into(), &1.into()));
    folder.fails(1, render(&["--frames", "0..2", "--shard", "5/9"]), &["--shard"]);
}

#[test]
fn a_picture_goes_to_standard_output() {
    let folder = with_quad();
    let outcome = folder.run(render(&["--out", "-"])).success();
    assert_eq!(outcome.stderr, "");
    let picture = image::load_from_memory(&outcome.stdout).unwrap();
    assert_eq!((picture.width(), picture.height()), (16, 9));
    assert_eq!(folder.names(), ["quad.gltf"]);
}

#[test]
fn a_picture_is_as_readable_as_other_files() {
    let folder = with_quad();
    folder.run(render(&[])).success();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let mode = |name: &str| std::fs::metadata(folder.path().join(name)).unwrap().permissions().mode();
        assert_eq!(mode("vair.png"), mode("quad.gltf"));
    }
}

#[test]
fn warnings_go_to_standard_error_and_the_picture_is_made() {
    let folder = with_quad();
    let mut scene = quad();
    scene["extensionsUsed"] = json!(["EXT_moon"]);
    folder.write("quad.gltf", scene.to_string());
    let outcome = folder.run(render(&[])).success();
    assert!(outcome.stderr.starts_with("vair: warning: quad.gltf: ") && outcome.stderr.contains("EXT_moon"));
    let report = folder.run(render(&["--json"])).success().json();
    assert!(report["warnings"][0].as_str().unwrap().contains("EXT_moon"));
}

#[cfg(unix)]
#[test]
fn names_need_not_be_utf_8() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = with_quad();
    let (scene, look) = (OsStr::from_bytes(b"f\xffx.gltf"), OsStr::from_bytes(b"l\xffk.toml"));
    let out = OsStr::from_bytes(b"p\xff.png");
    folder.write(scene, quad().to_string());
    folder.write(look, "[material.Skin]\nbase_color_texture = \"a.png\"\n");
    folder.write("a.png", png(2, 2));
    let mut arguments: Vec<&OsStr> = SMALL.iter().map(OsStr::new).collect();
    arguments.extend([OsStr::new("--json"), OsStr::new("--look"), look, OsStr::new("--out"), out, scene]);
    arguments.insert(0, OsStr::new("render"));
    let report = folder.run(&arguments).success().json();
    assert!(report["image"]["path"].as_str().unwrap().ends_with(".png"));
    assert!(folder.path().join(out).is_file());
    arguments.extend([OsStr::new("--frames"), OsStr::new("0..1")]);
    folder.run(&arguments).success();
    assert!(folder.path().join(OsStr::from_bytes(b"p\xff0000.png")).is_file());
}

/// The quad with a coat that sways, on a node that moves a metre in a second.
fn swaying_quad() -> serde_json::Value {
    let numbers = [0.0f32, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0];
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    let mut scene = quad();
    let mut add = |list: &str, item: serde_json::Value| scene[list].as_array_mut().unwrap().push(item);
    add("buffers", json!({ "byteLength": bytes.len(), "uri": data_uri(&bytes) }));
    add("bufferViews", json!({ "buffer": 1, "byteOffset": 0, "byteLength": 8 }));
    add("bufferViews", json!({ "buffer": 1, "byteOffset": 8, "byteLength": 24 }));
    let times = json!({ "bufferView": 2, "componentType": 5126, "type": "SCALAR", "count": 2, "min": [0], "max": [1] });
    add("accessors", times);
    add("accessors", json!({ "bufferView": 3, "componentType": 5126, "type": "VEC3", "count": 2 }));
    let channel = json!({ "sampler": 0, "target": { "node": 0, "path": "translation" } });
    scene["animations"] = json!([{ "channels": [channel], "samplers": [{ "input": 2, "output": 3 }] }]);
    let keys = json!({ "kind": "fur", "length": 0.3, "inertia": 0.8, "stiffness": 50.0 });
    scene["materials"][0]["extras"] = json!({ "vair": keys });
    scene
}

#[test]
fn a_shard_of_a_sequence_that_sways_is_the_sequence() {
    let folder = with_quad();
    folder.write("quad.gltf", swaying_quad().to_string());
    let sequence = |more: &[&str]| {
        folder.run(render(&["--fps", "24"]).into_iter().chain(more.iter().copied())).success();
    };
    sequence(&["--frames", "0..8", "--out", "whole.png"]);
    sequence(&["--frames", "0..8", "--out", "part.png", "--shard", "3/4"]);
    sequence(&["--frames", "7..8", "--out", "alone.png"]);
    let picture = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert!(picture("part0003.png") == picture("whole0003.png"));
    assert!(picture("part0007.png") == picture("whole0007.png"));
    assert!(picture("alone0007.png") != picture("whole0007.png"), "a sequence starts from rest");
}
