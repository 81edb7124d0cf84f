//! Screen-space ambient occlusion: what is asked of it.

use super::RenderError;
use glam::Mat4;

/// Most slices and most steps.
pub const MAX_OCCLUSION_SAMPLES: u32 = 64;

/// What occludes, where nobody says: a share of the scene's bounding radius.
const RADIUS_SHARE: f32 = 0.15;

/// Ambient light that what stands around hides, found from the depths on the screen (`horizon.glsl`).
///
/// What the picture does not show hides nothing: what lies outside it, or behind something nearer. A frame pays for the
/// guide pass, `2 * slices * steps` look-ups a pixel, and 16 more for the blur.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ScreenOcclusion {
    /// Nothing beyond hides anything, metres, > 0; what is nearer hides by 1 - (distance / radius)^2. `None`: 15 % of the
    /// scene's bounding radius.
    pub radius_m: Option<f32>,
    /// Slices of the hemisphere a pixel, 1 to 64; a blur takes those of 4 x 4 pixels together.
    pub slices: u32,
    /// Samples a side of a slice, 1 to 64.
    pub steps: u32,
}

impl Default for ScreenOcclusion {
    fn default() -> Self {
        Self { radius_m: None, slices: 2, steps: 6 }
    }
}

impl ScreenOcclusion {
    /// The radius in a scene of a bounding radius, metres.
    pub fn radius_m(&self, scene_radius_m: f32) -> f32 {
        self.radius_m.unwrap_or(RADIUS_SHARE * scene_radius_m).max(f32::MIN_POSITIVE)
    }

    pub(super) fn check(&self) -> Result<(), RenderError> {
        let wrong = |problem| Err(RenderError::Option { option: "screen occlusion", problem });
        let is_count = |count| (1..=MAX_OCCLUSION_SAMPLES).contains(&count);
        if !is_count(self.slices) || !is_count(self.steps) {
            return wrong(format!("slices and steps must be 1 to {MAX_OCCLUSION_SAMPLES}"));
        }
        if self.radius_m.is_some_and(|radius_m| !(radius_m > 0.0 && radius_m.is_finite())) {
            return wrong("the radius must be a finite number of metres greater than 0".to_owned());
        }
        Ok(())
    }
}

/// Metres along the view direction of a depth that this projection wrote.
pub(super) fn depth_m(clip_from_camera: Mat4, is_orthographic: bool, depth: f32) -> f32 {
    let [scale, offset] = [clip_from_camera.z_axis.z, clip_from_camera.w_axis.z].map(f64::from);
    let depth = f64::from(depth);
    (if is_orthographic { (offset - depth) / scale } else { offset / (depth + scale) }) as f32
}
