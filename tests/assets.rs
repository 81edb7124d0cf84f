//! Every real model that is at hand renders without a validation message and shows something, as it is and with fur on
//! everything.

use std::path::{Path, PathBuf};
use vair::render::Background;
use vair::{FrameOptions, GpuOptions, LoadOptions, Look, Picture, Renderer, Scene};

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

fn options() -> FrameOptions {
    let background = Background::Color(glam::Vec3::new(1.0, 0.0, 1.0));
    FrameOptions { size: [160, 90], msaa: 1, background, ..FrameOptions::default() }
}

/// Shown where nothing was drawn; no model is of that colour.
const BACKGROUND: [u8; 4] = [255, 0, 255, 255];

fn covered_share(picture: &Picture) -> f64 {
    let pixels = picture.rgba.chunks_exact(4);
    pixels.clone().filter(|pixel| **pixel != BACKGROUND).count() as f64 / pixels.len() as f64
}

/// Seconds into every model's first clip, if it has one, at which it is rendered.
fn times_s(scene: &Scene) -> Vec<f32> {
    match scene.asset().animations.first() {
        Some(clip) => vec![0.0, 0.37 * clip.duration_s],
        None => vec![0.0],
    }
}

#[test]
fn every_model_renders_with_and_without_fur() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/assets");
    if !folder.is_dir() {
        return println!("no shared models: nothing to render");
    }
    let mut models = Vec::new();
    collect_models(&folder, &mut models);
    models.sort();
    assert!(!models.is_empty());

    let mut renderer = Renderer::new(&GpuOptions { validate: true, ..GpuOptions::default() }).unwrap();
    let mut problems = Vec::new();
    let (mut pictures, mut messages, mut least_share) = (0, 0, 1.0f64);
    for path in &models {
        let name = path.strip_prefix(&folder).unwrap().display();
        for preset in [None, Some("fox")] {
            let mut scene = Scene::load(path, &LoadOptions::default()).unwrap_or_else(|error| panic!("{error}"));
            if let Some(preset) = preset {
                let look = Look::preset(preset, None).unwrap();
                scene.apply(&look, Path::new(""), &LoadOptions::default()).unwrap();
            }
            for time_s in times_s(&scene) {
                let animation = (!scene.asset().animations.is_empty()).then_some(0);
                let options = FrameOptions { animation, time_s, ..options() };
                match renderer.render(&scene, &options) {
                    Ok(picture) if covered_share(&picture) == 0.0 => {
                        problems.push(format!("{name} {preset:?} at {time_s} s: nothing is seen"));
                    }
                    Ok(picture) => {
                        pictures += 1;
                        least_share = least_share.min(covered_share(&picture));
                    }
                    Err(error) => problems.push(format!("{name} {preset:?} at {time_s} s: {error}")),
                }
                let all = renderer.gpu().validation_messages();
                problems.extend(all[messages..].iter().map(|text| format!("{name} {preset:?} at {time_s} s: {text}")));
                messages = all.len();
            }
        }
    }
    assert!(problems.is_empty(), "{} problems\n{}", problems.len(), problems.join("\n"));
    // Were the background not what this test takes it for, every pixel would count as covered.
    assert!(least_share < 0.5, "{least_share}");
    println!("{} models, {pictures} pictures", models.len());
}
