//! Pictures stay as they were when somebody looked at them.

use crate::fuzz::fuzz_balls;
use crate::gauze::gauze_balls;
use crate::glint::glint_balls;
use crate::golden::{Limits, bless, compare, folder, is_pinned};
use crate::headless::headless;
use crate::laser::laser_balls;
use crate::satin::satin_balls;
use crate::scenes::{balls, fur_ball, fur_cube};
use std::path::Path;
use vair::asset::procedural::GALLERY_CAMERA;
use vair::gpu::DeviceInfo;
use vair::render::{FrameOptions, Picture, Tonemap};
use vair::scene::{CameraChoice, Scene};

/// A picture, and how far it may be from its golden.
pub struct Golden {
    /// Stem of the file.
    pub name: &'static str,
    pub scene: fn() -> Scene,
    pub camera: fn() -> CameraChoice,
    /// On the driver that made it.
    pub pinned: Limits,
    /// On any other driver: another place for samples, other rounding, other strands at a threshold.
    pub other: Limits,
}

const SIZE: [u32; 2] = [256, 160];

/// The same driver gives the same bytes; a step of rounding is left for another processor's vector width.
pub const SAME: Limits = Limits { max_difference: 1, outlier_share: 0.0, flip_mean: 1e-3, flip_p99: 0.01 };
const SMOOTH: Limits = Limits { max_difference: 8, outlier_share: 0.02, flip_mean: 0.01, flip_p99: 0.1 };
pub const HAIRY: Limits = Limits { max_difference: 24, outlier_share: 0.15, flip_mean: 0.05, flip_p99: 0.35 };

/// Every golden, one line each.
pub const GOLDENS: [Golden; 9] = [
    Golden { name: "standard-balls", scene: balls, camera: first, pinned: SAME, other: SMOOTH },
    Golden { name: "fuzz-balls", scene: fuzz_balls, camera: first, pinned: SAME, other: SMOOTH },
    Golden { name: "laser-balls", scene: laser_balls, camera: first, pinned: SAME, other: SMOOTH },
    Golden { name: "satin-balls", scene: satin_balls, camera: first, pinned: SAME, other: SMOOTH },
    Golden { name: "gauze-balls", scene: gauze_balls, camera: first, pinned: SAME, other: SMOOTH },
    Golden { name: "glint-balls", scene: glint_balls, camera: first, pinned: SAME, other: HAIRY },
    Golden { name: "fur-ball", scene: fur_ball, camera: first, pinned: SAME, other: HAIRY },
    Golden { name: "fur-cube", scene: fur_cube, camera: first, pinned: SAME, other: HAIRY },
    Golden { name: "gallery", scene: Scene::gallery, camera: hero, pinned: SAME, other: HAIRY },
];

fn first() -> CameraChoice {
    CameraChoice::Index(0)
}

fn hero() -> CameraChoice {
    CameraChoice::Named(GALLERY_CAMERA.to_owned())
}

impl Golden {
    pub fn options(&self) -> FrameOptions {
        FrameOptions {
            size: SIZE,
            camera: (self.camera)(),
            tonemap: Tonemap::Neutral,
            msaa: 4,
            ..FrameOptions::default()
        }
    }

    pub fn limits(&self, device: &DeviceInfo) -> &Limits {
        if is_pinned(device) { &self.pinned } else { &self.other }
    }
}

/// Compares all; a list without entries checks nothing and is a failure, too.
pub fn check_all(
    goldens: &[Golden],
    folder: &Path,
    device: &DeviceInfo,
    mut render: impl FnMut(&Golden) -> Picture,
) -> Result<(), String> {
    if goldens.is_empty() {
        return Err("there are no goldens to check".to_owned());
    }
    let check = |golden: &Golden| compare(folder, golden.name, &render(golden), golden.limits(device)).err();
    let problems: Vec<String> = goldens.iter().filter_map(check).collect();
    if problems.is_empty() { Ok(()) } else { Err(problems.join("\n")) }
}

#[test]
fn pictures_are_their_goldens() {
    headless(|device| {
        let info = device.renderer.gpu().info().clone();
        let mut render = |golden: &Golden| device.picture(&(golden.scene)(), &golden.options());
        if std::env::var_os("VAIR_BLESS").is_some() {
            for golden in &GOLDENS {
                bless(&folder(), golden.name, &render(golden), &info).unwrap_or_else(|problem| panic!("{problem}"));
            }
        }
        check_all(&GOLDENS, &folder(), &info, render).unwrap_or_else(|problem| panic!("{problem}"));
    });
}

#[test]
fn no_golden_lies_about_without_a_check() {
    let files = std::fs::read_dir(folder()).unwrap_or_else(|error| panic!("{}: {error}", folder().display()));
    for file in files {
        let path = file.unwrap_or_else(|error| panic!("{error}")).path();
        let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        assert!(GOLDENS.iter().any(|golden| golden.name == stem), "{} is nobody's golden", path.display());
    }
}
