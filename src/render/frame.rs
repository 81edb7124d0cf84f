//! One frame, as a script. Everything it needs has been made before; recording cannot fail.

use super::Shot;
use super::frame_data::FrameData;
use super::options::{Background, FrameOptions};
use super::pass::{deform, draws, tonemap};
use super::plan::{Draw, Pass};
use super::resources::Resources;
use super::targets::Targets;
use crate::gpu::{ColorTarget, DepthTarget, Encoder, Image, Load, RenderPassDesc};
use crate::scene::Scene;

/// What the passes of one frame share.
pub struct Frame<'a> {
    /// What is shown.
    pub scene: &'a Scene,
    /// When and through whose eye, and what it takes.
    pub shot: &'a Shot,
    /// How.
    pub options: &'a FrameOptions,
    /// What the scene keeps on the device.
    pub resources: &'a Resources,
    /// What this frame alone reads.
    pub data: &'a FrameData,
    /// HDR colour and depth.
    pub targets: &'a Targets,
    /// The picture.
    pub target: &'a Image,
}

impl Frame<'_> {
    /// Records all passes.
    pub fn record(&self, encoder: &mut Encoder) {
        let plan = &self.shot.plan;
        if plan.passes.contains(&Pass::Deform) {
            deform::record(encoder, self);
        }
        let far_to_near = draws::far_to_near(&plan.transparent, self);
        let lists: [(Pass, &[Draw]); 3] =
            [(Pass::Opaque, &plan.opaque), (Pass::Fur, &plan.fur), (Pass::Transparent, &far_to_near)];
        let last = plan.passes.iter().rfind(|pass| **pass != Pass::Tonemap);
        for (pass, list) in lists.into_iter().filter(|(pass, _)| plan.passes.contains(pass)) {
            self.draw_pass(encoder, pass, list, last == Some(&pass));
        }
        tonemap::record(encoder, self);
    }

    /// The first pass clears, the last one resolves; those between keep what there is.
    fn draw_pass(&self, encoder: &mut Encoder, pass: Pass, list: &[Draw], is_last: bool) {
        let is_first = pass == Pass::Opaque;
        let resolve = self.targets.resolved.as_ref().filter(|_| is_last);
        let color = [ColorTarget {
            image: &self.targets.color,
            load: if is_first { Load::Clear(self.clear_color()) } else { Load::Keep },
            store: resolve.is_none(),
            resolve,
        }];
        let depth = Some(DepthTarget {
            image: &self.targets.depth,
            // Depth is reversed: 0 is infinitely far.
            load: if is_first { Load::Clear([0.0; 4]) } else { Load::Keep },
            store: !is_last,
        });
        let desc = RenderPassDesc { name: pass.name(), size: self.options.size, color: &color, depth, sampled: &[] };
        encoder.render_pass(&desc, |pass| draws::record(pass, list, self));
    }

    /// Coverage starts at 0. A format without alpha cannot tell what was drawn: there the background is light.
    fn clear_color(&self) -> [f32; 4] {
        match self.options.background {
            _ if self.options.hdr_format.has_alpha() => [0.0; 4],
            Background::Environment => self.shot.lighting.ambient_radiance.extend(1.0).to_array(),
            Background::Color(color) => color.extend(1.0).to_array(),
            Background::Transparent => [0.0; 4],
        }
    }
}
