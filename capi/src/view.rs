//! Cameras of a frame, and what it is drawn into.

use glam::{Mat4, Vec2};
use vair::gpu::vk;
use vair::render::{DepthOrder, Target, View, Viewport};

/// A camera in one frame: any projection. Matrices are 16 numbers, column by column.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct VairView {
    /// From world space (right-handed, metres) to the camera's axes, which looks along its -Z.
    pub view_from_world: [f32; 16],
    /// Projection, depth in [0, 1] in the order that the target declares. Jitter comes on top.
    pub clip_from_view: [f32; 16],
    /// Left edge of what is drawn to, pixels of the target.
    pub viewport_x: u32,
    /// Its top edge.
    pub viewport_y: u32,
    /// Its width.
    pub viewport_width: u32,
    /// Its height.
    pub viewport_height: u32,
    /// Shift of the picture, pixels to the right, in [-0.5, 0.5]: of temporal anti-aliasing. Motion does not count it.
    pub jitter_x_px: f32,
    /// The same, down.
    pub jitter_y_px: f32,
    /// Clip space points down, as Vulkan's own does; otherwise it points up.
    pub is_y_down: vk::Bool32,
    /// The two matrices of the previous frame are given; otherwise the camera has not moved.
    pub has_previous: vk::Bool32,
    /// Of the previous frame, for motion vectors.
    pub previous_view_from_world: [f32; 16],
    /// Of the previous frame, for motion vectors.
    pub previous_clip_from_view: [f32; 16],
    /// Factor on all radiance that is written, greater than 0.
    pub pre_exposure: f32,
}

/// Formats of what is drawn into; pipelines are made for it.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct VairTarget {
    /// Format of the colour target: takes linear, scene-referred radiance times the view's pre-exposure, premultiplied where it
    /// blends.
    pub color: vk::Format,
    /// Format of the depth target.
    pub depth: vk::Format,
    /// Samples a pixel of both: 1 or 4.
    pub samples: u32,
    /// Depth is 1 at the near plane and cleared to 0; otherwise 0 at the near plane and cleared to 1.
    pub is_depth_reversed: vk::Bool32,
    /// Format of a target for motion vectors, or VK_FORMAT_UNDEFINED. It takes pixels from the previous frame's place to this
    /// one's, x to the right, y down, in its first two channels.
    pub motion: vk::Format,
}

/// A view of a whole target, without jitter, with clip space up and radiance as it is; the matrices are identities to be
/// replaced.
#[unsafe(no_mangle)]
pub extern "C" fn vair_view_default(width: u32, height: u32) -> VairView {
    let identity = Mat4::IDENTITY.to_cols_array();
    VairView {
        view_from_world: identity,
        clip_from_view: identity,
        viewport_x: 0,
        viewport_y: 0,
        viewport_width: width,
        viewport_height: height,
        jitter_x_px: 0.0,
        jitter_y_px: 0.0,
        is_y_down: vk::FALSE,
        has_previous: vk::FALSE,
        previous_view_from_world: identity,
        previous_clip_from_view: identity,
        pre_exposure: 1.0,
    }
}

impl VairView {
    pub(crate) fn view(&self) -> View {
        let matrix = Mat4::from_cols_array;
        View {
            view_from_world: matrix(&self.view_from_world),
            clip_from_view: matrix(&self.clip_from_view),
            viewport: Viewport {
                origin: [self.viewport_x, self.viewport_y],
                size: [self.viewport_width, self.viewport_height],
            },
            jitter_px: Vec2::new(self.jitter_x_px, self.jitter_y_px),
            is_y_down: self.is_y_down != vk::FALSE,
            previous: (self.has_previous != vk::FALSE)
                .then(|| [matrix(&self.previous_view_from_world), matrix(&self.previous_clip_from_view)]),
            pre_exposure: self.pre_exposure,
        }
    }
}

impl VairTarget {
    pub(crate) fn of(target: Target) -> Self {
        Self {
            color: target.color,
            depth: target.depth,
            samples: target.samples,
            is_depth_reversed: u32::from(target.depth_order == DepthOrder::Reversed),
            motion: target.motion.unwrap_or(vk::Format::UNDEFINED),
        }
    }

    pub(crate) fn target(&self) -> Target {
        Target {
            color: self.color,
            depth: self.depth,
            samples: self.samples,
            depth_order: depth_order(self.is_depth_reversed),
            motion: format(self.motion),
        }
    }
}

pub(crate) fn depth_order(is_reversed: vk::Bool32) -> DepthOrder {
    if is_reversed == vk::FALSE { DepthOrder::Standard } else { DepthOrder::Reversed }
}

pub(crate) fn format(format: vk::Format) -> Option<vk::Format> {
    (format != vk::Format::UNDEFINED).then_some(format)
}
