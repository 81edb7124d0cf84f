//! Layers beside the colour ("arbitrary output variables"), one sample in the middle of each pixel: for compositing,
//! denoising and motion blur.

use glam::{Vec2, Vec3};

/// Which layers a frame keeps beside its colour; none by default.
///
/// They show what is opaque or masked, and of what blends the nearest that covers more than half: a surface is seen
/// whole or not at all. A coat is seen strand by strand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Aovs {
    /// Distance from the eye along the view direction, metres.
    pub depth: bool,
    /// Normal of what is seen, turned to the eye: of surfaces as their maps bend it, of coats as their strands' roots
    /// stand. Unit length, world space.
    pub normal: bool,
    /// Way on the picture since [`FrameOptions::previous_time_s`](super::FrameOptions::previous_time_s).
    pub motion: bool,
}

impl Aovs {
    /// Whether there are any.
    pub fn any(self) -> bool {
        self.depth || self.normal || self.motion
    }
}

/// The layers' values, rows from the top; those that were not asked for are empty.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AovPixels {
    /// Metres along the view direction; [`EMPTY_DEPTH_M`] where nothing is.
    pub depth_m: Vec<f32>,
    /// Unit vectors in world space; zero where nothing is.
    pub normal_in_world: Vec<Vec3>,
    /// Pixels from where it was in the previous frame to where it is, x to the right, y down; zero where nothing is.
    pub motion_px: Vec<Vec2>,
}

/// Depth of nothing, metres: finite, so that filters make no NaN of it, and beyond any scene, as Blender writes it.
pub const EMPTY_DEPTH_M: f32 = 1e10;

impl AovPixels {
    /// Channels of an EXR file: name and values.
    pub fn channels(&self) -> Vec<(&'static str, Vec<f32>)> {
        let Self { depth_m, normal_in_world, motion_px } = self;
        let normal = |axis: usize| normal_in_world.iter().map(|normal| normal[axis]).collect();
        let motion = |axis: usize| motion_px.iter().map(|motion| motion[axis]).collect();
        let all = [
            ("depth.Z", depth_m.clone()),
            ("normal.X", normal(0)),
            ("normal.Y", normal(1)),
            ("normal.Z", normal(2)),
            ("motion.X", motion(0)),
            ("motion.Y", motion(1)),
        ];
        all.into_iter().filter(|(_, values)| !values.is_empty()).collect()
    }
}
