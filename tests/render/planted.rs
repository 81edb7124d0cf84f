//! Planted faults: the harness notices what it is there to notice.

use crate::coat::{frame, seen_from_above, stands_as_mapped};
use crate::golden::{bless, compare, folder};
use crate::goldens::{GOLDENS, Golden, check_all};
use crate::headless::{headless, validation_messages};
use crate::limit::{all_hold, close};
use crate::shells::height_coat;
use crate::stage::{Stage, at, options, plain, quad, unlit};
use glam::{DVec3, Vec3, Vec4};
use vair::asset::Material;
use vair::gpu::{Memory, vk};
use vair::material::Fur;
use vair::measure::twin::color::linear_from_srgb;
use vair::render::{FrameOptions, Picture};

fn fur_golden() -> &'static Golden {
    GOLDENS.iter().find(|golden| golden.name == "fur-ball").expect("the fur golden")
}

#[test]
fn a_validation_error_is_caught() {
    let messages = validation_messages(|device| {
        let gpu = device.renderer.gpu();
        let buffer =
            gpu.buffer("written twice", 64, vk::BufferUsageFlags::VERTEX_BUFFER, Memory::Device).expect("a buffer");
        let mut upload = gpu.upload();
        upload.buffer(&buffer, 0, &[1; 64]);
        upload.buffer(&buffer, 0, &[2; 64]);
        upload.finish().expect("an upload");
    });
    assert!(messages.iter().any(|message| message.contains("SYNC-HAZARD-WRITE-AFTER-WRITE")), "{messages:?}");
}

#[test]
#[should_panic(expected = "SYNC-HAZARD-WRITE-AFTER-WRITE")]
fn a_test_with_a_validation_error_fails() {
    headless(|device| {
        let gpu = device.renderer.gpu();
        let buffer =
            gpu.buffer("written twice", 64, vk::BufferUsageFlags::VERTEX_BUFFER, Memory::Device).expect("a buffer");
        let mut upload = gpu.upload();
        upload.buffer(&buffer, 0, &[1; 64]);
        upload.buffer(&buffer, 0, &[2; 64]);
        upload.finish().expect("an upload");
    });
}

#[test]
fn one_shell_too_few_is_caught() {
    headless(|device| {
        let fur = Fur { cutoff_start: 0.1, cutoff_end: 0.9, ..height_coat() };
        let layers = fur.layers;
        let scene = seen_from_above(fur.clone());
        for (drawn, holds) in [(layers, true), (layers - 1, false)] {
            let picture = device.picture(&scene, &FrameOptions { layers: Some(drawn), ..frame(1) });
            assert_eq!(stands_as_mapped(&picture, &fur, layers).is_ok(), holds, "{drawn} shells for {layers}");
        }
        let golden = fur_golden();
        let limits = golden.limits(device.renderer.gpu().info()).to_owned();
        let options = FrameOptions { layers: Some(Fur::default().layers - 1), ..golden.options() };
        let picture = device.picture(&(golden.scene)(), &options);
        let kept = tempfile::tempdir().expect("a folder");
        std::fs::copy(folder().join("fur-ball.png"), kept.path().join("one-shell-too-few.png")).expect("the golden");
        assert!(compare(kept.path(), "one-shell-too-few", &picture, &limits).is_err());
    });
}

#[test]
fn a_decoded_data_texture_is_caught() {
    // Grey through the colour path, judged as data: what a map bound in the wrong format would show.
    let grey = 128;
    let mut stage = Stage::front(0.5);
    let texture = stage.texel([grey, grey, grey, 255]);
    let material = stage.material(Material { base_color_texture: Some(texture), ..unlit(Vec4::ONE) });
    stage.object(quad(0.5, 0.5), material, at(Vec3::ZERO));
    let scene = stage.scene();
    let as_data = DVec3::splat(f64::from(grey) / 255.0);
    headless(|device| {
        let radiance = device.picture(&scene, &options([4, 4], 1)).radiance(1, 1);
        assert!(close("data", radiance, as_data).is_err());
        assert!(radiance.x > 0.0 && (f64::from(radiance.x) - linear_from_srgb(as_data.x)).abs() < 4e-3);
    });
}

#[test]
#[should_panic(expected = "1 of 1 checks fail")]
fn a_wrong_pixel_fails() {
    headless(|device| {
        let mut stage = Stage::front(0.5);
        let material = stage.material(Material { roughness: 0.5, ..plain() });
        stage.object(quad(0.5, 0.5), material, at(Vec3::ZERO));
        let radiance = device.picture(&stage.scene(), &options([2, 2], 1)).radiance(0, 0);
        all_hold([close("a hundredth off", radiance, radiance.truncate().as_dvec3() * 1.01)]);
    });
}

#[test]
#[should_panic(expected = "nothing was checked")]
fn a_check_of_nothing_fails() {
    all_hold(Vec::new());
}

#[test]
fn stale_missing_and_foreign_goldens_are_caught() {
    headless(|device| {
        let info = device.renderer.gpu().info().clone();
        let golden = fur_golden();
        let picture = device.picture(&(golden.scene)(), &golden.options());
        let kept = tempfile::tempdir().expect("a folder");
        let problem = compare(kept.path(), "missing", &picture, &golden.pinned).expect_err("there is no golden");
        assert!(problem.contains("tools/bless"), "{problem}");

        // A golden from before a change of colour; one from before a change of size.
        let stale = Picture {
            rgba: picture.rgba.iter().map(|byte| byte.saturating_sub(byte / 4)).collect(),
            ..picture.clone()
        };
        stale.save(kept.path().join("stale.png")).expect("a file");
        assert!(compare(kept.path(), "stale", &picture, &golden.other).is_err());
        let small = Picture { size: [2, 1], rgba: vec![7; 8], ..picture.clone() };
        small.save(kept.path().join("small.png")).expect("a file");
        assert!(compare(kept.path(), "small", &picture, &golden.other).is_err());

        assert!(check_all(&[], kept.path(), &info, |_| picture.clone()).is_err(), "an empty list checks nothing");
        let mut foreign = info;
        foreign.driver = "lavapipe 99".to_owned();
        assert!(bless(kept.path(), "foreign", &picture, &foreign).is_err());
        assert!(!kept.path().join("foreign.png").exists());
    });
}
