//! What the `gltf` crate's types refuse or lose without need: it loads, and messages say what the file says.

use crate::builder::*;
use serde_json::json;

#[test]
fn what_nobody_reads_may_be_anything() {
    let mut b = quad();
    b.set("/asset/generator", json!(5)).set("/scenes", json!([{}])).set("/nodes/0/extras", json!([[null]]));
    b.set("/accessors/0/min", json!("low")).set("/accessors/0/name", json!({})).set("/meshes/0/name", json!(null));
    b.set("/bufferViews/0/target", json!("array")).set("/nodes/0/extensions", json!([]));
    b.set("/animations", json!([{}]));
    let asset = b.load().unwrap();
    assert!(asset.warnings.is_empty(), "{:?}", asset.warnings);
    assert_eq!((asset.scenes.len(), asset.scenes[0].roots.len(), asset.meshes.len()), (1, 0, 1));
}

#[test]
fn a_channel_without_node_is_ignored() {
    let mut b = quad();
    let times = b.floats(&[0.0], "SCALAR");
    let target = json!({ "path": "weights" });
    let channels = json!([{ "sampler": 0, "target": target }]);
    b.set("/animations", json!([{ "samplers": [{ "input": times, "output": times }], "channels": channels }]));
    let asset = b.load().unwrap();
    assert!(asset.warnings[0].contains("targets no node"), "{:?}", asset.warnings);
}

#[test]
fn messages_keep_unknown_values_and_names() {
    for (pointer, value, words) in [
        ("/meshes/0/primitives/0/mode", json!(4_294_967_300u64), "mode: 4294967300 does not exist"),
        ("/accessors/0/componentType", json!(5124), "componentType 5124 does not exist"),
        ("/accessors/0/type", json!("VEC9"), "type is VEC9, must be VEC3"),
        ("/nodes/0/mesh", json!(4_294_967_296u64), "nodes[0].mesh: index 4294967295 or more is out of range"),
        ("/nodes/0/mesh", json!("x"), "nodes[0].mesh: invalid type: string \"x\""),
        ("/buffers", json!([{}]), "missing field `byteLength`"),
    ] {
        let text = quad().set(pointer, value).error();
        assert!(text.contains(words), "{text}\nlacks {words}");
    }
    let mut b = quad();
    b.set(&format!("{ATTRIBUTES}/FOO"), json!(0)).set("/meshes/0/primitives/0/targets", json!([{ "COLOR_0": 0 }]));
    let warnings = b.load().unwrap().warnings;
    assert!(warnings.contains(&"meshes[0].primitives[0].attributes.FOO: is not read".to_owned()), "{warnings:?}");
    assert!(warnings.iter().any(|line| line.contains("morph targets move `COLOR_0`")), "{warnings:?}");
}
