//! What a plan leaves out changes nothing: with everything drawn the picture is the same.

use crate::headless::headless;
use crate::plans::textured_quad;
use crate::scenes::{fur_cube, plain_cube};
use crate::skinning::bent_tube;
use crate::stage::options;
use vair::asset::procedural::GALLERY_CAMERA;
use vair::render::{Eye, FrameOptions, FrameSetup, Pass, Picture, PipelineSpec, Shadows};
use vair::scene::{CameraChoice, Scene};

/// Where everything is drawn, directions are scaled to unit length once more (the deform pass) and detail is multiplied
/// by 4.6716 after it was divided by it: some 4 roundings of 2^-24. At the smallest roughness, alpha = 1e-3, that is at
/// most 1e-3 of a highlight (`limit.rs`), one step of an 11-bit half float; rounding to half floats makes it two.
const LARGEST_HALF_STEPS: f32 = 2.0;
/// A half float's own rounding hides all but one in thousands.
const DIFFERING_SHARE: f64 = 1e-3;

/// Whether a pixel lies within a strand is decided at one place of it: where a strand's edge passes within a rounding of
/// that place, it may be decided otherwise.
const JUMPING_SHARE: f64 = 1e-4;

/// Shares of channels of two radiances that are more than [`LARGEST_HALF_STEPS`] apart, and that differ at all.
fn half_steps(a: &Picture, b: &Picture) -> (f64, f64) {
    let channels = |picture: &Picture| picture.radiance.iter().flat_map(|r| r.to_array()).collect::<Vec<f32>>();
    let (mut jumping, mut differing) = (0, 0);
    for (a, b) in channels(a).into_iter().zip(channels(b)) {
        // Half floats keep 11 bits, and below 2^-14 a fixed step.
        let exponent = a.abs().max(b.abs()).max(2f32.powi(-14)).log2().floor() as i32;
        jumping += usize::from((a - b).abs() / 2f32.powi(exponent - 10) > LARGEST_HALF_STEPS);
        differing += usize::from(a != b);
    }
    let share = |count| count as f64 / (4 * a.radiance.len()) as f64;
    (share(jumping), share(differing))
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
            let frame = FrameOptions { msaa, shadows: Shadows::default(), ..frame.clone() };
            let all = FrameOptions { everything: true, ..frame.clone() };
            let [planned, full] = [&frame, &all]
                .map(|frame| FrameSetup::new(&scene, frame).unwrap_or_else(|error| panic!("{error}")).staging.plan);
            // What blends is sorted by pixels or by objects, and no host gives a shadow map.
            let others = [Pass::Transparent, Pass::HostShadow];
            let every: Vec<Pass> = Pass::ALL.iter().copied().filter(|pass| !others.contains(pass)).collect();
            assert_eq!(full.passes, every, "{what}: every pass is there");
            let shows = |spec: &&PipelineSpec| spec.eye == Eye::Camera;
            let same = full.pipelines.iter().filter(shows).any(|spec| planned.pipelines.contains(spec));
            assert!(!same, "{what}: others are drawn");
            headless(|device| {
                let (found, expected) = (device.picture(&scene, &all), device.picture(&scene, &frame));
                let covered = expected.radiance.iter().filter(|radiance| radiance.w > 0.0).count();
                let far = found.rgba.iter().zip(&expected.rgba).filter(|(a, b)| a.abs_diff(**b) > 1).count();
                let far = far as f64 / found.rgba.len() as f64;
                let (jumping, share) = half_steps(&found, &expected);
                let limit = if planned.draws_of(Pass::Fur).is_empty() { 0.0 } else { JUMPING_SHARE };
                let what =
                    format!("{what}, {msaa} samples: {jumping} jump, {far} by more than a level, {share} differ");
                assert!(covered > 1000, "{what}: only {covered} pixels are covered");
                assert!(far <= limit && jumping <= limit && share <= DIFFERING_SHARE, "{what}");
            });
        }
    }
}
