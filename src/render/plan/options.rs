//! What a plan depends on beside what is drawn: kept, so that a frame that asks for the same keeps its plan.

use crate::material::Fur;
use crate::render::options::{HdrFormat, MAX_LAYERS, Shadows, ShellSubmission, Shells, Tonemap, Transparency};
use crate::render::picture::Aovs;
use crate::render::target::Target;
use crate::render::{CastTarget, FrameOptions};

/// How a frame is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanOptions {
    /// What it is drawn into.
    pub target: Target,
    /// Shells of fur; `None` = what each material says.
    pub layers: Option<u32>,
    /// Factor on the shells that each material says, > 0.
    pub layer_scale: f32,
    /// How shells are drawn.
    pub shells: Shells,
    /// How what blends is laid over each other.
    pub transparency: Transparency,
    /// Shadows of lights.
    pub shadows: Shadows,
    /// Something can move fur that has inertia.
    pub has_dynamics: bool,
    /// Everything that a plan can leave out is drawn all the same.
    pub everything: bool,
    /// A depth map of the host's that casters are drawn into, too.
    pub cast_into: Option<CastTarget>,
    /// Shadow maps are the host's.
    pub has_host_shadows: bool,
    /// What a picture takes beside the draws; `None` in a host's frame.
    pub picture: Option<PictureOptions>,
}

/// What a picture takes beside the draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PictureOptions {
    /// Layers kept beside the colour.
    pub aovs: Aovs,
    /// Ambient occlusion from what the screen shows.
    pub has_ssao: bool,
    /// Tone curve.
    pub tonemap: Tonemap,
    /// Format of the linear colour target.
    pub hdr_format: HdrFormat,
    /// The environment stands behind what was drawn.
    pub shows_environment: bool,
}

impl Default for PlanOptions {
    fn default() -> Self {
        FrameOptions::default().plan_options()
    }
}

impl PlanOptions {
    /// Shells of fur whose material says `layers`.
    pub fn layers_of(&self, layers: u32) -> u32 {
        self.layers.unwrap_or_else(|| (layers as f32 * self.layer_scale).round().clamp(1.0, MAX_LAYERS as f32) as u32)
    }

    /// Whether strands of this fur lag behind: they have inertia, and something can move them.
    pub fn has_dynamics(&self, fur: &Fur) -> bool {
        let moves = fur.inertia > 0.0 && self.has_dynamics;
        (moves || self.everything) && self.shells.submission != ShellSubmission::Duplicated
    }

    /// Whether what blends goes into the pixels' linked lists.
    pub fn lists_what_blends(&self) -> bool {
        self.transparency != Transparency::Sorted
    }

    /// Whether the screen's own depth hides ambient light.
    pub fn has_ssao(&self) -> bool {
        self.picture.is_some_and(|picture| picture.has_ssao)
    }

    /// Whether the frame has a G-buffer: depth, normal and motion of what is nearest.
    pub fn has_gbuffer(&self) -> bool {
        self.picture.is_some_and(|picture| picture.aovs.any() || picture.has_ssao || self.everything)
    }

    /// Whether motion since the previous frame is asked for.
    pub fn has_motion(&self) -> bool {
        self.target.motion.is_some() || self.picture.is_some_and(|picture| picture.aovs.motion)
    }
}
