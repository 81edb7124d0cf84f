//! Opaque and masked surfaces.
//!
//! In: vertex streams, materials, lights, environment. Out: linear HDR colour and depth of all samples, which this pass
//! clears; then what follows keeps them. Cost: every surface once, and each light that reaches it.

use super::oit_resolve::LIST_SET;
use super::ssao_blur::VISIBILITY;
use super::{Definition, Pass, PictureFrame, draw, no_full_screen};
use crate::gpu::{ColorTarget, DepthTarget, Encoder, Image, Load, RenderPassDesc};
use crate::render::options::{Background, DEPTH_FORMAT};
use crate::render::plan::{Attachment, Draw, Plan, PlanOptions};
use ash::vk;

/// Linear HDR colour at the samples asked for.
pub(in crate::render) const COLOR: &str = "hdr color";
/// The same at one sample, and with all that blends.
pub(in crate::render) const RESOLVED: &str = "hdr color resolved";
/// Reversed depth.
pub(in crate::render) const DEPTH: &str = "depth";

pub(super) const PASS: Definition = Definition {
    name: "opaque",
    wanted: |_, _| Ok(()),
    // One pipeline after another: state changes cost more than order saves among opaque surfaces.
    add_draws: |plan, _| plan.draws.entry(Pass::Opaque).or_default().sort_by_key(|draw| draw.pipeline),
    full_screen: no_full_screen,
    attachments,
    optional_attachments: &[(RESOLVED, "one sample a pixel was asked for")],
    record: |encoder, frame| record_draws(encoder, frame, Pass::Opaque, frame.plan().draws_of(Pass::Opaque)),
};

/// Colour and depth at the samples asked for, and colour at one sample with all that blends.
fn attachments(plan: &Plan, options: &PlanOptions) -> Vec<Attachment> {
    if options.picture.is_none() {
        return Vec::new();
    }
    let (samples, format) = (options.target.samples, options.target.color);
    let lists = plan.builds_lists();
    let [color, depth] = [vk::ImageUsageFlags::COLOR_ATTACHMENT, vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT];
    let sampled = |usage, holds| if holds { usage | vk::ImageUsageFlags::SAMPLED } else { usage };
    let resolved = (samples > 1 || lists).then(|| Attachment::sampled(RESOLVED, format));
    let color = Attachment { name: COLOR, format, samples, usage: sampled(color, samples == 1 || lists) };
    // Lists ask it, sample by sample, what is hidden.
    let usage = sampled(depth, samples > 1 && lists);
    let depth = Attachment { name: DEPTH, format: DEPTH_FORMAT, samples, usage };
    [Some(color), resolved, Some(depth)].into_iter().flatten().collect()
}

/// Records one of the passes that draw what the camera sees: the first clears, the last one resolves, those between keep
/// what there is.
pub(super) fn record_draws(encoder: &mut Encoder, frame: &PictureFrame, pass: Pass, draws: &[Draw]) {
    let targets = frame.targets;
    let (Some(color), Some(depth)) = (targets.color(), targets.depth()) else { return };
    let later = [Pass::Fur, Pass::OitBuild, Pass::Transparent].into_iter().filter(|later| *later > pass);
    let is_last = !later.into_iter().any(|later| frame.plan().passes.contains(&later));
    let is_first = pass == Pass::Opaque;
    // One sample is resolved by composing alone.
    let resolve = targets.resolved().filter(|_| is_last && frame.options.msaa > 1);
    let color = [ColorTarget {
        image: color,
        load: if is_first { Load::Clear(clear_color(frame)) } else { Load::Keep },
        store: resolve.is_none() || targets.lists.is_some(),
        resolve,
    }];
    let depth = Some(DepthTarget {
        image: depth,
        // Depth is reversed: 0 is infinitely far.
        load: if is_first { Load::Clear([0.0; 4]) } else { Load::Keep },
        store: !is_last || targets.lists.is_some(),
    });
    let atlas = frame.drawn.resources.shadow_atlas().into_iter().flat_map(|atlas| &atlas.images);
    let sampled: Vec<&Image> = targets.image(VISIBILITY).into_iter().chain(atlas).collect();
    let desc = RenderPassDesc { name: pass.name(), size: frame.options.size, color: &color, depth, sampled: &sampled };
    encoder.render_pass(&desc, |pass| {
        if let Some((_, building)) = &targets.lists {
            pass.bind(LIST_SET, building);
        }
        draw::record(pass, draws, &frame.drawn, 0);
    });
}

/// Coverage starts at 0. A format without alpha cannot tell what was drawn: there the background is light.
fn clear_color(frame: &PictureFrame) -> [f32; 4] {
    match frame.options.background {
        _ if frame.options.hdr_format.has_alpha() => [0.0; 4],
        Background::Environment => {
            let constant = frame.options.environment.constant_radiance();
            let mean = || frame.drawn.resources.mean_radiance();
            constant.unwrap_or_else(mean).extend(1.0).to_array()
        }
        Background::Color(color) => color.extend(1.0).to_array(),
        Background::Transparent => [0.0; 4],
    }
}
