//! All that casts shadows, into a depth map of the host's: depth alone, in the host's format and sense of depth. Fur casts by
//! the strands of its shells, what blends by its nearest surface. Cost: every caster once a map.

use super::shadow_passes::{Casting, add_casters};
use super::{Definition, Pass, no_attachments, no_full_screen};
use crate::gpu::TargetFormats;
use crate::render::plan::Blending;
use crate::shader::Defines;

pub(super) const PASS: Definition = Definition {
    name: "host shadow map",
    wanted: |_, input| match input.options.cast_into {
        Some(_) => Ok(()),
        None => Err("no host asks for it"),
    },
    add_draws: |plan, input| {
        let Some(target) = input.options.cast_into else { return };
        let casting = |is_translucent| Casting {
            pass: Pass::HostShadow,
            is_translucent,
            targets: TargetFormats::new([], Some(target.format), 1),
            blending: Blending::Replace,
            compare: target.depth_order.into(),
            defines: Defines::NONE,
        };
        add_casters(plan, input, &casting(false));
        add_casters(plan, input, &casting(true));
    },
    full_screen: no_full_screen,
    attachments: no_attachments,
    optional_attachments: &[],
    // A picture has maps of its own.
    record: |_, _| {},
};
