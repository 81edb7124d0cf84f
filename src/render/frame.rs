//! One frame, from a pose to the picture, as a script.

use super::frame_data::FrameData;
use super::options::{Background, FrameOptions};
use super::pass::{deform, draws, tonemap};
use super::pipeline::PipelineSpec;
use super::plan::{Draw, Pass};
use super::resources::Resources;
use super::targets::Targets;
use super::{RenderError, Shot};
use crate::gpu::{ColorTarget, DepthTarget, Encoder, Gpu, Image, Load, RenderPassDesc, Resource};
use crate::scene::Scene;

/// Records one frame into `encoder`; `target` gets the picture.
///
/// # Errors
/// When the device is out of memory or lost.
pub fn record(
    gpu: &Gpu,
    encoder: &mut Encoder,
    scene: &Scene,
    shot: &Shot,
    options: &FrameOptions,
    resources: &mut Resources,
    targets: &Targets,
    target: &Image,
) -> Result<(), RenderError> {
    let plan = &shot.plan;
    resources.prepare(scene, plan)?;
    let data = FrameData::new(gpu, resources, scene, shot, options)?;

    if plan.passes.contains(&Pass::Deform) {
        deform::record(encoder, scene, plan, resources, &data);
    }
    let far_to_near = draws::far_to_near(&plan.transparent, scene, plan, &shot.camera);
    let mut lists: Vec<(Pass, &[Draw])> =
        vec![(Pass::Opaque, &plan.opaque), (Pass::Fur, &plan.fur), (Pass::Transparent, &far_to_near)];
    lists.retain(|(pass, _)| plan.passes.contains(pass));
    let last = lists.len() - 1;
    for (index, (pass, list)) in lists.into_iter().enumerate() {
        let (load_color, load_depth) = if index == 0 {
            (Load::Clear(clear_color(options, shot)), Load::Clear([0.0; 4]))
        } else {
            (Load::Keep, Load::Keep)
        };
        let resolve = targets.resolved.as_ref().filter(|_| index == last);
        let color = [ColorTarget { image: &targets.color, load: load_color, store: resolve.is_none(), resolve }];
        let depth = Some(DepthTarget { image: &targets.depth, load: load_depth, store: index != last });
        let desc = RenderPassDesc { name: pass.name(), size: options.size, color: &color, depth, sampled: &[] };
        encoder.render_pass(&desc, |pass| draws::record(pass, list, scene, plan, resources, &data));
    }

    let spec = PipelineSpec::tonemap(options.tonemap, options.hdr_format, target.format());
    resources.make_pipeline(&spec)?;
    let pipeline = resources.pipeline(&spec);
    let group = gpu.bind_group(pipeline, 0, "tonemap", &[("hdr", Resource::Texture(targets.hdr()))])?;
    tonemap::record(encoder, options, shot.lighting.ambient_radiance, pipeline, &group, targets.hdr(), target);
    Ok(())
}

/// Coverage starts at 0. A format without alpha cannot tell what was drawn: there the background is light.
fn clear_color(options: &FrameOptions, shot: &Shot) -> [f32; 4] {
    if options.hdr_format.has_alpha() {
        return [0.0; 4];
    }
    match options.background {
        Background::Environment => shot.lighting.ambient_radiance.extend(1.0).to_array(),
        Background::Color(color) => color.extend(1.0).to_array(),
        Background::Transparent => [0.0; 4],
    }
}
