//! One frame, as a script. Everything it needs has been made before; recording cannot fail.

use super::options::Background;
use super::pass::{Frame, Moving, deform, draws, sway, tonemap};
use super::plan::{Draw, Pass};
use crate::gpu::{ColorTarget, DepthTarget, Encoder, Load, RenderPassDesc};

/// Records all passes of `frame`.
pub fn record(encoder: &mut Encoder, frame: &Frame) {
    let plan = &frame.shot.plan;
    let Frame { scene, shot, resources, motion, .. } = *frame;
    record_motion(encoder, &Moving { scene, shot, resources, motion });
    let far_to_near = draws::far_to_near(&plan.transparent, frame);
    let lists: [(Pass, &[Draw]); 3] =
        [(Pass::Opaque, &plan.opaque), (Pass::Fur, &plan.fur), (Pass::Transparent, &far_to_near)];
    let last = plan.passes.iter().rfind(|pass| **pass != Pass::Tonemap);
    for (pass, list) in lists.into_iter().filter(|(pass, _)| plan.passes.contains(pass)) {
        record_draws(encoder, frame, pass, list, last == Some(&pass));
    }
    tonemap::record(encoder, frame);
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
fn record_draws(encoder: &mut Encoder, frame: &Frame, pass: Pass, list: &[Draw], is_last: bool) {
    let targets = frame.targets;
    let is_first = pass == Pass::Opaque;
    let resolve = targets.resolved.as_ref().filter(|_| is_last);
    let color = [ColorTarget {
        image: &targets.color,
        load: if is_first { Load::Clear(clear_color(frame)) } else { Load::Keep },
        store: resolve.is_none(),
        resolve,
    }];
    let depth = Some(DepthTarget {
        image: &targets.depth,
        // Depth is reversed: 0 is infinitely far.
        load: if is_first { Load::Clear([0.0; 4]) } else { Load::Keep },
        store: !is_last,
    });
    let desc = RenderPassDesc { name: pass.name(), size: frame.options.size, color: &color, depth, sampled: &[] };
    encoder.render_pass(&desc, |pass| draws::record(pass, list, frame));
}

/// Coverage starts at 0. A format without alpha cannot tell what was drawn: there the background is light.
fn clear_color(frame: &Frame) -> [f32; 4] {
    match frame.options.background {
        _ if frame.options.hdr_format.has_alpha() => [0.0; 4],
        Background::Environment => frame.shot.lighting.ambient_radiance.extend(1.0).to_array(),
        Background::Color(color) => color.extend(1.0).to_array(),
        Background::Transparent => [0.0; 4],
    }
}
