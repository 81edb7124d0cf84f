//! Linear HDR to the picture: exposure, tone curve, background, display encoding.
//!
//! In: linear HDR colour, premultiplied, one sample. Out: display colour in the target's format; alpha is 1 or, with
//! a transparent background, the coverage (colour not premultiplied). Cost: one texel fetch a pixel, and one filtered one
//! where the environment stands behind and something of it is seen.

use super::full_screen::{self, FullScreenDesc};
use super::{Definition, Pass, PictureFrame, no_attachments, no_draws};
use crate::gpu::Load;
use crate::render::options::{Background, HdrFormat};
use crate::render::picture::{HDR, PICTURE_FORMAT, SKYBOX, SKYBOX_SAMPLER, Skybox};
use crate::render::plan::{PictureOptions, PipelineSpec};
use crate::shader::layout::ToneMappingDraw;
use crate::shader::{Defines, ShaderFile, ShaderKey};
use ash::vk;
use glam::Vec3;

pub(super) const PASS: Definition = Definition {
    name: "tone mapping",
    wanted: |_, input| if input.options.picture.is_some() { Ok(()) } else { Err("it is the host's") },
    add_draws: no_draws,
    full_screen: |options| options.picture.as_ref().map(desc),
    attachments: no_attachments,
    optional_attachments: &[],
    record: |encoder, frame| {
        let draw = draw(frame);
        full_screen::record(encoder, frame, Pass::ToneMapping, frame.display, Load::Discard, |pass| pass.push(&draw));
    },
};

/// The pipeline that makes display colour from the HDR image, and what it reads.
fn desc(picture: &PictureOptions) -> FullScreenDesc {
    let defines = Defines::NONE.with(Defines::SKYBOX, picture.shows_environment);
    let constants = vec![
        ("OPERATOR", picture.tonemap.operator()),
        ("ENCODE_SRGB", u32::from(!is_srgb(PICTURE_FORMAT))),
        ("HAS_ALPHA", u32::from(picture.hdr_format == HdrFormat::Rgba16f)),
    ];
    let fragment = ShaderKey::new(ShaderFile::ToneMappingFrag, defines);
    let spec = PipelineSpec::full_screen(fragment, constants, PICTURE_FORMAT);
    let reads = vec![("hdr", HDR), ("skybox", SKYBOX), ("skybox_sampler", SKYBOX_SAMPLER)];
    FullScreenDesc { spec, reads }
}

fn draw(frame: &PictureFrame) -> ToneMappingDraw {
    let options = frame.options;
    let is_environment = options.background == Background::Environment;
    let background = match options.background {
        Background::Environment => options.environment.constant_radiance().unwrap_or_default(),
        Background::Transparent => Vec3::ZERO,
        Background::Color(color) => color,
    };
    let (mut scale, mut rays) = (0.0, [Vec3::ZERO; 3]);
    if let Some(image) = frame.skybox {
        let skybox = Skybox::new(&options.environment, &frame.setup.camera, options.size);
        scale = image.scale * options.environment.strength;
        rays = [skybox.corner, skybox.right, skybox.down];
    }
    let [corner, right, down] = rays.map(|ray| ray.to_array());
    ToneMappingDraw {
        background: background.to_array(),
        exposure: options.exposure_ev.exp2(),
        background_opacity: if options.background == Background::Transparent { 0.0 } else { 1.0 },
        background_is_light: if is_environment { 1.0 } else { 0.0 },
        skybox_scale: scale,
        _reserved_1: 0.0,
        skybox_corner: corner,
        _reserved_2: 0.0,
        skybox_right: right,
        _reserved_3: 0.0,
        skybox_down: down,
        _reserved_4: 0.0,
    }
}

fn is_srgb(format: vk::Format) -> bool {
    matches!(format, vk::Format::R8G8B8A8_SRGB | vk::Format::B8G8R8A8_SRGB)
}
