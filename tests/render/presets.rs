//! Every preset looks as its picture in the README shows it.

use crate::golden::{bless, compare, is_pinned};
use crate::goldens::{HAIRY, SAME};
use crate::headless::headless;
use std::path::Path;
use vair::asset::procedural::SWATCH_CAMERA;
use vair::material::presets;
use vair::render::FrameOptions;
use vair::scene::{CameraChoice, Scene};

#[test]
fn presets_look_as_the_readme_shows_them() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/presets");
    headless(|device| {
        let info = device.renderer.gpu().info().clone();
        let camera = CameraChoice::Named(SWATCH_CAMERA.to_owned());
        let options = FrameOptions { size: [256; 2], camera, ..FrameOptions::default() };
        let limits = if is_pinned(&info) { SAME } else { HAIRY };
        let mut wrong = Vec::new();
        for preset in presets() {
            let scene = Scene::swatch(&preset.name).unwrap_or_else(|error| panic!("{error}"));
            let picture = device.picture(&scene, &options);
            let name = preset.hyphenated();
            let done = match std::env::var_os("VAIR_BLESS") {
                Some(_) => bless(&folder, &name, &picture, &info),
                None => compare(&folder, &name, &picture, &limits).map(drop),
            };
            wrong.extend(done.err());
        }
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
        let pictures = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{error}")).count();
        assert_eq!(pictures, presets().len(), "docs/presets holds one picture a preset and nothing else");
    });
}
