//! What is nearest at each pixel: depth, normal and, where it is asked for, motion.
//!
//! In: what the frame draws, blended sheer surfaces aside. Out, one sample a pixel: reversed depth (0 = nothing), and the
//! unit normal in world space as an octahedral pair (`octahedral.glsl`) with the motion since the previous frame, pixels,
//! beside it. Cost: the scene's geometry once more, the strands of fur among it, without any light.

use super::{Definition, Pass, draw, no_full_screen};
use crate::gpu::{ColorTarget, DepthTarget, Encoder, Load, RenderPassDesc, TargetFormats};
use crate::render::options::DEPTH_FORMAT;
use crate::render::plan::{Attachment, Blending, DepthCompare, DepthUse, Draw, PipelineSpec, Plan, PlanInput};
use crate::shader::Defines;
use ash::vk;

/// xy: unit normal in world space, octahedral; zw: motion, pixels, where it is asked for.
pub(in crate::render) const TEXELS: &str = "G-buffer";
/// Reversed depth, 0 where nothing is.
pub(in crate::render) const DEPTH: &str = "G-buffer depth";
const NOT_ASKED: &str = "neither layers nor screen-space occlusion were asked for";

pub(super) const PASS: Definition = Definition {
    name: "G-buffer",
    wanted: |_, input| if input.options.has_gbuffer() { Ok(()) } else { Err(NOT_ASKED) },
    add_draws,
    full_screen: no_full_screen,
    attachments: |_, options| match options.has_gbuffer() {
        true => {
            let usage = vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT | vk::ImageUsageFlags::SAMPLED;
            let depth = Attachment { name: DEPTH, format: DEPTH_FORMAT, samples: 1, usage };
            vec![Attachment::sampled(TEXELS, format(options.has_motion())), depth]
        }
        false => Vec::new(),
    },
    optional_attachments: &[(TEXELS, NOT_ASKED), (DEPTH, NOT_ASKED)],
    record: |encoder, frame| {
        let (Some(texels), Some(depth)) = (frame.targets.image(TEXELS), frame.targets.image(DEPTH)) else { return };
        let color = [ColorTarget { image: texels, load: Load::Clear([0.0; 4]), store: true, resolve: None }];
        let depth = Some(DepthTarget { image: depth, load: Load::Clear([0.0; 4]), store: true });
        let desc = RenderPassDesc { name: PASS.name, size: frame.options.size, color: &color, depth, sampled: &[] };
        record(encoder, &desc, frame);
    },
};

fn record(encoder: &mut Encoder, desc: &RenderPassDesc, frame: &super::PictureFrame) {
    encoder.render_pass(desc, |pass| draw::record(pass, frame.plan().draws_of(Pass::GBuffer), &frame.drawn, 0));
}

/// An octahedral normal, and motion beside it.
fn format(motion: bool) -> vk::Format {
    if motion { vk::Format::R32G32B32A32_SFLOAT } else { vk::Format::R32G32_SFLOAT }
}

/// What is drawn, once more.
fn add_draws(plan: &mut Plan, input: &PlanInput) {
    let options = input.options;
    // A host's frame has the motion alone.
    let motion_alone = options.picture.is_none();
    let targets = match options.target.motion_formats().filter(|_| motion_alone) {
        Some(formats) => formats,
        None if options.has_gbuffer() => TargetFormats::new([format(options.has_motion())], Some(DEPTH_FORMAT), 1),
        None => return,
    };
    let compare = if motion_alone { options.target.depth_order.into() } else { DepthCompare::Greater };
    let depth = if motion_alone { DepthUse::Test } else { DepthUse::TestAndWrite };
    let shown: Vec<Draw> = plan.shown().copied().collect();
    let mut draws = Vec::new();
    for draw in shown {
        let shown = &plan.pipelines[draw.pipeline];
        let Some(shaders) = shown.variants.and_then(|variants| variants.gbuffer) else { continue };
        let [vertex, fragment] = shaders.map(|mut key| {
            key.defines = key.defines.with(Defines::MOTION, options.has_motion());
            key
        });
        let mut constants = match targets.samples {
            1 => shown.constants_at_one_sample([vertex, fragment]),
            _ => shown.constants_of([vertex, fragment]),
        };
        if motion_alone {
            constants.push(("MOTION_ALONE", 1));
        }
        let blending = Blending::Replace;
        let spec = PipelineSpec {
            vertex,
            fragment,
            constants,
            blending,
            depth,
            compare,
            targets,
            variants: None,
            topology: shown.topology,
            eye: shown.eye,
        };
        let pipeline = plan.add_pipeline(input, draw.part, spec);
        draws.push(Draw { pipeline, ..draw });
    }
    draws.sort_by_key(|draw| draw.pipeline);
    plan.draws.insert(Pass::GBuffer, draws);
}
