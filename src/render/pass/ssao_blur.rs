//! The mean of the slices of 4 x 4 pixels, as far as they are of one surface.
//!
//! In: the G-buffer's depth and normal, the slices of [`ssao`](super::ssao). Out: the share of the ambient light that
//! arrives, in [0, 1], half floats, which the OCCLUDED shaders read. Cost: 16 depths, normals and shares a pixel.

use super::ssao::{FORMAT, NOT_ASKED, desc, draw, is_made, wanted};
use super::{Definition, Pass, full_screen, no_draws};
use crate::gpu::Load;
use crate::render::plan::Attachment;
use crate::shader::ShaderFile;

/// Share of the ambient light.
pub(in crate::render) const VISIBILITY: &str = "SSAO";

pub(super) const PASS: Definition = Definition {
    name: "SSAO blur",
    wanted,
    add_draws: no_draws,
    full_screen: |_| Some(desc(ShaderFile::SsaoBlurFrag)),
    attachments: |_, options| match is_made(options) {
        true => vec![Attachment::sampled(VISIBILITY, FORMAT)],
        false => Vec::new(),
    },
    optional_attachments: &[(VISIBILITY, NOT_ASKED)],
    record: |encoder, frame| {
        let Some(visibility) = frame.targets.image(VISIBILITY) else { return };
        full_screen::record(encoder, frame, Pass::SsaoBlur, visibility, Load::Discard, |pass| pass.push(&draw(frame)));
    },
};
