//! What blends goes into a linked list a pixel (order-independent transparency), which [`oit_resolve`](super::oit_resolve)
//! then sorts.
//!
//! In: vertex streams, materials, lights, environment, depth. Out: entries of the lists. Cost: every surface that blends
//! once, and an entry a fragment. Source: Yang et al. 2010, "Real-Time Concurrent Linked List Construction on the GPU".

use super::{Definition, Pass, no_attachments, no_draws, no_full_screen, opaque};

pub(super) const PASS: Definition = Definition {
    name: "OIT build",
    wanted: |plan, input| match () {
        () if !plan.draws_of(Pass::OitBuild).is_empty() => Ok(()),
        () if input.options.everything && input.options.lists_what_blends() => Ok(()),
        () if plan.blends() => Err("what blends is sorted by objects"),
        () => Err("no material blends"),
    },
    add_draws: no_draws,
    full_screen: no_full_screen,
    attachments: no_attachments,
    optional_attachments: &[],
    record: |encoder, frame| {
        opaque::record_draws(encoder, frame, Pass::OitBuild, frame.drawn.resources.far_to_near(0));
    },
};
