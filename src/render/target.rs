//! What a frame draws into: formats, samples and the sense of depth, which pipelines are made for.

use super::RenderError;
use super::plan::DepthCompare;
use crate::gpu::{Gpu, TargetFormats};
use ash::vk;

/// Which depth is near.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum DepthOrder {
    /// 1 at the near plane, cleared to 0: precise far away.
    #[default]
    Reversed,
    /// 0 at the near plane, cleared to 1.
    Standard,
}

impl From<DepthOrder> for DepthCompare {
    fn from(order: DepthOrder) -> Self {
        match order {
            DepthOrder::Reversed => Self::Greater,
            DepthOrder::Standard => Self::Less,
        }
    }
}

/// The colour and depth that a frame is drawn into: a host's, or a picture's own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Target {
    /// Format of the colour target: takes linear, scene-referred radiance times the view's pre-exposure, premultiplied
    /// where it blends. A float format keeps highlights.
    pub color: vk::Format,
    /// Format of the depth target.
    pub depth: vk::Format,
    /// Samples a pixel of both: 1 or 4.
    pub samples: u32,
    /// Which depth is near.
    pub depth_order: DepthOrder,
    /// Format of a motion-vector target of the same samples; takes pixels from the previous frame's place to this one's,
    /// x to the right, y down, in its first two channels.
    pub motion: Option<vk::Format>,
}

impl Target {
    /// Linear half floats with reversed 32-bit depth, at that many samples.
    pub fn hdr(samples: u32) -> Self {
        Self {
            color: vk::Format::R16G16B16A16_SFLOAT,
            depth: vk::Format::D32_SFLOAT,
            samples,
            depth_order: DepthOrder::Reversed,
            motion: None,
        }
    }

    /// Formats and samples as pipelines and passes have them.
    pub fn formats(&self) -> TargetFormats {
        TargetFormats::new([self.color], Some(self.depth), self.samples)
    }

    /// The same of the pass that writes motion vectors: motion and depth.
    pub fn motion_formats(&self) -> Option<TargetFormats> {
        Some(TargetFormats::new([self.motion?], Some(self.depth), self.samples))
    }

    /// Says what the device cannot draw into.
    pub(super) fn check(&self, gpu: &Gpu) -> Result<(), RenderError> {
        let blended = vk::FormatFeatureFlags::COLOR_ATTACHMENT_BLEND;
        let drawn = vk::FormatFeatureFlags::COLOR_ATTACHMENT;
        let depth = vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT;
        let asked = [("target.color", self.color, blended), ("target.depth", self.depth, depth)];
        let motion = self.motion.map(|format| ("target.motion", format, drawn));
        for (option, format, feature) in asked.into_iter().chain(motion) {
            if !gpu.can_be_target(format, feature) {
                let kind = if feature == depth { "depth" } else { "colour" };
                let problem = format!("this device cannot draw into {format:?}; choose another {kind} format");
                return Err(RenderError::Option { option, problem });
            }
        }
        if !matches!(self.samples, 1 | 4) || !gpu.info().samples.contains(&self.samples) {
            let has: Vec<u32> = gpu.info().samples.iter().copied().filter(|count| matches!(count, 1 | 4)).collect();
            let problem = format!("{} samples a pixel; choose one of {has:?}", self.samples);
            return Err(RenderError::Option { option: "target.samples", problem });
        }
        Ok(())
    }
}
