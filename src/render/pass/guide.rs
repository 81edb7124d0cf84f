//! What is nearest at each pixel: depth, normal and, where it is asked for, motion.
//!
//! In: what the frame draws, blended gauze aside. Out, one sample a pixel: reversed depth (0 = nothing), and the unit
//! normal in world space as an octahedral pair (`octahedral.glsl`) with the motion since the previous frame, pixels, beside
//! it. Cost: the scene's geometry once more, coats' strands among it, without any light.

use super::{Frame, draws};
use crate::gpu::{ColorTarget, DepthTarget, Encoder, Load, RenderPassDesc};
use crate::render::plan::Pass;
use crate::render::targets::GuideTargets;

/// Records the pass.
pub fn record(encoder: &mut Encoder, frame: &Frame, targets: &GuideTargets) {
    let color = [ColorTarget { image: &targets.texels, load: Load::Clear([0.0; 4]), store: true, resolve: None }];
    let depth = Some(DepthTarget { image: &targets.depth, load: Load::Clear([0.0; 4]), store: true });
    let desc =
        RenderPassDesc { name: Pass::Guide.name(), size: frame.options.size, color: &color, depth, sampled: &[] };
    encoder.render_pass(&desc, |pass| draws::record(pass, &frame.shot.plan.guide, frame, 0));
}
