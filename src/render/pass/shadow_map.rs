//! The nearest opaque surfaces, as lights see them: reversed depth (D32F). Cost: every opaque caster once a map.

use super::shadow_passes::{self, Casting, add_casters, wanted};
use super::{Definition, Pass, no_attachments, no_full_screen};
use crate::gpu::{Encoder, TargetFormats};
use crate::render::device_scene::DrawnScene;
use crate::render::options::DEPTH_FORMAT;
use crate::render::plan::{Blending, DepthCompare};
use crate::shader::Defines;

pub(super) const PASS: Definition = Definition {
    name: "shadow map",
    wanted,
    add_draws: |plan, input| {
        let casting = Casting {
            pass: Pass::ShadowMap,
            is_translucent: false,
            targets: TargetFormats::new([], Some(DEPTH_FORMAT), 1),
            blending: Blending::Replace,
            compare: DepthCompare::Greater,
            defines: Defines::NONE,
        };
        add_casters(plan, input, &casting);
    },
    full_screen: no_full_screen,
    attachments: no_attachments,
    optional_attachments: &[],
    record: |encoder, frame| record(encoder, &frame.drawn),
};

/// Records the pass, where the plan has it.
pub fn record(encoder: &mut Encoder, drawn: &DrawnScene) {
    // Depth is reversed: 0 is the farthest there is.
    shadow_passes::record(encoder, drawn, Pass::ShadowMap, Some((0, 0.0)), &[], &[]);
}
