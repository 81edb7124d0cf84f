//! The last translucent surfaces, as lights see them: reversed depth (D32F). Cost: every translucent caster once a map.

use super::shadow_passes::{self, Casting, add_casters, wanted_translucent};
use super::{Definition, Pass, no_attachments, no_full_screen};
use crate::gpu::{Encoder, TargetFormats};
use crate::render::device_scene::DrawnScene;
use crate::render::options::DEPTH_FORMAT;
use crate::render::plan::{Blending, DepthCompare};
use crate::shader::Defines;

pub(super) const PASS: Definition = Definition {
    name: "translucent shadow back",
    wanted: wanted_translucent,
    add_draws: |plan, input| {
        let casting = Casting {
            pass: Pass::TranslucentShadowBack,
            is_translucent: true,
            targets: TargetFormats::new([], Some(DEPTH_FORMAT), 1),
            blending: Blending::Replace,
            compare: DepthCompare::Less,
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
    shadow_passes::record(encoder, drawn, Pass::TranslucentShadowBack, Some((2, 1.0)), &[], &[]);
}
