//! The draws of the guide, opaque, fur and transparent passes: surfaces and shells.
//!
//! In: vertex streams, materials, frame data. Out: linear HDR colour (premultiplied alpha) and reversed depth.
//! Shells are one instanced draw a primitive: the layer comes from the instance index, outermost first. To measure
//! against, they can be a draw each, or vertices of their own in one draw.

use super::Frame;
use crate::gpu::RenderPass;
use crate::render::frame_data::{FRAME_SET, OBJECT_SET};
use crate::render::options::ShellSubmission;
use crate::render::pipeline::shader;
use crate::render::plan::{Draw, DrawKind, Faces};
use crate::render::stream::inputs;
use crate::scene::Side;
use crate::shader::layout::ObjectDraw;
use ash::vk::{CullModeFlags, FrontFace};

/// Records draws in their order, seen by the camera (view 0) or by a light into a shadow map (its number from 1).
pub fn record(pass: &mut RenderPass, draws: &[Draw], frame: &Frame, view: usize) {
    let Frame { scene, resources, motion, data, .. } = *frame;
    let plan = &frame.shot.plan;
    let mut bound = None;
    let mut vertex_inputs = Vec::new();
    for (rank, draw) in draws.iter().enumerate() {
        let spec = &plan.pipelines[draw.pipeline];
        if bound.replace(draw.pipeline) != Some(draw.pipeline) {
            pass.pipeline(resources.pipeline(spec));
            for set in [FRAME_SET, OBJECT_SET] {
                pass.bind(set, data.shared_group(view, set, spec));
            }
            vertex_inputs = inputs(shader(&spec.vertex));
        }
        let instance = &plan.instances[draw.instance];
        let index = (instance.mesh, instance.primitive);
        let primitive = &scene.asset().meshes[index.0].primitives[index.1];
        let (material, layers) = match draw.kind {
            DrawKind::Surface(surface) => (resources.surface(surface, spec), 1),
            DrawKind::Fur { layers, .. } => (&data.coat_groups[&(draw.instance, draw.pipeline)], layers),
        };
        pass.bind(1, material);
        for input in &vertex_inputs {
            let moved = motion.streams.get(&(draw.instance, input.stream, input.moment));
            match (moved.or_else(|| resources.streams.get(&(index, input.stream))), resources.absent()) {
                (Some(stream), _) => pass.vertices(input.location, stream, 0, u64::from(input.stream.stride())),
                (None, Some(absent)) => pass.vertices(input.location, absent, input.stream.absent_offset(), 0),
                (None, None) => {}
            }
        }
        pass.indices(&resources.indices[&index], 0);
        let lights = &plan.lights.ranges[draw.instance];
        let object = ObjectDraw {
            object_index: draw.instance as u32,
            first_light: lights.start,
            light_count: lights.end - lights.start,
            vertices_per_shell: primitive.vertices.positions.len() as u32,
            rank: rank as u32,
            metres_per_unit: scene.size(instance).world_from_rest,
            ..Default::default()
        };
        pass.push(&object);
        let front = if instance.mirrored { FrontFace::CLOCKWISE } else { FrontFace::COUNTER_CLOCKWISE };
        pass.cull(culled(draw.faces), front);
        let count = primitive.indices.len() as u32;
        match frame.options.shells.submission {
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
