//! The draws of every pass that draws the scene: surfaces and shells.
//!
//! In: vertex streams, materials, frame data. Shells are one instanced draw a part: the layer comes from the instance
//! index, outermost first. To measure against, they can be a draw each, or vertices of their own in one draw. What lies
//! beside a view is not drawn.

use crate::gpu::RenderPass;
use crate::render::device_scene::DrawnScene;
use crate::render::options::ShellSubmission;
use crate::render::plan::{Draw, DrawKind, Faces};
use crate::scene::Side;
use crate::shader::layout::ObjectDraw;
use ash::vk::{CullModeFlags, FrontFace};

/// Descriptor set of view and lights.
pub const FRAME_SET: u32 = 0;
/// Descriptor set of the material.
pub const MATERIAL_SET: u32 = 1;
/// Descriptor set of where objects stand.
pub const OBJECT_SET: u32 = 2;

/// Records draws in their order, as a view sees them.
pub fn record(pass: &mut RenderPass, draws: &[Draw], drawn: &DrawnScene, view: usize) {
    record_where(pass, draws, drawn, view, |_| true);
}

/// The same of those draws alone that a light reaches.
pub fn record_reached(pass: &mut RenderPass, draws: &[Draw], drawn: &DrawnScene, view: usize, light: usize) {
    record_where(pass, draws, drawn, view, |draw| drawn.staging.light_lists.of(draw.part).contains(&light));
}

fn record_where(
    pass: &mut RenderPass,
    draws: &[Draw],
    drawn: &DrawnScene,
    view: usize,
    is_drawn: impl Fn(&Draw) -> bool,
) {
    let DrawnScene { scene, staging, resources } = *drawn;
    let plan = &staging.plan;
    let mut bound = None;
    for (rank, draw) in draws.iter().enumerate() {
        let part = plan.parts[draw.part];
        let is_seen = staging.is_shown(part.instance) && resources.sees(view, staging, draw.part);
        if !is_seen || !is_drawn(draw) {
            continue;
        }
        if bound.replace(draw.pipeline) != Some(draw.pipeline) {
            pass.pipeline(resources.pipeline(draw.pipeline));
            let (group, offsets) = resources.frame_group(draw.pipeline, view);
            pass.bind_at(FRAME_SET, group, &offsets[..group.uniform_blocks()]);
            pass.bind(OBJECT_SET, resources.object_group(draw.pipeline));
        }
        let (group, offsets) = resources.material_group(draw);
        pass.bind_at(MATERIAL_SET, group, &offsets[..group.uniform_blocks()]);
        for input in resources.inputs(draw.pipeline) {
            if let Some((buffer, offset, stride)) = resources.stream(staging, part, *input) {
                pass.vertices(input.location, buffer, offset, stride);
            }
        }
        pass.indices(resources.indices(part), 0);
        let primitive = &scene.asset().meshes[part.mesh].primitives[part.primitive];
        let lights = &staging.light_lists.ranges[draw.part];
        let [object_index, previous_object_index, first_light] = resources.entries(part.instance, lights.start);
        let object = ObjectDraw {
            object_index,
            previous_object_index,
            shell: 0,
            vertices_per_shell: primitive.vertices.positions.len() as u32,
            first_light,
            light_count: lights.end - lights.start,
            rank: rank as u32,
            metres_per_unit: staging.sizes[part.instance].world_from_rest,
        };
        pass.push(&object);
        let is_mirrored = staging.instances[part.instance].mirrored;
        let front = if is_mirrored { FrontFace::CLOCKWISE } else { FrontFace::COUNTER_CLOCKWISE };
        pass.cull(culled(draw.faces), front);
        let layers = match draw.kind {
            DrawKind::Surface(_) => 1,
            DrawKind::Fur { layers, .. } => layers,
        };
        let count = primitive.indices.len() as u32;
        match staging.options().shells.submission {
            ShellSubmission::Draws if layers > 1 => {
                for shell in 0..layers {
                    pass.push(&ObjectDraw { shell, ..object });
                    pass.draw_indexed(count, 1, 0, 0);
                }
            }
            ShellSubmission::Duplicated => pass.draw_indexed(count * layers, 1, 0, 0),
            _ => pass.draw_indexed(count, layers, 0, 0),
        }
    }
}

fn culled(faces: Faces) -> CullModeFlags {
    match faces {
        Faces::Both => CullModeFlags::NONE,
        Faces::One(Side::Back) => CullModeFlags::FRONT,
        Faces::One(Side::Front) => CullModeFlags::BACK,
    }
}
