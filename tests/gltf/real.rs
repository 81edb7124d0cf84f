//! Real models, where they are present.

use crate::hostile::assert_promises;
use std::path::{Path, PathBuf};
use vair::asset::{LoadOptions, check, load};

fn shared_assets() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/assets");
    folder.is_dir().then_some(folder)
}

fn collect_models(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect_models(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "gltf" || extension == "glb") {
            found.push(path);
        }
    }
}

#[test]
fn every_shared_model_loads() {
    let Some(folder) = shared_assets() else { return println!("no shared models: nothing to load") };
    let mut models = Vec::new();
    collect_models(&folder, &mut models);
    assert!(!models.is_empty());
    for path in &models {
        let asset = load(path, &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"));
        assert_promises(&asset);
        for warning in &asset.warnings {
            println!("{}: {warning}", path.file_name().unwrap().display());
        }
    }
    println!("{} models load", models.len());
}

#[test]
fn the_fox_gets_flat_normals() {
    let Some(folder) = shared_assets() else { return println!("no shared models: nothing to check") };
    let fox = load(&folder.join("khronos/Fox/Fox.glb"), &LoadOptions::default()).unwrap();
    let primitive = &fox.meshes[0].primitives[0];
    assert_eq!((primitive.vertices.positions.len(), primitive.indices.len()), (1728, 1728));
    for (corners, normals) in primitive.vertices.positions.chunks(3).zip(primitive.vertices.normals.chunks(3)) {
        let flat = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        assert!(normals.iter().all(|normal| normal.dot(flat) > 0.999));
    }
    assert_eq!((primitive.vertices.influences_per_vertex, fox.skins[0].joints.len(), fox.animations.len()), (4, 24, 3));
}

/// Files that carry tangents agree with ours about handedness: the sign of w is glTF's, not the
/// one MikkTSpace has for V upwards.
#[test]
fn generated_tangents_have_the_handedness_of_real_files() {
    let Some(folder) = shared_assets() else { return println!("no shared models: nothing to check") };
    // Suzanne and AnimatedCube are left out: their exporter wrote the other sign.
    for name in [
        "khronos/SheenCloth/SheenCloth.gltf",
        "khronos/VertexColorTest/VertexColorTest.glb",
        "khronos/AnisotropyRotationTest/AnisotropyRotationTest.glb",
        "babylon/roundedCube.glb",
        "babylon/shaderBall.glb",
    ] {
        let asset = load(&folder.join(name), &LoadOptions::default()).unwrap();
        let theirs = &asset.meshes[0].primitives[0];
        let mut ours = theirs.clone();
        assert_eq!(vair::asset::generate_tangents(&mut ours, 0), Ok(()));
        let pairs = theirs.indices.iter().zip(&ours.indices);
        let agree = pairs.filter(|(a, b)| {
            let (a, b) = (theirs.vertices.tangents[**a as usize], ours.vertices.tangents[**b as usize]);
            a.w == b.w && a.truncate().dot(b.truncate()) > 0.9
        });
        let share = agree.count() as f32 / theirs.indices.len() as f32;
        assert!(share > 0.99, "{name}: {share}");
    }
}

#[test]
fn what_loads_keeps_every_promise() {
    let Some(folder) = shared_assets() else { return println!("no shared models: nothing to check") };
    let mut models = Vec::new();
    collect_models(&folder, &mut models);
    for path in &models {
        let asset = load(path, &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"));
        check(&asset).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
}
