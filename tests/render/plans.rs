//! What a frame needs, and the whole state of each pipeline that it makes, as text: a change must be meant.

use crate::headless::headless;
use crate::plan_text::plan_text;
use crate::scenes::{fur_cube, plain_cube};
use crate::skinning::bent_tube;
use crate::stage::{NEAREST, Stage, at, options, plain, quad};
use glam::Vec3;
use vair::asset::Material;
use vair::asset::procedural::GALLERY_CAMERA;
use vair::render::{FrameOptions, FrameSetup};
use vair::scene::{CameraChoice, Scene};

/// A quad with a colour and a normal map.
pub fn textured_quad() -> Scene {
    let mut stage = Stage::front(1.0);
    let color = stage.texture([2, 2], &[[200; 4]; 4], NEAREST);
    let normal = stage.texel([128, 128, 255, 255]);
    let material =
        stage.material(Material { base_color_texture: Some(color), normal_texture: Some(normal), ..plain() });
    stage.object(quad(1.0, 1.0), material, at(Vec3::ZERO));
    stage.scene()
}

fn snapshot(name: &str, scene: &Scene, frame: &FrameOptions) {
    let setup = FrameSetup::new(scene, frame).unwrap_or_else(|error| panic!("{error}"));
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(format!("plan-{name}"), plan_text(scene, &setup)));
    headless(|device| {
        device.picture(scene, &FrameOptions { size: [16, 16], ..frame.clone() });
        let pipelines = device.renderer.pipeline_descriptions().join("\n");
        settings.bind(|| insta::assert_snapshot!(format!("pipelines-{name}"), pipelines));
    });
}

#[test]
fn plain_cube_needs_one_pipeline() {
    snapshot("plain-cube", &plain_cube(), &options([64, 64], 4));
}

#[test]
/// A quad with a colour and a normal map.
pub fn textured_quad_loads_its_maps() {
    snapshot("textured-quad", &textured_quad(), &options([64, 64], 4));
}

#[test]
fn fur_cube_needs_skin_and_shells() {
    snapshot("fur-cube", &fur_cube(), &options([64, 64], 4));
}

#[test]
fn bent_tube_is_deformed_once() {
    snapshot("bent-tube", &bent_tube(true), &options([64, 64], 1));
}

#[test]
fn gallery_needs_what_it_shows() {
    let camera = CameraChoice::Named(GALLERY_CAMERA.to_owned());
    snapshot("gallery", &Scene::gallery(), &FrameOptions { size: [64, 36], camera, ..FrameOptions::default() });
}
