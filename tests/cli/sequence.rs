//! Pictures and sequences: names, shards, formats, standard output, names that are not UTF-8.

use crate::program::{SMALL, png, quad, with_quad};
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
    assert_eq!((&report["image"]["path"], &report["ms"]["frame_count"]), (&"c0009.exr".into(), &2.into()));
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
