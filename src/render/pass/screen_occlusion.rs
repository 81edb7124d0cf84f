//! Ambient occlusion from the guide: a few slices a pixel, then the mean of each 4 x 4 pixels'.
//!
//! In: the guide's depth and normal. Out: the share of the ambient light that arrives, in [0, 1], half floats, which the
//! OCCLUDED shaders read. Cost: `2 * slices * steps` depths a pixel, and 16 depths, normals and shares for the mean.
//! Twin: `material::reference::horizon`.

use super::Frame;
use crate::gpu::{BindGroup, ColorTarget, Encoder, Gpu, GpuError, Image, Load, Pipeline, RenderPassDesc, Resource};
use crate::render::pipeline::PipelineSpec;
use crate::render::plan::Pass;
use crate::render::resources::Resources;
use crate::render::targets::{GuideTargets, OcclusionTargets};
use crate::shader::layout::ScreenOcclusionDraw;
use glam::{Mat3, Vec2};

/// The two passes, bound.
pub struct Occluders<'a> {
    targets: &'a OcclusionTargets,
    guide: &'a GuideTargets,
    pipelines: [&'a Pipeline; 2],
    groups: [BindGroup; 2],
}

impl<'a> Occluders<'a> {
    /// Binds the images.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub fn new(
        gpu: &Gpu,
        resources: &'a Resources,
        guide: &'a GuideTargets,
        targets: &'a OcclusionTargets,
    ) -> Result<Self, GpuError> {
        let pipelines = PipelineSpec::screen_occlusion().map(|spec| resources.pipeline(&spec));
        let offered = [
            ("guide", Resource::Texture(&guide.texels)),
            ("guide_depth", Resource::Texture(&guide.depth)),
            ("occlusion", Resource::Texture(&targets.slices)),
        ];
        let [slices, blur] = pipelines.map(|pipeline| gpu.bind_group(pipeline, 0, "screen occlusion", &offered));
        Ok(Self { targets, guide, pipelines, groups: [slices?, blur?] })
    }
}

/// Records the passes.
pub fn record(encoder: &mut Encoder, frame: &Frame, occluders: &Occluders) {
    let Occluders { targets, guide, pipelines, groups } = occluders;
    let draw = screen_occlusion_draw(frame);
    let read: [&[&Image]; 2] = [&[&guide.texels, &guide.depth], &[&guide.texels, &guide.depth, &targets.slices]];
    let written = [&targets.slices, &targets.visibility];
    for (index, pass) in [Pass::ScreenOcclusion, Pass::ScreenOcclusionBlur].into_iter().enumerate() {
        let color = [ColorTarget { image: written[index], load: Load::Discard, store: true, resolve: None }];
        let desc = RenderPassDesc {
            name: pass.name(),
            size: frame.options.size,
            color: &color,
            depth: None,
            sampled: read[index],
        };
        encoder.render_pass(&desc, |pass| {
            pass.pipeline(pipelines[index]);
            pass.bind(0, &groups[index]);
            pass.push(&draw);
            pass.draw(3, 1);
        });
    }
}

fn screen_occlusion_draw(frame: &Frame) -> ScreenOcclusionDraw {
    let (camera, asked) = (&frame.shot.camera, frame.options.screen_occlusion.unwrap_or_default());
    let projection = camera.clip_from_camera;
    ScreenOcclusionDraw {
        camera_from_world: Mat3::from_mat4(camera.camera_from_world).to_cols_array_2d().map(|[x, y, z]| [x, y, z, 0.0]),
        focal: Vec2::new(projection.x_axis.x, projection.y_axis.y).to_array(),
        depth: [projection.z_axis.z, projection.w_axis.z],
        orthographic: if camera.is_orthographic { 1.0 } else { 0.0 },
        radius_m: asked.radius_m(frame.shot.radius_m),
        slices: asked.slices,
        steps: asked.steps,
    }
}
