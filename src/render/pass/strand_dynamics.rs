//! Strands lag behind their moving roots, once a frame and part that has fur with inertia.
//!
//! In: positions of this frame (floats, world or object space), and where each strand was after the last one. Out: that,
//! moved on, and a vertex stream of bending forces in world space that the shells are drawn with. Cost: one invocation a
//! vertex. Source: the damped oscillator, stepped exactly (`strand_dynamics.glsl`).

use super::{Definition, no_attachments, no_draws, no_full_screen};
use crate::gpu::Encoder;
use crate::render::device_scene::DrawnScene;
use crate::render::plan::ComputeSpec;
use crate::shader::{Defines, ShaderFile, ShaderKey};

pub(super) const PASS: Definition = Definition {
    name: "strand dynamics",
    wanted: |plan, input| match plan.dynamics.is_empty() && !input.options.everything {
        true => Err("no animation moves fur that has inertia"),
        false => Ok(()),
    },
    add_draws: no_draws,
    full_screen: no_full_screen,
    attachments: no_attachments,
    optional_attachments: &[],
    record: |encoder, frame| record(encoder, &frame.drawn),
};

/// The pipeline that lets strands lag behind their roots.
pub fn pipeline() -> ComputeSpec {
    ComputeSpec { shader: ShaderKey::new(ShaderFile::StrandDynamicsComp, Defines::NONE), constants: Vec::new() }
}

/// Records the pass.
pub fn record(encoder: &mut Encoder, drawn: &DrawnScene) {
    let plan = &drawn.staging.plan;
    if plan.dynamics.is_empty() {
        return;
    }
    encoder.compute_pass(PASS.name, &[], |pass| {
        for (index, dynamics) in plan.dynamics.iter().enumerate() {
            let draw = drawn.resources.strand_dynamics_draw(drawn.scene, drawn.staging, index);
            pass.pipeline(drawn.resources.compute_pipeline(dynamics.pipeline));
            pass.bind(0, drawn.resources.strand_dynamics_group(index));
            pass.push(&draw);
            pass.dispatch([draw.vertex_count.div_ceil(64), 1, 1]);
        }
    });
}
