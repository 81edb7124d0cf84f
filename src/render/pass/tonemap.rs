//! Linear HDR to the picture: exposure, tone curve, background, display encoding.
//!
//! In: linear HDR colour, premultiplied, one sample. Out: display colour in the target's format; alpha is 1 or, with
//! a transparent background, the coverage (colour not premultiplied). Cost: one texel fetch a pixel, and one filtered one
//! where the environment stands behind and something of it is seen.
//! Twin: `material::reference::tonemap`.

use super::Frame;
use crate::gpu::{BindGroup, ColorTarget, Encoder, Gpu, GpuError, Image, Load, Pipeline, RenderPassDesc, Resource};
use crate::render::environment::BackdropImage;
use crate::render::options::Background;
use crate::render::plan::Pass;
use crate::shader::layout::TonemapDraw;
use glam::Vec3;

/// From where to where, and by which pipeline.
pub struct Display<'a> {
    hdr: &'a Image,
    target: &'a Image,
    pipeline: &'a Pipeline,
    backdrop: Option<&'a BackdropImage>,
    group: BindGroup,
}

impl<'a> Display<'a> {
    /// Binds the HDR image, and what stands behind where the pipeline shows it.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub fn new(
        gpu: &Gpu,
        pipeline: &'a Pipeline,
        hdr: &'a Image,
        backdrop: Option<&'a BackdropImage>,
        target: &'a Image,
    ) -> Result<Self, GpuError> {
        let mut resources = vec![("hdr", Resource::Texture(hdr))];
        if let Some(backdrop) = backdrop {
            resources.push(("backdrop", Resource::Texture(&backdrop.map)));
            resources.push(("backdrop_sampler", Resource::Sampler(&backdrop.sampler)));
        }
        let group = gpu.bind_group(pipeline, 0, "tonemap", &resources)?;
        Ok(Self { hdr, target, pipeline, backdrop, group })
    }
}

/// Records the pass.
pub fn record(encoder: &mut Encoder, frame: &Frame, display: &Display) {
    let options = frame.options;
    let mut draw = TonemapDraw {
        background: match options.background {
            Background::Environment => frame.shot.lighting.surroundings.constant_radiance().unwrap_or_default(),
            Background::Transparent => Vec3::ZERO,
            Background::Color(color) => color,
        }
        .to_array(),
        exposure: options.exposure_ev.exp2(),
        background_opacity: if options.background == Background::Transparent { 0.0 } else { 1.0 },
        background_is_light: if options.background == Background::Environment { 1.0 } else { 0.0 },
        ..Default::default()
    };
    if let Some(image) = display.backdrop {
        let backdrop = frame.shot.backdrop(options.size);
        draw.backdrop_corner = backdrop.corner.to_array();
        draw.backdrop_right = backdrop.right.to_array();
        draw.backdrop_down = backdrop.down.to_array();
        draw.backdrop_scale = image.scale * frame.shot.lighting.surroundings.strength;
    }
    let color = [ColorTarget { image: display.target, load: Load::Discard, store: true, resolve: None }];
    let sampled = [display.hdr];
    let desc = RenderPassDesc {
        name: Pass::Tonemap.name(),
        size: options.size,
        color: &color,
        depth: None,
        sampled: &sampled,
    };
    encoder.render_pass(&desc, |pass| {
        pass.pipeline(display.pipeline);
        pass.bind(0, &display.group);
        pass.push(&draw);
        pass.draw(3, 1);
    });
}
