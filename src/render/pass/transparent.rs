//! What blends, over what was drawn before: from far to near, as objects are sorted. What passes is dimmed, not tinted.
//!
//! In: vertex streams, materials, lights, environment. Out: linear HDR colour, premultiplied, over what there is.

use super::{Definition, Pass, no_attachments, no_draws, no_full_screen, opaque};

pub(super) const PASS: Definition = Definition {
    name: "transparent",
    wanted: |plan, _| match () {
        () if !plan.draws_of(Pass::Transparent).is_empty() => Ok(()),
        () if plan.blends() => Err("what blends is sorted by pixels"),
        () => Err("no material blends"),
    },
    add_draws: no_draws,
    full_screen: no_full_screen,
    attachments: no_attachments,
    optional_attachments: &[],
    record: |encoder, frame| {
        opaque::record_draws(encoder, frame, Pass::Transparent, frame.drawn.resources.far_to_near(0));
    },
};
