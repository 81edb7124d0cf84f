//! Imports point one way: a room sees only the rooms before it, nothing that draws sees what judges, and unsafe code stays in
//! `gpu`.

use std::path::Path;

/// Every room, and the rooms that it may see. Who sees [`MEASURE`] sees every room in it.
const ROOMS: [(&str, &[&str]); 16] = [
    ("math", &[]),
    ("shader", &["math"]),
    ("asset", &["math"]),
    ("gpu", &["math", "shader"]),
    ("material", &["math", "shader", "asset"]),
    ("scene", &["math", "shader", "asset", "material"]),
    ("render", &["math", "shader", "asset", "gpu", "material", "scene"]),
    // What judges the renderer. Formulas know neither device nor renderer, and the oracle nothing more than scenes.
    ("measure/twin", &["math", "material"]),
    ("measure/oracle", &["math", "asset", "material", "scene", "measure/twin"]),
    ("measure/furnace", &["math", "material", "measure/twin"]),
    ("measure/verify", &["math", "shader", "gpu", "material", "measure/twin", "measure/furnace"]),
    ("measure/count", &["shader", "gpu", "material", "scene", "render"]),
    ("measure/profile", &["math", "gpu", "material", "scene", "render", "measure/count"]),
    ("measure/report", &["math", "asset", "gpu", "material", "scene", "render", MEASURE]),
    // The one error for users who want one: made from every room's, seen by none.
    ("error", &["asset", "gpu", "material", "scene", "render", MEASURE]),
    ("cli", &["error", "math", "shader", "asset", "gpu", "material", "scene", "render", MEASURE]),
];

/// The room that is made of rooms.
const MEASURE: &str = "measure";

/// The roots of the crate and of [`MEASURE`] belong to no room.
const ROOTS: [&str; 3] = ["lib.rs", "main.rs", "measure/mod.rs"];

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
    faulty("measure/profile/mod.rs", "let x = unsafe { y };");
    faulty("render/frame.rs", "use crate::measure;");
    faulty("render/frame.rs", "use crate::{measure::{twin::ggx}, math};");
    faulty("material/kind.rs", "use crate::measure::twin::color;");
    faulty("measure/twin/ggx.rs", "use crate::gpu::Device;");
    faulty("measure/twin/ggx.rs", "use crate::measure::verify::Report;");
    faulty("measure/oracle/stage.rs", "use crate::render::FrameSetup;");
    faulty("measure/oracle/mod.rs", "use super::report;");
    faulty("measure/oracle/stage.rs", "use super::super::{twin::fibre, verify::run};");
    faulty("measure/verify/mod.rs", "use crate::{gpu::Gpu, render::Renderer};");
    faulty("measure/cellar/mod.rs", "");
    faulty("basement/mod.rs", "");
    let sound = |path: &str, text: &str| assert_eq!(check(path, text), [""; 0], "{path}: {text}");
    sound("scene/camera.rs", "use crate::{asset::model, math, scene::light};\n// crate::gpu is not seen");
    sound("gpu/image.rs", "use crate::shader::table; unsafe { x() }");
    sound("asset/gltf.rs", "use super::{document, material};");
    sound("render/mod.rs", "use crate::gpu;");
    sound("math/mod.rs", "#![deny(unsafe_code)] use super::sampling;");
    sound("measure/verify/mod.rs", "use crate::measure::{furnace::Property, twin::{self, Twin}};");
    sound("measure/twin/mod.rs", "pub(in crate::measure) use domain::Random;");
    sound("measure/oracle/stage.rs", "use super::super::twin::strand; use super::render;");
    sound("measure/report/mod.rs", "use crate::measure::oracle::{self, OracleOptions}; use crate::render;");
    sound("cli/report.rs", "use vair::measure::{report, verify};");
    sound("main.rs", "use vair::render; use crate::cli;");
}

/// What is wrong with a file at `path` under `src`, one line each.
fn check(path: &str, text: &str) -> Vec<String> {
    if ROOTS.contains(&path) {
        return Vec::new();
    }
    let own = room_of(path.trim_end_matches(".rs").split('/'));
    let Some((_, seen)) = ROOMS.iter().find(|(room, _)| *room == own) else {
        return vec![format!("{path}: `{own}` is not a room: give it a place in tests/imports.rs")];
    };
    let may_see = |room: &str| room == own || seen.iter().any(|of| room == *of || room.starts_with(&format!("{of}/")));
    let code: String = text.lines().flat_map(|line| [line.split("//").next().unwrap_or(""), "\n"]).collect();
    let mut violations = Vec::new();
    // As many steps up as the file is deep lead to the crate's root, and one fewer to the root of its part.
    let depth = path.trim_end_matches("/mod.rs").split('/').count();
    let to_measure = if path.starts_with("measure/") { "super::".repeat(depth - 1) } else { String::new() };
    for (prefix, root) in [("crate::", ""), ("vair::", ""), (&"super::".repeat(depth), ""), (&to_measure, MEASURE)] {
        // A visibility names a room and sees nothing of it.
        let is_seen = |at: usize| !prefix.is_empty() && !code[..at].ends_with("pub(in ");
        for at in code.match_indices(prefix).map(|(at, _)| at).filter(|at| is_seen(*at)) {
            for path_seen in paths(&code[at + prefix.len()..]) {
                let room = room_of(std::iter::once(root).filter(|root| !root.is_empty()).chain(path_seen));
                if !may_see(&room) && (room == MEASURE || ROOMS.iter().any(|(known, _)| *known == room)) {
                    violations.push(format!("src/{path}: {own} must not see {room}"));
                }
            }
        }
    }
    violations.sort();
    violations.dedup();
    let is_word = |letter: char| letter.is_alphanumeric() || letter == '_';
    if own != "gpu" && code.split(|letter| !is_word(letter)).any(|word| word == "unsafe") {
        violations.push(format!("src/{path}: unsafe code belongs under src/gpu"));
    }
    violations
}

/// The room that a path of modules leads into.
fn room_of<'a>(mut path: impl Iterator<Item = &'a str>) -> String {
    match (path.next().unwrap_or_default(), path.next()) {
        (MEASURE, Some(inner)) => format!("{MEASURE}/{inner}"),
        (room, _) => room.to_owned(),
    }
}

/// The path, or each of the paths in brace groups, that `text` starts with.
fn paths(text: &str) -> Vec<Vec<&str>> {
    let Some(group) = text.strip_prefix('{') else {
        let end = text.find(|letter: char| !letter.is_alphanumeric() && letter != '_').unwrap_or(text.len());
        let (name, rest) = text.split_at(end);
        let inner = rest.strip_prefix("::").map_or(vec![Vec::new()], paths);
        return inner.into_iter().map(|path| [vec![name], path].concat()).collect();
    };
    let (mut found, mut depth, mut start) = (Vec::new(), 0, 0);
    for (at, letter) in group.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                found.extend(paths(group[start..at].trim()));
                start = at + 1;
                if letter == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    found
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
