//! Screen-space ambient occlusion from the G-buffer: a few slices of the hemisphere a pixel ([`ssao_blur`](super::ssao_blur)
//! then takes their mean).
//!
//! In: the G-buffer's depth and normal. Out: the share of the ambient light that arrives, in [0, 1], half floats. Cost:
//! `2 * slices * steps` depths a pixel. Source: Jimenez et al. 2016, "Practical Realtime Strategies for Accurate Indirect
//! Occlusion" (`horizon.glsl`).

use super::full_screen::{self, FullScreenDesc};
use super::{Definition, Pass, PictureFrame, gbuffer, no_draws};
use crate::gpu::Load;
use crate::render::RenderError;
use crate::render::plan::{Attachment, PipelineSpec, Plan, PlanInput, PlanOptions};
use crate::shader::layout::SsaoDraw;
use crate::shader::{Defines, ShaderFile, ShaderKey};
use ash::vk;
use glam::{Mat3, Vec2};

/// Share of the ambient light, of a pixel's own slices.
pub(super) const SLICES: &str = "SSAO slices";
/// Share of the ambient light.
pub(super) const FORMAT: vk::Format = vk::Format::R16_SFLOAT;
pub(in crate::render) const NOT_ASKED: &str = "screen-space occlusion was not asked for";

pub(super) const PASS: Definition = Definition {
    name: "SSAO",
    wanted,
    add_draws: no_draws,
    full_screen: |_| Some(desc(ShaderFile::SsaoFrag)),
    attachments: |_, options| match is_made(options) {
        true => vec![Attachment::sampled(SLICES, FORMAT)],
        false => Vec::new(),
    },
    optional_attachments: &[(SLICES, NOT_ASKED)],
    record: |encoder, frame| {
        let Some(slices) = frame.targets.image(SLICES) else { return };
        full_screen::record(encoder, frame, Pass::Ssao, slices, Load::Discard, |pass| pass.push(&draw(frame)));
    },
};

/// The pipeline of one of the two passes, and what it reads.
pub(super) fn desc(file: ShaderFile) -> FullScreenDesc {
    let spec = PipelineSpec::full_screen(ShaderKey::new(file, Defines::NONE), Vec::new(), FORMAT);
    let reads = vec![("gbuffer", gbuffer::TEXELS), ("gbuffer_depth", gbuffer::DEPTH), ("occlusion", SLICES)];
    FullScreenDesc { spec, reads }
}

/// Whether a picture's frame has it.
pub(super) fn wanted(_: &Plan, input: &PlanInput) -> Result<(), &'static str> {
    if is_made(input.options) { Ok(()) } else { Err(NOT_ASKED) }
}

pub(super) fn is_made(options: &PlanOptions) -> bool {
    options.picture.is_some_and(|picture| picture.has_ssao || options.everything)
}

pub(super) fn draw(frame: &PictureFrame) -> SsaoDraw {
    let (camera, asked) = (&frame.setup.camera, frame.options.screen_occlusion.unwrap_or_default());
    let projection = camera.clip_from_camera;
    SsaoDraw {
        camera_from_world: Mat3::from_mat4(camera.camera_from_world).to_cols_array_2d().map(|[x, y, z]| [x, y, z, 0.0]),
        focal: Vec2::new(projection.x_axis.x, projection.y_axis.y).to_array(),
        depth: [projection.z_axis.z, projection.w_axis.z],
        orthographic: if camera.is_orthographic { 1.0 } else { 0.0 },
        radius_m: asked.radius_m(frame.setup.radius_m),
        slices: asked.slices,
        steps: asked.steps,
    }
}

/// Most slices and most steps.
pub const MAX_OCCLUSION_SAMPLES: u32 = 64;

/// What occludes, where nobody says: a share of the scene's bounding radius.
const RADIUS_SHARE: f32 = 0.15;

/// Ambient light that what stands around hides, found from the depths on the screen (`horizon.glsl`).
///
/// What the picture does not show hides nothing: what lies outside it, or behind something nearer. A frame pays for the
/// G-buffer, `2 * slices * steps` look-ups a pixel, and 16 more for the blur.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScreenOcclusion {
    /// Nothing beyond hides anything, metres, > 0; what is nearer hides by 1 - (distance / radius)^2. `None`: 15 % of the
    /// scene's bounding radius.
    pub radius_m: Option<f32>,
    /// Slices of the hemisphere a pixel, 1 to 64; a blur takes those of 4 x 4 pixels together.
    pub slices: u32,
    /// Samples a side of a slice, 1 to 64.
    pub steps: u32,
}

impl Default for ScreenOcclusion {
    fn default() -> Self {
        Self { radius_m: None, slices: 2, steps: 6 }
    }
}

impl ScreenOcclusion {
    /// The radius in a scene of a bounding radius, metres.
    pub fn radius_m(&self, scene_radius_m: f32) -> f32 {
        self.radius_m.unwrap_or(RADIUS_SHARE * scene_radius_m).max(f32::MIN_POSITIVE)
    }

    pub(in crate::render) fn check(&self) -> Result<(), RenderError> {
        let wrong = |problem| Err(RenderError::Option { option: "screen occlusion", problem });
        let is_count = |count| (1..=MAX_OCCLUSION_SAMPLES).contains(&count);
        if !is_count(self.slices) || !is_count(self.steps) {
            return wrong(format!("slices and steps must be 1 to {MAX_OCCLUSION_SAMPLES}"));
        }
        if self.radius_m.is_some_and(|radius_m| !(radius_m > 0.0 && radius_m.is_finite())) {
            return wrong("the radius must be a finite number of metres greater than 0".to_owned());
        }
        Ok(())
    }
}
