//! Skinning and morphing, once a frame, whatever number of shells is drawn after it.
//!
//! In: rest-pose streams (floats), joint matrices, influences, morph offsets and weights. Out: moved streams in
//! world space (skinned) or object space (morphed alone). Cost: one invocation a vertex and stream.
//! Twin: `scene::deform`.

use super::Moving;
use crate::gpu::Encoder;
use crate::render::plan::Pass;
use crate::shader::layout::DeformDraw;

/// Records the pass.
pub fn record(encoder: &mut Encoder, moving: &Moving) {
    let plan = &moving.shot.plan;
    encoder.compute_pass(Pass::Deform.name(), &[], |pass| {
        for (deform, group) in plan.deforms.iter().zip(&moving.motion.deform_groups) {
            let instance = &plan.instances[deform.instance];
            let primitive = &moving.scene.asset().meshes[instance.mesh].primitives[instance.primitive];
            let vertex_count = primitive.vertices.positions.len() as u32;
            pass.pipeline(moving.resources.compute_pipeline(&plan.compute_pipelines[deform.pipeline]));
            pass.bind(0, group);
            pass.push(&DeformDraw {
                vertex_count,
                influences_per_vertex: primitive.vertices.influences_per_vertex as u32,
                target_count: primitive.morph_targets.len() as u32,
            });
            pass.dispatch([vertex_count.div_ceil(64), 1, 1]);
        }
    });
}
