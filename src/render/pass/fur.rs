//! Shells of fur that does not blend.
//!
//! In: vertex streams, fur materials, lights, environment. Out: linear HDR colour and depth over those of the opaque pass.
//! Cost: every shell once. Source: Lengyel et al. 2001, "Real-Time Fur over Arbitrary Surfaces".

use super::{Definition, Pass, no_attachments, no_draws, no_full_screen, opaque};

pub(super) const PASS: Definition = Definition {
    name: "fur",
    wanted: |plan, input| match () {
        () if !plan.draws_of(Pass::Fur).is_empty() || input.options.everything => Ok(()),
        () if plan.has_fur() => Err("all fur blends"),
        () => Err("no triangles have a material with fur"),
    },
    add_draws: no_draws,
    full_screen: no_full_screen,
    attachments: no_attachments,
    optional_attachments: &[],
    record: |encoder, frame| opaque::record_draws(encoder, frame, Pass::Fur, frame.plan().draws_of(Pass::Fur)),
};
