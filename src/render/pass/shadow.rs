//! Shadow maps, all in one atlas: what each light sees.
//!
//! In: vertex streams, the materials' masks and opacities, one view a map. Out: reversed depth of the nearest opaque
//! surface (D32F); where something lets light through in part, also that of the first and of the last translucent
//! surface, and two sums over all of them (RGBA16F): optical depth up to four knots between the two, and the whole by
//! channel. Cost: every caster once a map, translucent ones three times.
//! Sources: Williams 1978, "Casting Curved Shadows on Curved Surfaces"; Yuksel & Keyser 2008, "Deep Opacity Maps".
//! Twin: `material::reference::shadow`.

use super::{Frame, draws};
use crate::gpu::{ColorTarget, DepthTarget, Encoder, Load, RenderPassDesc};
use crate::render::plan::{Draw, Pass};
use crate::render::shadow::ShadowAtlas;

/// Records those passes that the plan lists.
pub fn record(encoder: &mut Encoder, frame: &Frame, atlas: &ShadowAtlas) {
    let plan = &frame.shot.plan;
    for (pass, list) in plan.shadows.lists() {
        if plan.passes.contains(&pass) {
            record_pass(encoder, frame, atlas, pass, list);
        }
    }
}

fn record_pass(encoder: &mut Encoder, frame: &Frame, atlas: &ShadowAtlas, pass: Pass, list: &[Draw]) {
    // Depth is reversed: 0 is the farthest there is.
    let depth = |index: usize, clear: f32| {
        let image = atlas.images.get(index)?;
        Some(DepthTarget { image, load: Load::Clear([clear; 4]), store: true })
    };
    let (depth, colors, sampled) = match pass {
        Pass::ShadowFront => (depth(1, 0.0), 0..0, 0..0),
        Pass::ShadowBack => (depth(2, 1.0), 0..0, 0..0),
        Pass::ShadowLayers => (None, 3..5, 1..3),
        _ => (depth(0, 0.0), 0..0, 0..0),
    };
    let target = |image| ColorTarget { image, load: Load::Clear([0.0; 4]), store: true, resolve: None };
    let color: Vec<_> = atlas.images.get(colors).into_iter().flatten().map(target).collect();
    let sampled: Vec<_> = atlas.images.get(sampled).into_iter().flatten().collect();
    let plan = &frame.shot.plan;
    let desc = RenderPassDesc { name: pass.name(), size: plan.shadows.size(), color: &color, depth, sampled: &sampled };
    encoder.render_pass(&desc, |pass| {
        for (index, map) in plan.shadows.maps.iter().enumerate() {
            pass.viewport(plan.shadows.origin(index), [plan.shadows.resolution_px; 2]);
            // What a light does not reach stands between it and nothing that it does reach.
            let reached = list.iter().filter(|draw| plan.lights.of(draw.instance).contains(&map.light));
            draws::record(pass, &reached.copied().collect::<Vec<_>>(), frame, index + 1);
        }
    });
}
