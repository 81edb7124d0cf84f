//! One frame, as a script. Everything it needs has been made before; recording cannot fail.

use super::options::Background;
use super::pass::screen_occlusion::Occluders;
use super::pass::{Frame, Moving, deform, draws, guide, order, screen_occlusion, shadow, sway, tonemap, transparency};
use super::plan::{Draw, Pass};
use super::targets::Targets;
use crate::gpu::{ColorTarget, DepthTarget, Encoder, Image, Load, RenderPassDesc};
use std::borrow::Cow;

/// Records all passes of `frame`.
pub fn record(
    encoder: &mut Encoder,
    frame: &Frame,
    targets: &Targets,
    occluders: Option<&Occluders>,
    display: &tonemap::Display,
) {
    record_motion(encoder, &frame.moving());
    if let Some(targets) = &targets.guide {
        guide::record(encoder, frame, targets);
    }
    if let Some(occluders) = occluders {
        screen_occlusion::record(encoder, frame, occluders);
    }
    if let Some(atlas) = frame.atlas {
        shadow::record(encoder, frame, atlas);
    }
    if let Some(composition) = frame.composition {
        transparency::clear(encoder, composition);
    }
    let lists = draw_lists(frame);
    for (index, (pass, list)) in lists.iter().enumerate() {
        record_draws(encoder, frame, targets, *pass, list, index + 1 == lists.len());
    }
    if let Some(composition) = frame.composition {
        transparency::record(encoder, frame, targets, composition);
    }
    tonemap::record(encoder, frame, display);
}

/// The passes that draw the scene, in order, and what they draw.
pub fn draw_lists<'a>(frame: &Frame<'a>) -> Vec<(Pass, Cow<'a, [Draw]>)> {
    let plan = &frame.shot.plan;
    let far_to_near = order::far_to_near(&plan.transparent, frame);
    let lists = [
        (Pass::Opaque, Cow::from(&plan.opaque)),
        (Pass::Fur, Cow::from(&plan.fur)),
        (Pass::Transparent, Cow::from(far_to_near)),
    ];
    lists.into_iter().filter(|(pass, _)| plan.passes.contains(pass)).collect()
}

/// Records what moves vertices, without anything that is drawn.
pub fn record_motion(encoder: &mut Encoder, moving: &Moving) {
    if !moving.shot.plan.deforms.is_empty() {
        deform::record(encoder, moving);
    }
    if !moving.shot.plan.sways.is_empty() {
        sway::record(encoder, moving);
    }
}

/// The first pass clears, the last one resolves; those between keep what there is.
fn record_draws(encoder: &mut Encoder, frame: &Frame, targets: &Targets, pass: Pass, list: &[Draw], is_last: bool) {
    let is_first = pass == Pass::Opaque;
    // One sample is resolved by composing alone.
    let resolve = targets.resolved.as_ref().filter(|_| is_last && frame.options.msaa > 1);
    let color = [ColorTarget {
        image: &targets.color,
        load: if is_first { Load::Clear(clear_color(frame)) } else { Load::Keep },
        store: resolve.is_none() || frame.composition.is_some(),
        resolve,
    }];
    let depth = Some(DepthTarget {
        image: &targets.depth,
        // Depth is reversed: 0 is infinitely far.
        load: if is_first { Load::Clear([0.0; 4]) } else { Load::Keep },
        store: !is_last || frame.composition.is_some(),
    });
    let occlusion = targets.occlusion.iter().map(|occlusion| &occlusion.visibility);
    let sampled: Vec<&Image> = occlusion.chain(frame.atlas.iter().flat_map(|atlas| &atlas.images)).collect();
    let desc = RenderPassDesc { name: pass.name(), size: frame.options.size, color: &color, depth, sampled: &sampled };
    encoder.render_pass(&desc, |pass| {
        if let Some(composition) = frame.composition {
            pass.bind(transparency::LIST_SET, composition.appending());
        }
        draws::record(pass, list, frame, 0);
    });
}

/// Coverage starts at 0. A format without alpha cannot tell what was drawn: there the background is light.
fn clear_color(frame: &Frame) -> [f32; 4] {
    match frame.options.background {
        _ if frame.options.hdr_format.has_alpha() => [0.0; 4],
        Background::Environment => {
            let constant = frame.shot.lighting.surroundings.constant_radiance();
            constant.unwrap_or(frame.data.mean_radiance).extend(1.0).to_array()
        }
        Background::Color(color) => color.extend(1.0).to_array(),
        Background::Transparent => [0.0; 4],
    }
}
