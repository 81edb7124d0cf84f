//! How much light all translucent surfaces let through, two sums (RGBA16F): optical depth up to four knots between the
//! first and the last of them, and the whole by channel. Cost: every translucent caster once a map.

use super::shadow_passes::{self, Casting, add_casters, wanted_translucent};
use super::{Definition, Pass, no_attachments, no_full_screen};
use crate::gpu::{Encoder, TargetFormats};
use crate::render::device_scene::DrawnScene;
use crate::render::light::TRANSMITTANCE_FORMAT;
use crate::render::plan::{Blending, DepthCompare};
use crate::shader::Defines;

pub(super) const PASS: Definition = Definition {
    name: "translucent shadow transmittance",
    wanted: wanted_translucent,
    add_draws: |plan, input| {
        let casting = Casting {
            pass: Pass::TranslucentShadowTransmittance,
            is_translucent: true,
            targets: TargetFormats::new([TRANSMITTANCE_FORMAT; 2], None, 1),
            blending: Blending::Sum,
            compare: DepthCompare::Greater,
            defines: Defines::LAYERS,
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
    shadow_passes::record(encoder, drawn, Pass::TranslucentShadowTransmittance, None, &[3, 4], &[1, 2]);
}
