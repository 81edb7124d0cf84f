//! Imports point one way: a room sees only the rooms before it, and unsafe code stays in `gpu`.

use std::path::Path;

/// Every room, and the rooms that it may see.
const ROOMS: [(&str, &[&str]); 13] = [
    ("math", &[]),
    ("shader", &["math"]),
    ("asset", &["math"]),
    ("gpu", &["math", "shader"]),
    ("material", &["math", "shader", "asset"]),
    ("scene", &["math", "shader", "asset", "material"]),
    ("render", &["math", "shader", "asset", "gpu", "material", "scene"]),
    // What judges the renderer. The oracle knows scenes and formulas, and neither device nor renderer.
    ("oracle", &["math", "asset", "material", "scene"]),
    ("verify", &["math", "shader", "gpu", "material"]),
    ("profile", &["math", "gpu", "material", "scene", "render"]),
    ("report", &["math", "asset", "gpu", "material", "scene", "render", "oracle", "verify", "profile"]),
    // The one error for users who want one: made from every room's, seen by none.
    ("error", &["asset", "gpu", "material", "scene", "render", "oracle", "verify", "profile", "report"]),
    (
        "cli",
        &[
            "error", "math", "shader", "asset", "gpu", "material", "scene", "render", "oracle", "verify", "profile",
            "report",
        ],
    ),
];

/// The crate's two roots belong to no room.
const ROOTS: [&str; 2] = ["lib.rs", "main.rs"];

#[test]
fn every_file_keeps_to_its_room() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&source, &mut files);
    assert!(files.len() > ROOMS.len(), "only {} files under {}", files.len(), source.display());
    let mut violations = Vec::new();
    for path in files {
        let name = path.strip_prefix(&source).unwrap().to_string_lossy().replace('\\', "/");
        violations.extend(check(&name, &std::fs::read_to_string(&path).unwrap()));
    }
    assert!(violations.is_empty(), "{}", violations.join("\n"));
}

#[test]
fn planted_faults_are_found() {
    let faulty = |path: &str, text: &str| assert_eq!(check(path, text).len(), 1, "{path}: {text}");
    faulty("scene/camera.rs", "use crate::gpu::Device;");
    faulty("material/mod.rs", "fn f(d: &crate::gpu::Device) {}");
    faulty("asset/mesh.rs", "use crate::{math::Vec3, shader::{table, layout}};");
    faulty("math/mod.rs", "use super::render;");
    faulty("asset/gltf.rs", "use super::super::material;");
    faulty("gpu/image.rs", "use crate::asset::Image;");
    faulty("shader/mod.rs", "use vair::gpu;");
    faulty("profile/mod.rs", "let x = unsafe { y };");
    faulty("basement/mod.rs", "");
    let sound = |path: &str, text: &str| assert_eq!(check(path, text), [""; 0], "{path}: {text}");
    sound("scene/camera.rs", "use crate::{asset::model, math, scene::light};\n// crate::gpu is not seen");
    sound("gpu/image.rs", "use crate::shader::table; unsafe { x() }");
    sound("asset/gltf.rs", "use super::{document, material};");
    sound("render/mod.rs", "use crate::gpu;");
    sound("math/mod.rs", "#![deny(unsafe_code)] use super::sampling;");
    sound("main.rs", "use vair::render; use crate::cli;");
}

/// What is wrong with a file at `path` under `src`, one line each.
fn check(path: &str, text: &str) -> Vec<String> {
    if ROOTS.contains(&path) {
        return Vec::new();
    }
    let own = path.split('/').next().unwrap_or(path).trim_end_matches(".rs");
    let Some((_, seen)) = ROOMS.iter().find(|(room, _)| *room == own) else {
        return vec![format!("{path}: `{own}` is not a room: give it a place in tests/imports.rs")];
    };
    let code: String = text.lines().flat_map(|line| [line.split("//").next().unwrap_or(""), "\n"]).collect();
    let mut violations = Vec::new();
    // As many steps up as the file is deep lead to the crate's root.
    let depth = path.trim_end_matches("/mod.rs").split('/').count();
    for prefix in ["crate::", "vair::", &"super::".repeat(depth)] {
        for (at, _) in code.match_indices(prefix) {
            for name in first_names(&code[at + prefix.len()..]) {
                if name != own && !seen.contains(&name) && ROOMS.iter().any(|(room, _)| *room == name) {
                    violations.push(format!("src/{path}: {own} must not see {name}"));
                }
            }
        }
    }
    let is_word = |letter: char| letter.is_alphanumeric() || letter == '_';
    if own != "gpu" && code.split(|letter| !is_word(letter)).any(|word| word == "unsafe") {
        violations.push(format!("src/{path}: unsafe code belongs under src/gpu"));
    }
    violations
}

/// First segments of the path, or of each path in a brace group, that `text` starts with.
fn first_names(text: &str) -> Vec<&str> {
    let name =
        |text: &'_ str| text.find(|letter: char| !letter.is_alphanumeric() && letter != '_').unwrap_or(text.len());
    let Some(group) = text.strip_prefix('{') else {
        return vec![&text[..name(text)]];
    };
    let (mut names, mut depth, mut start) = (Vec::new(), 0, 0);
    for (at, letter) in group.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                let path = group[start..at].trim();
                names.push(&path[..name(path)]);
                start = at + 1;
                if letter == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    names
}

fn collect(folder: &Path, files: &mut Vec<std::path::PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}
