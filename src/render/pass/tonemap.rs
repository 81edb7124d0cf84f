//! Linear HDR to the picture: exposure, tone curve, background, display encoding.
//!
//! In: linear HDR colour, premultiplied, one sample. Out: display colour in the target's format; alpha is 1 or, with
//! a transparent background, the coverage (colour not premultiplied). Cost: one texel fetch a pixel.
//! Twin: `material::reference::tonemap`.

use crate::gpu::{ColorTarget, Encoder, Load, RenderPassDesc};
use crate::render::frame::Frame;
use crate::render::options::Background;
use crate::render::plan::Pass;
use crate::shader::layout::TonemapDraw;
use glam::Vec3;

/// Records the pass.
pub fn record(encoder: &mut Encoder, frame: &Frame) {
    let options = frame.options;
    let draw = TonemapDraw {
        background: match options.background {
            Background::Environment => frame.shot.lighting.ambient_radiance,
            Background::Transparent => Vec3::ZERO,
            Background::Color(color) => color,
        }
        .to_array(),
        exposure: options.exposure_ev.exp2(),
        background_opacity: if options.background == Background::Transparent { 0.0 } else { 1.0 },
        background_is_light: if options.background == Background::Environment { 1.0 } else { 0.0 },
        ..Default::default()
    };
    let color = [ColorTarget { image: frame.target, load: Load::Discard, store: true, resolve: None }];
    let sampled = [frame.targets.hdr()];
    let desc = RenderPassDesc {
        name: Pass::Tonemap.name(),
        size: options.size,
        color: &color,
        depth: None,
        sampled: &sampled,
    };
    encoder.render_pass(&desc, |pass| {
        pass.pipeline(frame.resources.pipeline(&frame.data.tonemap));
        pass.bind(0, &frame.data.tonemap_group);
        pass.push(&draw);
        pass.draw(3, 1);
    });
}
