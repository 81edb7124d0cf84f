//! The host that pictures are drawn by: it keeps a scene on the device, targets and read-back memory from picture to picture.

use super::skybox::SkyboxImage;
use super::targets::PictureTargets;
use super::{PICTURE_FORMAT, PICTURE_NAME};
use crate::gpu::{Encoder, Gpu, GpuError, Image, ImageDesc};
use crate::render::device_scene::{DrawnScene, DynamicsStep, FrameRequest, LONGEST_STEP_S, SceneResources};
use crate::render::pass::oit_resolve::Lists;
use crate::render::pass::{Pass, PictureFrame, skinning, ssao_blur, strand_dynamics};
use crate::render::plan::FrameSetup;
use crate::render::renderer::Shared;
use crate::render::view::View;
use crate::render::{Background, FrameOptions, RenderError};
use crate::scene::Scene;
use ash::vk;

/// What is played: scene, its index, clip, variant. Frames of anything else do not follow.
type Take = (u64, Option<usize>, Option<usize>, Option<usize>);

/// What pictures keep from one to the next.
#[derive(Default)]
pub(crate) struct PictureHost {
    setup: Option<FrameSetup>,
    resources: SceneResources,
    pub(super) targets: Option<PictureTargets>,
    skybox: Option<SkyboxImage>,
    image: Option<Image>,
    /// Take and seconds of the last frame; `None` before the first and after one that failed.
    last: Option<(Take, f32)>,
    pub(super) readback: super::capture::Readback,
}

impl PictureHost {
    /// Poses the scene and plans the frame.
    ///
    /// # Errors
    /// Those of [`FrameSetup::new`].
    pub fn set_up(&mut self, scene: &Scene, options: &FrameOptions) -> Result<(), RenderError> {
        let updated = match &mut self.setup {
            Some(setup) => setup.update(scene, options),
            None => FrameSetup::new(scene, options).map(|setup| self.setup = Some(setup)),
        };
        updated.inspect_err(|_| self.setup = None)
    }

    /// The frame that was set up last.
    pub fn setup(&self) -> Option<&FrameSetup> {
        self.setup.as_ref()
    }

