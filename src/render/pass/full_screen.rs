//! Passes that draw one triangle over a whole target: what each reads is named by its definition, and bound here.

use super::{Pass, PictureFrame};
use crate::gpu::{BindGroup, ColorTarget, Encoder, GpuError, Image, Load, Pipeline, RenderPass, RenderPassDesc};
use crate::render::picture::{PictureTargets, SkyboxImage};
use crate::render::plan::PipelineSpec;
use crate::render::renderer::Shared;
use std::sync::Arc;

/// A pipeline that draws one triangle over its target, and what it reads.
pub(crate) struct FullScreenDesc {
    /// The pipeline.
    pub spec: PipelineSpec,
    /// Names of its descriptors, and of the picture's images, samplers and buffers behind them
    /// ([`PictureTargets::resource`]). Those that the pipeline has not are not bound.
    pub reads: Vec<(&'static str, &'static str)>,
}

/// The same on the device; kept while the picture's targets stay.
pub(crate) struct FullScreen {
    pipeline: Arc<Pipeline>,
    groups: Vec<(u32, BindGroup)>,
    /// Images that earlier passes have written.
    images: Vec<&'static str>,
}

impl FullScreen {
    /// Makes the pipeline and binds what it reads.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub fn new(
        shared: &mut Shared,
        pass: Pass,
        FullScreenDesc { spec, reads }: &FullScreenDesc,
        targets: &PictureTargets,
        skybox: Option<&SkyboxImage>,
    ) -> Result<Self, GpuError> {
        let pipeline = shared.pipelines.graphics(spec)?;
        let read: Vec<_> = reads.iter().copied().filter(|(name, _)| spec.binds(name)).collect();
        let offered: Vec<_> =
            read.iter().filter_map(|(name, source)| Some((*name, targets.resource(source, skybox)?))).collect();
        let mut groups = Vec::new();
        for set in spec.sets() {
            groups.push((set, shared.gpu.bind_group(&pipeline, set, pass.name(), &offered)?));
        }
        let images = read.iter().map(|(_, source)| *source).filter(|source| targets.image(source).is_some()).collect();
        Ok(Self { pipeline, groups, images })
    }
}

/// Records the triangle of a pass over `written`; `record` may push its constants.
pub(super) fn record(
    encoder: &mut Encoder,
    frame: &PictureFrame,
    pass: Pass,
    written: &Image,
    load: Load,
    record: impl FnOnce(&mut RenderPass),
) {
    let Some(full_screen) = frame.targets.full_screen(pass) else { return };
    let color = [ColorTarget { image: written, load, store: true, resolve: None }];
    let sampled: Vec<&Image> = full_screen.images.iter().filter_map(|name| frame.targets.image(name)).collect();
    let size = frame.options.size;
    let desc = RenderPassDesc { name: pass.name(), size, color: &color, depth: None, sampled: &sampled };
    encoder.render_pass(&desc, |pass| {
        pass.pipeline(&full_screen.pipeline);
        for (set, group) in &full_screen.groups {
            pass.bind(*set, group);
        }
        record(pass);
        pass.draw(3, 1);
    });
}
