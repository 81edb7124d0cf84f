//! Strands lag behind their moving roots, once a frame and coat that has inertia.
//!
//! In: positions of this frame (floats, world or object space), and where each strand was after the last one. Out: that,
//! moved on, and a vertex stream of bending forces in world space that the shells are drawn with. Cost: one invocation a
//! vertex. Source: the damped oscillator, stepped exactly. Twin: `material::reference::sway`.

use super::Moving;
use crate::gpu::Encoder;
use crate::render::plan::Pass;

/// Records the pass.
pub fn record(encoder: &mut Encoder, moving: &Moving) {
    let plan = &moving.shot.plan;
    encoder.compute_pass(Pass::Sway.name(), &[], |pass| {
        for (sway, (group, draw)) in plan.sways.iter().zip(&moving.motion.sways) {
            pass.pipeline(moving.resources.compute_pipeline(&plan.compute_pipelines[sway.pipeline]));
            pass.bind(0, group);
            pass.push(draw);
            pass.dispatch([draw.vertex_count.div_ceil(64), 1, 1]);
        }
    });
}
