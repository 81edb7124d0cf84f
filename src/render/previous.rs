//! The previous frame, for motion vectors: what moved since.

use super::{FrameOptions, RenderError, clip_time_s};
use crate::scene::{self, Camera, Instance, Pose, Scene};

/// Where everything was in the previous frame.
pub struct Previous {
    /// Where every node was.
    pub pose: Pose,
    /// Whose eye.
    pub camera: Camera,
    /// One for each of the frame's own instances, in their order.
    pub instances: Vec<Instance>,
}

impl Previous {
    /// Poses the scene of `options` at their previous time, if they ask for motion; `now` are the frame's own instances.
    ///
    /// # Errors
    /// Those of [`scene::camera`].
    pub fn new(scene: &Scene, now: &[Instance], options: &FrameOptions) -> Result<Option<Self>, RenderError> {
        if !options.aovs.motion {
            return Ok(None);
        }
        let asset = scene.asset();
        let scene_index = options.scene.unwrap_or(asset.default_scene);
        let time_s = clip_time_s(asset, options.animation, options.previous_time_s.unwrap_or(options.time_s));
        let pose = scene::pose(asset, options.animation, time_s);
        let shown = scene.outline(scene_index, options.animation);
        let aspect = options.size[0] as f32 / options.size[1] as f32;
        let camera = scene::camera(asset, scene_index, &pose, &options.camera, aspect, &shown)?;
        let before = scene::instances(asset, scene_index, &pose, options.variant);
        // What was not there has not moved.
        let of = |now: &Instance| {
            let same = before.iter().find(|before| (before.node, before.primitive) == (now.node, now.primitive));
            same.unwrap_or(now).clone()
        };
        Ok(Some(Self { pose, camera, instances: now.iter().map(of).collect() }))
    }
}
