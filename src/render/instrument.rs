//! A frame drawn by other pipelines than its own, for those who measure: the same draws in the same order, into whatever
//! targets they like.

use super::device_scene::{DrawnScene, DynamicsStep, FrameRequest, SceneResources};
use super::pass::{Pass, draw, skinning, strand_dynamics};
use super::{FrameOptions, FrameSetup, RenderError, Renderer, View};
use crate::gpu::{Encoder, Pipeline, RenderPass};
use crate::scene::Scene;

pub(crate) use super::surface::alpha_constant;

/// A frame on the device, whose plan somebody has changed.
pub(crate) struct Instrumented<'a> {
    scene: &'a Scene,
    setup: &'a FrameSetup,
    resources: SceneResources,
}

impl<'a> Instrumented<'a> {
    /// Makes what the plan lists, and writes the frame's values.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn prepare(
        renderer: &mut Renderer,
        encoder: &mut Encoder,
        scene: &'a Scene,
        setup: &'a FrameSetup,
        options: &FrameOptions,
    ) -> Result<Self, RenderError> {
        let mut resources = SceneResources::default();
        let request = FrameRequest {
            views: &[View::of(&setup.camera, setup.previous_camera.as_ref(), options.size)],
            environment: &options.environment,
            quality: options.environment_quality,
            host_environment: None,
            host_shadows: None,
            shows_environment_mean: false,
            ssao: None,
            step: DynamicsStep { is_reset: true, step_s: 0.0 },
        };
        resources.prepare(&mut renderer.shared, encoder, scene, &setup.staging, &request)?;
        Ok(Self { scene, setup, resources })
    }

    /// Records what moves vertices.
    pub fn record_motion(&self, encoder: &mut Encoder) {
        skinning::record(encoder, &self.drawn());
        strand_dynamics::record(encoder, &self.drawn());
    }

    /// Records the draws of a pass, what blends from far to near.
    pub fn record_draws(&self, render_pass: &mut RenderPass, pass: Pass) {
        let draws = match pass {
            Pass::OitBuild | Pass::Transparent => self.resources.far_to_near(0),
            pass => self.setup.staging.plan.draws_of(pass),
        };
        draw::record(render_pass, draws, &self.drawn(), 0);
    }

    /// Any pipeline of the plan.
    pub fn first_pipeline(&self) -> Option<&Pipeline> {
        (!self.setup.staging.plan.pipelines.is_empty()).then(|| self.resources.pipeline(0))
    }

    fn drawn(&self) -> DrawnScene<'_> {
        DrawnScene { scene: self.scene, staging: &self.setup.staging, resources: &self.resources }
    }
}
