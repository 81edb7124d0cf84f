//! What a plan leaves out changes nothing: with everything drawn the picture is the same.

use crate::deform::bent_tube;
use crate::headless::headless;
use crate::plans::textured_quad;
use crate::scenes::{fur_cube, plain_cube};
use crate::stage::options;
use vair::asset::procedural::GALLERY_CAMERA;
use vair::render::{FrameOptions, Pass, Picture, Shot};
use vair::scene::{CameraChoice, Scene};

/// Largest difference of two radiances in steps of half floats, and how many channels differ at all.
fn half_steps(a: &Picture, b: &Picture) -> (f32, usize) {
    let channels = |picture: &Picture| picture.radiance.iter().flat_map(|r| r.to_array()).collect::<Vec<f32>>();
    let (mut worst, mut differing) = (0.0, 0);
    for (a, b) in channels(a).into_iter().zip(channels(b)) {
        // Half floats keep 11 bits, and below 2^-14 a fixed step.
        let step =
            (2f32.powi(a.abs().max(b.abs()).max(2f32.powi(-14)).log2().floor() as i32) / 1024.0).max(2f32.powi(-24));
        worst = f32::max(worst, (a - b).abs() / step);
        differing += usize::from(a != b);
    }
    (worst, differing)
}

#[test]
fn everything_gives_the_same_picture() {
    let camera = CameraChoice::Named(GALLERY_CAMERA.to_owned());
    let gallery = FrameOptions { size: [320, 180], camera, ..FrameOptions::default() };
    for (what, scene, frame) in [
        ("plain cube", plain_cube(), options([128, 128], 1)),
        ("textured quad", textured_quad(), options([128, 128], 1)),
        ("fur cube", fur_cube(), options([128, 128], 1)),
        ("skinned tube", bent_tube(true), options([128, 128], 1)),
        ("morphed tube", bent_tube(false), options([128, 128], 1)),
        ("gallery", Scene::gallery(), gallery),
    ] {
        for msaa in [1, 4] {
            let frame = FrameOptions { msaa, ..frame.clone() };
            let all = FrameOptions { everything: true, ..frame.clone() };
            let plan = Shot::new(&scene, &all).unwrap_or_else(|error| panic!("{error}")).plan;
            assert_eq!(plan.passes, Pass::ALL, "{what}: every pass is there");
            headless(|device| {
                let (a, b) = (device.picture(&scene, &frame), device.picture(&scene, &all));
                let levels = a.rgba.iter().zip(&b.rgba).map(|(a, b)| a.abs_diff(*b));
                let (worst, differing) = half_steps(&a, &b);
                println!(
                    "{what} {msaa}: levels {:?}, {} bytes differ of {}; half steps {worst}, {differing} differ",
                    levels.clone().max(),
                    levels.clone().filter(|d| *d > 0).count(),
                    a.rgba.len()
                );
            });
        }
    }
}
