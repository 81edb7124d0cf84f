//! The same frame twice is the same bytes, with the same renderer and with another one.

use crate::headless::headless;
use vair::asset::procedural::GALLERY_CAMERA;
use vair::render::{FrameOptions, Picture};
use vair::scene::{CameraChoice, Scene};

fn bits(picture: &Picture) -> (&[u8], Vec<u32>) {
    (&picture.rgba, picture.radiance.iter().flat_map(|radiance| radiance.to_array().map(f32::to_bits)).collect())
}

#[test]
fn repeated_runs_are_byte_identical() {
    let camera = CameraChoice::Named(GALLERY_CAMERA.to_owned());
    for msaa in [1, 4] {
        let options = FrameOptions { size: [160, 90], camera: camera.clone(), msaa, ..FrameOptions::default() };
        let mut pictures = Vec::new();
        headless(|device| {
            let gallery = Scene::gallery();
            pictures.push(device.picture(&gallery, &options));
            pictures.push(device.picture(&gallery, &options));
            // Another scene in between, and the same one loaded again.
            device.picture(&crate::scenes::plain_cube(), &options_of_first(&options));
            pictures.push(device.picture(&Scene::gallery(), &options));
        });
        headless(|device| pictures.push(device.picture(&Scene::gallery(), &options)));
        for (run, picture) in pictures.iter().enumerate().skip(1) {
            assert!(bits(picture) == bits(&pictures[0]), "run {run} at {msaa} samples differs from the first");
        }
    }
}

fn options_of_first(options: &FrameOptions) -> FrameOptions {
    FrameOptions { camera: CameraChoice::Index(0), ..options.clone() }
}
