//! A renderer without a window, under validation and synchronization validation.

use vair::gpu::{Gpu, GpuOptions};
use vair::render::{FrameOptions, FrameReport, Picture, Renderer};
use vair::scene::Scene;

/// A renderer under the validation layer; [`headless`] lends one.
pub struct Headless {
    /// The renderer.
    pub renderer: Renderer,
}

impl Headless {
    /// One picture with its linear radiance.
    pub fn picture(&mut self, scene: &Scene, options: &FrameOptions) -> Picture {
        self.reported(scene, options).0
    }

    /// One picture with its linear radiance, and its report.
    pub fn reported(&mut self, scene: &Scene, options: &FrameOptions) -> (Picture, FrameReport) {
        self.renderer.render_reported(scene, options, true).unwrap_or_else(|error| panic!("{error}"))
    }
}

/// Lends a renderer to `check` and fails when the validation layer says anything, up to the end of renderer and device.
/// Being lent, the renderer cannot outlive the look at the messages. Without a device or the layer it fails, too.
#[track_caller]
pub fn headless(check: impl FnOnce(&mut Headless)) {
    let messages = validation_messages(check);
    assert!(messages.is_empty(), "the validation layer says:\n{}", messages.join("\n"));
}

/// What the validation layer says about `check` and the end of the device.
pub fn validation_messages(check: impl FnOnce(&mut Headless)) -> Vec<String> {
    // What is made of an environment once serves every test.
    let pipeline_cache_dir = Some(env!("CARGO_TARGET_TMPDIR").into());
    let gpu = Gpu::new(&GpuOptions { validate: true, pipeline_cache_dir, ..GpuOptions::default() })
        .unwrap_or_else(|error| panic!("{error}; tools/setup installs what the tests need"));
    let log = gpu.validation_log();
    let renderer = Renderer::with_gpu(gpu.clone());
    let mut lent = Headless { renderer };
    check(&mut lent);
    drop(lent);
    drop(gpu);
    log.messages()
}
