//! However shells reach the device, the picture is the same: instances, draws, or vertices once a shell.

use crate::headless::headless;
use crate::scenes::fur_cube;
use crate::skinning::bent_tube;
use crate::stage::options;
use vair::material::{Blend, Fur};
use vair::render::{
    FrameOptions, FrameReport, FrameSetup, RenderError, ShellOrder, ShellSubmission, Shells, Transparency,
};
use vair::scene::Scene;

const LAYERS: u64 = 8;
/// Of the cube.
const VERTICES: u64 = 24;
/// Positions and normals of the skin, shell directions of the coat.
const BYTES_A_VERTEX: u64 = 3 * 12;
const INDEX_BYTES: u64 = 36 * 4;

fn with_coat(change: impl Fn(&mut Fur)) -> Scene {
    let mut scene = fur_cube();
    let mut coats = scene.materials_mut().iter_mut().filter_map(|material| material.fur.as_mut());
    coats.next().map(change).expect("a cube with a coat");
    scene
}

#[test]
fn shells_look_the_same_however_they_are_submitted() {
    let blending = with_coat(|fur| fur.blend = Blend::Blend);
    for (scene, order) in [
        (&fur_cube(), ShellOrder::OuterFirst),
        (&fur_cube(), ShellOrder::InnerFirst),
        (&fur_cube(), ShellOrder::Blended),
        (&blending, ShellOrder::OuterFirst),
    ] {
        headless(|device| {
            let mut shown = |submission| {
                let shells = Shells { submission, order, ..Shells::default() };
                // Lists that are too short are drawn again, which would count twice.
                let transparency = Transparency::Sorted;
                device.reported(scene, &FrameOptions { shells, transparency, ..options([96, 96], 4) })
            };
            let (instanced, report) = shown(ShellSubmission::Instanced);
            // What blends is drawn side by side.
            let (skins, sides) = (2, if report.passes.iter().any(|pass| pass.name == "transparent") { 2 } else { 1 });
            let draws = |report: &FrameReport| report.calls.of("vkCmdDrawIndexed") - skins;
            assert_eq!((draws(&report), report.fur[0].vertices_stored), (sides, VERTICES as u32));

            let (as_draws, report) = shown(ShellSubmission::Draws);
            assert_eq!((draws(&report), report.fur[0].vertices_stored), (sides * LAYERS, VERTICES as u32));
            assert!(instanced.rgba == as_draws.rgba && instanced.radiance == as_draws.radiance, "{order:?}: draws");

            let (duplicated, report) = shown(ShellSubmission::Duplicated);
            assert_eq!((draws(&report), report.fur[0].vertices_stored), (sides, (VERTICES * LAYERS) as u32));
            assert!(
                instanced.rgba == duplicated.rgba && instanced.radiance == duplicated.radiance,
                "{order:?}: duplicated"
            );
        });
    }
}

#[test]
fn duplicated_shells_are_uploaded_once_each_and_go_again() {
    let scene = fur_cube();
    let frame =
        |submission| FrameOptions { shells: Shells { submission, ..Shells::default() }, ..options([32, 32], 1) };
    let [one, many] = [ShellSubmission::Instanced, ShellSubmission::Duplicated].map(frame);
    let bytes = |frame: &FrameOptions| {
        let plan = FrameSetup::new(&scene, frame).unwrap_or_else(|error| panic!("{error}")).staging.plan;
        plan.stream_bytes(scene.asset()) + plan.index_bytes(scene.asset())
    };
    let coat = VERTICES * BYTES_A_VERTEX + INDEX_BYTES;
    assert_eq!(bytes(&many) - bytes(&one), (LAYERS - 1) * coat);
    headless(|device| {
        let mut uploaded = |frame| device.reported(&scene, frame).1.calls.uploaded_bytes;
        let (first, again) = (uploaded(&one), uploaded(&one));
        assert_eq!(uploaded(&many) - again, LAYERS * coat, "the coat's streams and indices, all anew");
        assert_eq!(uploaded(&many), again, "and only once");
        assert_eq!(uploaded(&one) - again, coat, "back to one copy");
        assert!(first > again + coat);
    });
}

#[test]
fn a_coat_that_moves_cannot_be_duplicated() {
    for skinned in [true, false] {
        let mut scene = bent_tube(skinned);
        scene.materials_mut()[0].fur = Some(Fur::default());
        let shells = Shells { submission: ShellSubmission::Duplicated, ..Shells::default() };
        let error = FrameSetup::new(&scene, &FrameOptions { shells, ..options([8, 8], 1) }).err();
        assert!(matches!(error, Some(RenderError::Option { option: "duplicated shells", .. })), "{error:?}");
    }
}
