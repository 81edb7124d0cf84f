//! Layers beside the colour ("arbitrary output variables"), one sample in the middle of each pixel: for compositing,
//! denoising and motion blur.

use super::targets::PictureTargets;
use crate::gpu::Gpu;
use crate::math::direction_from_octahedral;
use crate::render::pass::{gbuffer, ssao_blur};
use crate::render::{FrameOptions, RenderError};
use crate::scene::Camera;
use glam::{DVec2, Mat4, Vec2, Vec3};

/// Which layers a frame keeps beside its colour; none by default.
///
/// They show what is opaque or masked, and what blends where it covers more than half; gauze never does. Fur is seen
/// strand by strand, at the shell that shows the strand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Aovs {
    /// Distance from the eye along the view direction, metres.
    pub depth: bool,
    /// Normal of what is seen, on the side that is seen: of the mesh, whatever maps bend it, and of fur as its strands'
    /// roots stand. Unit length, world space.
    pub normal: bool,
    /// Way on the picture since [`FrameOptions::previous_time_s`].
    pub motion: bool,
    /// Screen-space occlusion, where the frame has it.
    pub occlusion: bool,
}

impl Aovs {
    /// Whether there are any.
    pub fn any(self) -> bool {
        self.depth || self.normal || self.motion || self.occlusion
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
    /// Share of the ambient light that what stands around lets through, in [0, 1]; 1 where nothing is.
    pub occlusion: Vec<f32>,
}

/// Depth of nothing, metres: finite, so that filters make no NaN of it, and beyond any scene, as Blender writes it.
pub const EMPTY_DEPTH_M: f32 = 1e10;

impl AovPixels {
    /// Reads what a frame with these options left in the G-buffer.
    pub(super) fn read(
        gpu: &Gpu,
        targets: &PictureTargets,
        camera: &Camera,
        options: &FrameOptions,
    ) -> Result<Self, RenderError> {
        let Aovs { depth, normal, motion, occlusion: has_occlusion } = options.aovs;
        let mut pixels = Self::default();
        let Some(depths) = targets.image(gbuffer::DEPTH).filter(|_| options.aovs.any()) else { return Ok(pixels) };
        let depths: Vec<f32> = bytemuck::pod_collect_to_vec(&gpu.read_image(depths)?);
        if let Some(texels) = targets.image(gbuffer::TEXELS).filter(|_| normal || motion) {
            let texels: Vec<f32> = bytemuck::pod_collect_to_vec(&gpu.read_image(texels)?);
            let texels = || depths.iter().zip(texels.chunks_exact(if motion { 4 } else { 2 }));
            if normal {
                let direction = |texel: &[f32]| direction_from_octahedral(DVec2::new(texel[0].into(), texel[1].into()));
                let normal = |(depth, texel): (&f32, &[f32])| match *depth > 0.0 {
                    true => direction(texel).as_vec3(),
                    false => Vec3::ZERO,
                };
                pixels.normal_in_world = texels().map(normal).collect();
            }
            if motion {
                pixels.motion_px = texels().map(|(_, texel)| Vec2::new(texel[2], texel[3])).collect();
            }
        }
        if depth {
            let metres = |depth: &f32| match *depth > 0.0 {
                true => depth_m(camera.clip_from_camera, camera.is_orthographic, *depth),
                false => EMPTY_DEPTH_M,
            };
            pixels.depth_m = depths.iter().map(metres).collect();
        }
        if let Some(visibility) = targets.image(ssao_blur::VISIBILITY).filter(|_| has_occlusion) {
            let halves = gpu.read_image(visibility)?;
            let share = |bytes: &[u8]| half::f16::from_le_bytes([bytes[0], bytes[1]]).to_f32();
            pixels.occlusion = halves.chunks_exact(2).map(share).collect();
        }
        Ok(pixels)
    }

    /// Channels of an EXR file: name and values.
    pub fn channels(&self) -> Vec<(&'static str, Vec<f32>)> {
        let Self { depth_m, normal_in_world, motion_px, occlusion } = self;
        let normal = |axis: usize| normal_in_world.iter().map(|normal| normal[axis]).collect();
        let motion = |axis: usize| motion_px.iter().map(|motion| motion[axis]).collect();
        let all = [
            ("depth.Z", depth_m.clone()),
            ("normal.X", normal(0)),
            ("normal.Y", normal(1)),
            ("normal.Z", normal(2)),
            ("motion.X", motion(0)),
            ("motion.Y", motion(1)),
            ("occlusion.V", occlusion.clone()),
        ];
        all.into_iter().filter(|(_, values)| !values.is_empty()).collect()
    }
}

/// Metres along the view direction of a depth that this projection wrote.
fn depth_m(clip_from_camera: Mat4, is_orthographic: bool, depth: f32) -> f32 {
    let [scale, offset] = [clip_from_camera.z_axis.z, clip_from_camera.w_axis.z].map(f64::from);
    let depth = f64::from(depth);
    (if is_orthographic { (offset - depth) / scale } else { offset / (depth + scale) }) as f32
}
