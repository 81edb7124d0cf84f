//! Looks that cannot be used: the line, the key, the nearest name.

use crate::program::{Folder, SMALL, png, quad, with_quad};
use serde_json::json;

#[test]
fn a_wrong_look_names_its_line() {
    let folder = with_quad();
    for (text, named) in [
        ("[material.Skin]\npreset = \"foks\"\n", &["look.toml:2", "did you mean `fox`?"][..]),
        ("[material.Skim]\n", &["look.toml:1", "did you mean `Skin`?"]),
        ("[material.Skin]\nkind = \"fur\"\nlenght = 1\n", &["look.toml:3", "did you mean `length`?"]),
        ("[material.Skin]\nkind = \"fur\"\n\nlayers = \"many\"\n", &["look.toml:4", "layers", "whole number"]),
        ("[material.Skin]\nkind = \"fur\"\nlayers = 1e30\n", &["look.toml:3", "1 to 256"]),
        ("[material.Skin]\nroughness = nan\n", &["look.toml:2", "roughness"]),
        ("[material.Skin]\nkind = \"fur\"\nheight_map = \"no.png\"\n", &["look.toml:3", "height_map", "no.png"]),
        ("[material.Skin]\nnormal_texture = \"../a.png\"\n", &["look.toml:2", "../a.png", "outside"]),
        ("[material.Skin\n", &["look.toml:1"]),
    ] {
        folder.write("look.toml", text);
        folder.fails(1, ["render", "quad.gltf", "--look", "look.toml"], named);
    }
    folder.write("look.toml", b"[material.Skin]\n# \xff\n");
    folder.fails(1, ["render", "quad.gltf", "--look", "look.toml"], &["look.toml", "UTF-8"]);
    folder.fails(1, ["render", "quad.gltf", "--look", "missing.toml"], &["missing.toml", "cannot be read"]);
    folder.fails(1, ["render", "quad.gltf", "--look", "."], &["a folder, not a file"]);
}

#[test]
fn a_file_may_carry_its_own_look_with_images_of_its_folder() {
    let folder = Folder::new();
    let mut scene = quad();
    scene["materials"][0]["extras"] = json!({ "vair": { "preset": "fox", "height_map": "maps/height.png" } });
    std::fs::create_dir(folder.path().join("model")).unwrap();
    std::fs::create_dir(folder.path().join("model/maps")).unwrap();
    folder.write("model/quad.gltf", scene.to_string());
    folder.fails(1, ["inspect", "model/quad.gltf"], &["model/quad.gltf", "Skin", "height_map", "maps/height.png"]);

    folder.write("model/maps/height.png", png(4, 4));
    let report = folder.run(["inspect", "model/quad.gltf", "--json"]).success().json();
    let names: Vec<_> = report["textures"].as_array().unwrap().iter().map(|texture| &texture["name"]).collect();
    assert_eq!(names, ["maps/height.png"]);
    assert!(report["passes"].as_array().unwrap().iter().any(|pass| pass["name"] == "fur"));

    scene["materials"][0]["extras"] = json!({ "vair": { "lenght": 1 } });
    folder.write("model/quad.gltf", scene.to_string());
    folder.fails(1, ["inspect", "model/quad.gltf"], &["model/quad.gltf", "Skin", "lenght"]);
}

#[test]
fn quality_is_a_bundle_that_explicit_options_win_over() {
    let folder = with_quad();
    let layers = |options: &[&str]| {
        let mut arguments = vec!["render", "quad.gltf", "--preset", "fox", "--json"];
        arguments.extend(SMALL);
        arguments.extend(options);
        folder.run(arguments).success().json()["fur"][0]["layers"].as_u64().unwrap()
    };
    let normal = layers(&[]);
    assert_eq!(layers(&["--quality", "draft"]), normal.div_ceil(2));
    assert_eq!(layers(&["--quality", "reference"]), normal * 3);
    assert_eq!(layers(&["--quality", "reference", "--layers", "5"]), 5);
    assert_eq!(layers(&["--quality", "reference", "--layers", "auto"]), normal);
}
