//! The draws of the opaque, fur and transparent passes: surfaces and shells.
//!
//! In: vertex streams, materials, frame data. Out: linear HDR colour (premultiplied alpha) and reversed depth.
//! Shells are one instanced draw a primitive: the layer comes from the instance index, outermost first. To measure
//! against, they can be a draw each, or vertices of their own in one draw.

use super::Frame;
use crate::asset::Topology;
use crate::gpu::RenderPass;
use crate::render::frame_data::{FRAME_SET, OBJECT_SET};
use crate::render::options::ShellSubmission;
use crate::render::pipeline::shader;
use crate::render::plan::{Draw, DrawKind};
use crate::render::stream::inputs;
use crate::scene::{Instance, joint_matrices};
use crate::shader::layout::ObjectDraw;
use ash::vk::{CullModeFlags, FrontFace};
use glam::Mat4;

/// Records draws in their order.
pub fn record(pass: &mut RenderPass, draws: &[Draw], frame: &Frame) {
    let Frame { scene, resources, motion, data, .. } = *frame;
    let plan = &frame.shot.plan;
    let mut bound = None;
    let mut vertex_inputs = Vec::new();
    for draw in draws {
        let spec = &plan.pipelines[draw.pipeline];
        if bound.replace(draw.pipeline) != Some(draw.pipeline) {
            pass.pipeline(resources.pipeline(spec));
            for set in [FRAME_SET, OBJECT_SET] {
                pass.bind(set, data.shared_group(set, spec));
            }
            vertex_inputs = inputs(shader(&spec.vertex));
        }
        let instance = &plan.instances[draw.instance];
        let index = (instance.mesh, instance.primitive);
        let primitive = &scene.asset().meshes[index.0].primitives[index.1];
        let (material, layers, double_sided) = match draw.kind {
            DrawKind::Surface(surface) => {
                (resources.surface(surface, spec), 1, scene.materials()[surface.material].standard.double_sided)
            }
            // Shells that face away carry the strands that stand out over the outline.
            DrawKind::Fur { layers, .. } => (&data.coat_groups[&(draw.instance, draw.pipeline)], layers, true),
        };
        pass.bind(1, material);
        for input in &vertex_inputs {
            let moved = motion.streams.get(&(draw.instance, input.stream)).filter(|_| !input.rest);
            match (moved.or_else(|| resources.streams.get(&(index, input.stream))), resources.absent()) {
                (Some(stream), _) => pass.vertices(input.location, stream, 0, u64::from(input.stream.stride())),
                (None, Some(absent)) => pass.vertices(input.location, absent, input.stream.absent_offset(), 0),
                (None, None) => {}
            }
        }
        pass.indices(&resources.indices[&index], 0);
        let object = ObjectDraw {
            object_index: draw.instance as u32,
            vertices_per_shell: primitive.vertices.positions.len() as u32,
            ..Default::default()
        };
        pass.push(&object);
        let front = if instance.mirrored { FrontFace::CLOCKWISE } else { FrontFace::COUNTER_CLOCKWISE };
        let faces: &[CullModeFlags] = match double_sided {
            // What lies behind must be blended first.
            true if spec.blend && primitive.topology == Topology::Triangles => {
                &[CullModeFlags::FRONT, CullModeFlags::BACK]
            }
            true => &[CullModeFlags::NONE],
            false => &[CullModeFlags::BACK],
        };
        let count = primitive.indices.len() as u32;
        for face in faces {
            pass.cull(*face, front);
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
}

/// Draws from far to near, by the middle of each object's bounds.
pub fn far_to_near(draws: &[Draw], frame: &Frame) -> Vec<Draw> {
    let camera = &frame.shot.camera;
    let depth = |draw: &Draw| {
        let instance = &frame.shot.plan.instances[draw.instance];
        let carrier = match instance.skin {
            // The mean of its joints, as its vertices weigh them.
            Some(skin) => mean_joint(frame, instance, skin),
            None => instance.world_from_object,
        };
        let middle = carrier.transform_point3(frame.scene.middle_in_object(instance));
        (middle - camera.eye_in_world()).dot(-camera.backwards_in_world())
    };
    let mut sorted: Vec<(f32, Draw)> = draws.iter().map(|draw| (depth(draw), *draw)).collect();
    // A coat lies over its own skin: at equal depth the order of the plan holds, since the sort is stable.
    sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
    sorted.into_iter().map(|(_, draw)| draw).collect()
}

fn mean_joint(frame: &Frame, instance: &Instance, skin: usize) -> Mat4 {
    let joints = joint_matrices(frame.scene.asset(), skin, &frame.shot.pose);
    let primitive = &frame.scene.asset().meshes[instance.mesh].primitives[instance.primitive];
    let influences = &primitive.vertices.joints;
    let total: f32 = influences.iter().map(|(_, weight)| weight).sum();
    let sum = influences.iter().fold(Mat4::ZERO, |sum, &(joint, weight)| sum + joints[usize::from(joint)] * weight);
    if total > 0.0 { sum * total.recip() } else { Mat4::IDENTITY }
}
