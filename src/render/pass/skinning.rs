//! Skinning and morphing, once a frame, whatever number of views, passes and shells is drawn after it.
//!
//! In: rest-pose streams (floats), joint matrices, influences, morph offsets and weights. Out: moved streams in
//! world space (skinned) or object space (morphed alone). Cost: one invocation a vertex and stream.
//! Twin: `scene::deform`.

use super::{Definition, no_attachments, no_draws, no_full_screen};
use crate::gpu::Encoder;
use crate::render::device_scene::DrawnScene;
use crate::render::plan::ComputeSpec;
use crate::shader::layout::SkinningDraw;
use crate::shader::{Defines, ShaderFile, ShaderKey};

pub(super) const PASS: Definition = Definition {
    name: "skinning",
    wanted: |plan, input| match plan.deforms.is_empty() && !input.options.everything {
        true => Err("nothing in the scene is skinned or morphed"),
        false => Ok(()),
    },
    add_draws: no_draws,
    full_screen: no_full_screen,
    attachments: no_attachments,
    optional_attachments: &[],
    record: |encoder, frame| record(encoder, &frame.drawn),
};

/// The pipeline that moves one stream: `stream` 0 positions, 1 normals and shell directions, 2 tangents.
pub fn pipeline(skin: bool, morph: bool, stream: u32) -> ComputeSpec {
    let defines = Defines::NONE.with(Defines::SKIN, skin).with(Defines::MORPH, morph);
    ComputeSpec { shader: ShaderKey::new(ShaderFile::SkinningComp, defines), constants: vec![("STREAM", stream)] }
}

/// Records the pass.
pub fn record(encoder: &mut Encoder, drawn: &DrawnScene) {
    let plan = &drawn.staging.plan;
    if plan.deforms.is_empty() {
        return;
    }
    encoder.compute_pass(PASS.name, &[], |pass| {
        for (index, deform) in plan.deforms.iter().enumerate() {
            let part = plan.parts[deform.part];
            let primitive = &drawn.scene.asset().meshes[part.mesh].primitives[part.primitive];
            let vertex_count = primitive.vertices.positions.len() as u32;
            let (group, [first_joint, first_weight]) = drawn.resources.deform(index, part.instance, deform.pose);
            pass.pipeline(drawn.resources.compute_pipeline(deform.pipeline));
            pass.bind(0, group);
            pass.push(&SkinningDraw {
                vertex_count,
                influences_per_vertex: primitive.vertices.influences_per_vertex as u32,
                target_count: primitive.morph_targets.len() as u32,
                first_joint,
                first_weight,
            });
            pass.dispatch([vertex_count.div_ceil(64), 1, 1]);
        }
    });
}
