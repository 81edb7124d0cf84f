//! What strands that lag behind remember from one frame to the next.

use super::options::FrameOptions;
use crate::gpu::Buffer;
use crate::material::Fur;
use crate::material::reference::sway::LONGEST_STEP_S;
use crate::scene::{Instance, Scene};
use crate::shader::layout::SwayDraw;
use std::collections::HashMap;

/// What is played: scene, its index, clip, variant. Frames of anything else do not follow.
type Take = (u64, Option<usize>, Option<usize>, Option<usize>);

/// Where every strand was after the last frame.
#[derive(Default)]
pub struct SwayMemory {
    /// `None` before the first frame and after one that failed.
    last: Option<(Take, f32)>,
    /// One [`SwayVertex`](crate::shader::layout::SwayVertex) a vertex, by node and primitive.
    pub vertices: HashMap<(usize, usize), Buffer>,
}

impl SwayMemory {
    /// Starts a frame: seconds since the last one, 0 for the same moment once more. Where this frame does not follow the
    /// last one, everything is forgotten.
    pub fn begin(&mut self, scene: &Scene, options: &FrameOptions) -> f32 {
        let step_s = self.last.take().and_then(|(take, last_s)| {
            let step_s = options.time_s - last_s;
            // The difference of two rounded times is off by as much as they are.
            let rounding_s = options.time_s.abs() * f32::EPSILON;
            let longest_s = LONGEST_STEP_S as f32;
            let follows = take == take_of(scene, options) && step_s >= 0.0 && step_s <= longest_s + rounding_s;
            follows.then_some(step_s.min(longest_s))
        });
        if step_s.is_none() {
            self.vertices.clear();
        }
        step_s.unwrap_or(0.0)
    }

    /// The frame's commands are complete: the next one may follow.
    pub fn keep(&mut self, scene: &Scene, options: &FrameOptions) {
        self.last = Some((take_of(scene, options), options.time_s));
    }
}

fn take_of(scene: &Scene, options: &FrameOptions) -> Take {
    (scene.id(), options.scene, options.animation, options.variant)
}

/// The dispatch over `vertex_count` strands of `fur`.
pub fn sway_draw(scene: &Scene, instance: &Instance, fur: &Fur, vertex_count: u32) -> SwayDraw {
    let length_m = fur.length.metres(scene.size(instance).world_radius_m());
    SwayDraw {
        world_from_object: instance.world_from_object.to_cols_array_2d(),
        vertex_count,
        stiffness: fur.stiffness,
        damping: fur.damping,
        // A lag of a strand's length lays it flat.
        force_per_m: if length_m > 0.0 { (fur.inertia / length_m).min(f32::MAX) } else { 0.0 },
        ..Default::default()
    }
}