    /// Makes what the frame needs and is not there yet, and writes its values.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn prepare(
        &mut self,
        shared: &mut Shared,
        encoder: &mut Encoder,
        scene: &Scene,
        options: &FrameOptions,
    ) -> Result<(), RenderError> {
        let Some(setup) = &self.setup else { return Ok(()) };
        let plan = &setup.staging.plan;
        let larger = self.larger_lists(&shared.gpu)?;
        // The old ones go first: two sets need not fit at once.
        if larger.is_some() || !self.targets.as_ref().is_some_and(|kept| kept.fit(options.size, &plan.attachments)) {
            self.targets = None;
        }
        let view = View::of(&setup.camera, setup.previous_camera.as_ref(), options.size);
        if self.targets.is_none() {
            self.targets = Some(PictureTargets::new(&shared.gpu, options.size, &plan.attachments)?);
        }
        let ssao = self.targets.as_ref().and_then(|targets| targets.image(ssao_blur::VISIBILITY));
        let is_mean_shown = options.background == Background::Environment && !options.hdr_format.has_alpha();
        let request = FrameRequest {
            views: &[view],
            environment: &options.environment,
            quality: options.environment_quality,
            host_environment: None,
            host_shadows: None,
            shows_environment_mean: is_mean_shown,
            ssao,
            step: step(self.last, scene, options),
        };
        self.last = None;
        self.resources.prepare(shared, encoder, scene, &setup.staging, &request)?;
        self.prepare_targets(shared, options, larger)?;
        Ok(())
    }

    /// The groups that read the targets, the skybox, and the picture itself.
    fn prepare_targets(
        &mut self,
        shared: &mut Shared,
        options: &FrameOptions,
        larger: Option<u32>,
    ) -> Result<(), RenderError> {
        let (Some(setup), Some(targets)) = (&self.setup, &mut self.targets) else { return Ok(()) };
        let map = &options.environment.map;
        if options.shows_environment() && !self.skybox.as_ref().is_some_and(|image| image.is_of(map)) {
            targets.unbind();
            self.skybox = None;
            self.skybox = Some(SkyboxImage::new(&shared.gpu, map)?);
        }
        let plan = &setup.staging.plan;
        let builds = plan.pipelines.iter().position(|spec| spec.builds_lists());
        if let Some(builds) = builds.filter(|_| targets.lists.is_none()) {
            let capacity = larger.unwrap_or(Lists::first_capacity(options.size));
            targets.make_lists(&shared.gpu, capacity, self.resources.pipeline(builds))?;
        }
        targets.bind(shared, plan, &options.plan_options(), self.skybox.as_ref())?;
        if self.image.as_ref().is_none_or(|image| image.size() != options.size) {
            self.image = None;
            self.image = Some(picture_image(&shared.gpu, options.size)?);
        }
        Ok(())
    }

    /// Records all passes of the frame.
    pub fn record(&mut self, encoder: &mut Encoder, scene: &Scene, options: &FrameOptions) {
        let Self { setup: Some(setup), targets: Some(targets), image: Some(display), resources, .. } = self else {
            return;
        };
        let drawn = DrawnScene { scene, staging: &setup.staging, resources };
        let frame = PictureFrame { setup, options, drawn, targets, skybox: self.skybox.as_ref(), display };
        if let Some((lists, _)) = &targets.lists {
            lists.clear(encoder);
        }
        for pass in &setup.staging.plan.passes {
            pass.record(encoder, &frame);
        }
        if let Some((lists, _)) = &mut targets.lists {
            lists.keep_count();
        }
        self.keep(scene, options);
    }

    /// Records what moves vertices, without anything that is drawn.
    pub fn record_motion(&mut self, encoder: &mut Encoder, scene: &Scene, options: &FrameOptions) {
        let Some(setup) = &self.setup else { return };
        let drawn = DrawnScene { scene, staging: &setup.staging, resources: &self.resources };
        skinning::record(encoder, &drawn);
        strand_dynamics::record(encoder, &drawn);
        self.keep(scene, options);
    }

    /// The frame's commands are complete.
    fn keep(&mut self, scene: &Scene, options: &FrameOptions) {
        self.resources.keep();
        self.last = Some((take(scene, options), options.time_s));
    }

    /// The frame failed: what it should have made may be without its contents.
    pub fn fail(&mut self) {
        self.resources.fail();
        (self.last, self.targets) = (None, None);
    }

    /// Whether strands of the frame that was set up lag behind.
    pub fn has_dynamics(&self) -> bool {
        self.setup.as_ref().is_some_and(|setup| setup.staging.plan.passes.contains(&Pass::StrandDynamics))
    }

    /// Entries that the last frame would have needed, where there can be more than there are.
    ///
    /// # Errors
    /// Those of reading memory.
    pub fn larger_lists(&self, gpu: &Gpu) -> Result<Option<u32>, GpuError> {
        let lists = self.targets.as_ref().and_then(|targets| targets.lists.as_ref());
        Ok(lists.map(|(lists, _)| lists.larger_capacity(gpu)).transpose()?.flatten())
    }

    /// The picture.
    pub fn image(&self) -> Option<&Image> {
        self.image.as_ref()
    }
}

fn picture_image(gpu: &Gpu, size: [u32; 2]) -> Result<Image, GpuError> {
    gpu.image(&ImageDesc {
        name: PICTURE_NAME,
        size,
        format: PICTURE_FORMAT,
        mip_levels: 1,
        samples: 1,
        usage: vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::TRANSFER_SRC,
        is_cube: false,
    })
}

fn take(scene: &Scene, options: &FrameOptions) -> Take {
    (scene.id(), options.scene, options.animation, options.variant)
}

/// Seconds since the last frame, 0 for the same time once more; strands start from rest where this frame does not follow
/// the last one.
fn step(last: Option<(Take, f32)>, scene: &Scene, options: &FrameOptions) -> DynamicsStep {
    let step_s = last.and_then(|(last_take, last_s)| {
        let step_s = options.time_s - last_s;
        // The difference of two rounded times is off by as much as they are.
        let rounding_s = options.time_s.abs() * f32::EPSILON;
        let follows = last_take == take(scene, options) && step_s >= 0.0 && step_s <= LONGEST_STEP_S + rounding_s;
        follows.then_some(step_s.min(LONGEST_STEP_S))
    });
    DynamicsStep { is_reset: step_s.is_none(), step_s: step_s.unwrap_or(0.0) }
}
