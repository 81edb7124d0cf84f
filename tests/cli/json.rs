//! `--json` is one object with the fields of the contract, and nothing else on standard output.

use crate::program::{Folder, SMALL, with_quad};
use serde_json::Value;

#[track_caller]
fn has(value: &Value, pointers: &[&str]) {
    for pointer in pointers {
        assert!(value.pointer(pointer).is_some_and(|found| !found.is_null()), "{pointer} is not in {value:#}");
    }
}

#[test]
fn render() {
    let folder = with_quad();
    let mut arguments = vec!["render", "quad.gltf", "--preset", "fox", "--json", "--bench", "3", "--validate"];
    arguments.extend(SMALL);
    let outcome = folder.run(arguments).success();
    assert_eq!(outcome.stderr, "");
    let report = outcome.json();
    has(&report, &["/device/name", "/device/driver", "/device/api", "/memory/device_bytes", "/left_out/0/what"]);
    has(&report, &["/passes/0/name", "/passes/0/draws", "/passes/0/instances", "/passes/0/triangles"]);
    has(&report, &["/fur/0/material", "/fur/0/layers", "/fur/0/instances", "/fur/0/vertices_stored"]);
    has(&report, &["/left_out/0/why", "/ms/load", "/ms/pipelines", "/ms/first_frame"]);
    assert_eq!((&report["image"]["path"], &report["image"]["width"]), (&"vair.png".into(), &16.into()));
    assert_eq!(report["validation_messages"], Value::Array(Vec::new()));
    assert!(report["warnings"].is_array());
    let ms = |name: &str| report["ms"][name].as_f64().unwrap();
    assert!(0.0 < ms("frame_min") && ms("frame_min") <= ms("frame_median") && ms("frame_median") <= ms("frame_max"));
    assert_eq!(report["ms"]["frame_count"], 3);
    for pass in report["passes"].as_array().unwrap() {
        has(pass, &["/name", "/draws"]);
        let [median, min, max] = ["gpu_ms", "gpu_ms_min", "gpu_ms_max"].map(|name| pass[name].as_f64().unwrap());
        assert!(0.0 <= min && min <= median && median <= max, "{pass}");
        assert_eq!(pass["gpu_ms_count"], 3);
        assert!(pass["fragments"].as_u64().unwrap() > 0, "{pass}");
    }
    let picture = image::open(folder.path().join("vair.png")).unwrap();
    assert_eq!((picture.width(), picture.height()), (16, 9));
    assert_eq!(folder.names(), ["quad.gltf", "vair.png"]);
}

#[test]
fn inspect() {
    let folder = with_quad();
    let report = folder.run(["inspect", "quad.gltf", "--preset", "leopard", "--json"]).success().json();
    has(&report, &["/passes/0/name", "/pipelines/0/name", "/pipelines/0/state", "/memory/target_bytes"]);
    has(&report, &["/textures/0/name", "/textures/0/format", "/textures/0/bytes", "/left_out/0/what", "/lint"]);
    has(&report, &["/attachments/0/name", "/memory/by_owner/depth", "/pipelines/0/state/bindings", "/left_out/0/why"]);
    let names: Vec<_> = report["pipelines"].as_array().unwrap().iter().map(|pipeline| &pipeline["name"]).collect();
    assert!(
        names.iter().any(|name| name.as_str().is_some_and(|name| name.starts_with("tone_mapping.frag"))),
        "{names:?}"
    );
    // 1280 x 720: 8 bytes of colour and 4 of depth at 4 samples, 8 resolved, 4 of picture.
    assert_eq!(report["memory"]["target_bytes"], 1280 * 720 * (4 * 12 + 8 + 4));
    assert!(folder.run(["inspect", "quad.gltf"]).success().text().starts_with("passes\n"));
}

#[test]
fn schema() {
    let schema = Folder::new().run(["inspect", "--schema"]).success().json();
    let keys = &schema["$defs"]["material"]["properties"];
    has(keys, &["/length", "/roughness", "/preset", "/kind", "/surface/properties/roughness", "/distribution_map"]);
}

#[test]
fn devices_and_presets() {
    let folder = Folder::new();
    let devices = folder.run(["devices", "--json"]).success().json();
    has(
        &devices,
        &["/devices/0/name", "/devices/0/driver", "/devices/0/api", "/devices/0/usable", "/devices/0/missing"],
    );
    let presets = folder.run(["presets", "--json"]).success().json();
    has(
        &presets,
        &["/presets/0/name", "/presets/0/parameters", "/parameters/fur/0/name", "/parameters/standard/0/help"],
    );
    for arguments in [&["devices"][..], &["presets"], &["presets", "--parameters"]] {
        assert!(!folder.run(arguments).success().text().is_empty());
    }
}

#[test]
fn verify() {
    let folder = Folder::new();
    let report = folder.run(["verify", "--only", "schlick_weight", "--json", "--validate"]).success().json();
    has(
        &report,
        &["/device", "/seconds", "/pass", "/functions/0/name", "/functions/0/max_rel", "/functions/0/p999_rel"],
    );
    has(&report, &["/functions/0/limit", "/functions/0/limit_abs", "/functions/0/worst/inputs/v_dot_h/0"]);
    assert_eq!((&report["pass"], &report["functions"][0]["nonfinite"]), (&true.into(), &0.into()));
    assert!(report["functions"][0]["samples"].as_u64().unwrap() > 1 << 18);
    assert!(
        folder.run(["verify", "--only", "schlick"]).success().text().contains("1 of 1 functions meet their limits")
    );
    assert!(folder.run(["verify", "--list"]).success().text().lines().any(|line| line == "fibre_scattering"));
    folder.fails(1, ["verify", "--only", "schlik"], &["schlik", "schlick", "--list"]);
}
