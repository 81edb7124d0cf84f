//! A frame being recorded into the host's command buffers.

use crate::VAIR_NONE;
use crate::image::VairImage;
use crate::light::VairLight;
use crate::pointer::{exclusive, handle, result, shared, slice};
use crate::renderer::{Shared, VairRenderer};
use crate::result::{Failure, VairResult, border};
use crate::scene::VairScene;
use crate::view::{VairTarget, VairView, depth_order, format};
use glam::Mat4;
use std::ptr::NonNull;
use std::sync::Arc;
use vair::Renderer;
use vair::gpu::{HostCommands, HostRendering, TargetFormats, vk};
use vair::render::{CastTarget, DeviceScene, Frame, FrameDesc, HostShadowMap, HostShadows, RenderError, Shadows, View};
use vair::scene::Light;

/// A frame being recorded. vair_frame_prepare() comes first, outside of a pass; draws come inside the host's own passes, in the
/// order that it likes; vair_frame_finish() last, also where another call has failed.
pub struct VairFrame {
    /// Goes before what it borrows.
    frame: Option<Frame<'static>>,
    renderer: NonNull<Renderer>,
    home: Arc<Shared>,
}

impl Drop for VairFrame {
    fn drop(&mut self) {
        self.frame = None;
        // SAFETY: it came from a box when the frame began, and the frame that borrowed it is gone.
        self.home.give_back(unsafe { Box::from_raw(self.renderer.as_ptr()) });
    }
}

/// Shadow maps that the host has made: one image, in which each map has a square tile.
#[repr(C)]
pub struct VairHostShadows {
    /// Depth of the nearest surfaces, reversed (1 at the light).
    pub image: *const VairImage,
    /// Tiles; those of one light stand together, the finest first.
    pub maps: *const VairShadowMap,
    /// How many.
    pub map_count: u32,
}

/// A shadow map of the host's.
#[repr(C)]
pub struct VairShadowMap {
    /// Index of the light.
    pub light: u32,
    /// 16 numbers, column by column: clip space up, reversed depth; w is 1 for parallel rays and otherwise the distance along
    /// the axis, metres.
    pub clip_from_world: [f32; 16],
    /// Left edge of the tile, texels.
    pub x_px: u32,
    /// Its top edge.
    pub y_px: u32,
    /// Its side.
    pub size_px: u32,
}

/// What a frame is. Start from vair_frame_desc_default().
#[repr(C)]
pub struct VairFrameDesc {
    /// Cameras, lights' eyes among them, at least one; draws name them by their place here. The first one decides where vair's
    /// own shadow maps are fine.
    pub views: *const VairView,
    /// How many.
    pub view_count: u32,
    /// What is drawn into.
    pub target: VairTarget,
    /// Lights.
    pub lights: *const VairLight,
    /// How many.
    pub light_count: u32,
    /// Lights cast shadows, in maps of vair's own.
    pub casts_shadows: vk::Bool32,
    /// Texels of such a map's sides: a power of two, 64 to 4096.
    pub shadow_resolution_px: u32,
    /// Radius of the shadows' filter, texels, 1 to 3.
    pub shadow_filter_px: u32,
    /// The host's own shadow maps in the place of vair's, or NULL.
    pub host_shadows: *const VairHostShadows,
    /// Depth format for vair_frame_cast_shadows(), or VK_FORMAT_UNDEFINED.
    pub cast_depth: vk::Format,
    /// That depth is 1 at the light.
    pub is_cast_depth_reversed: vk::Bool32,
    /// Seconds since the last frame, for strands that lag behind their roots; 0 holds them still.
    pub step_s: f32,
    /// Shells of fur, 1 to 256; VAIR_NONE is what each material says.
    pub layers: u32,
    /// Factor on the shells that each material says, greater than 0.
    pub layer_scale: f32,
}

/// No view yet and no lights; half floats and reversed 32-bit depth at 4 samples, shadows.
#[unsafe(no_mangle)]
pub extern "C" fn vair_frame_desc_default() -> VairFrameDesc {
    let FrameDesc { target, shadows, step_s, layer_scale, .. } = FrameDesc::default();
    VairFrameDesc {
        views: std::ptr::null(),
        view_count: 0,
        target: VairTarget::of(target),
        lights: std::ptr::null(),
        light_count: 0,
        casts_shadows: u32::from(shadows.are_cast),
        shadow_resolution_px: shadows.resolution_px,
        shadow_filter_px: shadows.filter_px,
        host_shadows: std::ptr::null(),
        cast_depth: vk::Format::UNDEFINED,
        is_cast_depth_reversed: vk::TRUE,
        step_s,
        layers: VAIR_NONE,
        layer_scale,
    }
}

/// Starts a frame. A renderer records one at a time; up to 64 may wait for their tokens.
///
/// # Safety
/// `renderer` is valid or NULL. The command buffer is recording, outside of a pass, belongs to the renderer's device and to a
/// family with graphics and compute; nobody else records into it during calls of the frame. It is submitted once, to the
/// renderer's queue, before anything recorded later.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_frame_begin(
    renderer: *mut VairRenderer,
    command_buffer: vk::CommandBuffer,
    frame: *mut *mut VairFrame,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's memory or NULL.
        let frame = unsafe { handle(frame, "frame") }?;
        // SAFETY: the caller's handle or NULL.
        let home = unsafe { exclusive(renderer, "renderer") }?.0.clone();
        check_commands(command_buffer)?;
        let renderer = NonNull::from(Box::leak(home.take()?));
        // Gives the renderer back where no frame begins.
        let mut begun = VairFrame { frame: None, renderer, home };
        // SAFETY: it is not in its home, so the frame alone uses it, until `begun` is dropped.
        let renderer: &'static mut Renderer = unsafe { &mut *renderer.as_ptr() };
        // SAFETY: by this function's contract.
        let commands = unsafe { HostCommands::recording(command_buffer) };
        begun.frame = Some(renderer.frame(commands)?);
        *frame = Box::into_raw(Box::new(begun));
        Ok(())
    })
}

/// Uploads what has changed, poses, moves strands, casts vair's own shadow maps: all that happens outside of passes. A scene is
/// prepared once a frame, for all its views. What `desc` points to is not used after the call.
///
/// # Safety
/// All pointers are valid or NULL and hold as many elements as the description says. The command buffer that the frame began with
/// is recording, outside of a pass.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_frame_prepare(
    frame: *mut VairFrame,
    scene: *mut VairScene,
    desc: *const VairFrameDesc,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let frame = unsafe { exclusive(frame, "frame") }?;
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { exclusive(scene, "scene") }?;
        // SAFETY: the caller's structure or NULL.
        let desc = unsafe { shared(desc, "desc") }?;
        // SAFETY: as many as the caller says, or NULL.
        let views = unsafe { slice(desc.views, desc.view_count as usize, "desc.views") }?;
        let views: Vec<View> = views.iter().map(VairView::view).collect();
        // SAFETY: as many as the caller says, or NULL.
        let lights = unsafe { slice(desc.lights, desc.light_count as usize, "desc.lights") }?;
        let lights: Vec<Light> =
            lights.iter().enumerate().map(|(index, light)| light.light(index)).collect::<Result<_, _>>()?;
        let mut maps = Vec::new();
        let mut host_shadows = None;
        if !desc.host_shadows.is_null() {
            // SAFETY: the caller's structure.
            let shadows = unsafe { shared(desc.host_shadows, "desc.host_shadows") }?;
            // SAFETY: the caller's handle or NULL.
            let VairImage(image) = unsafe { shared(shadows.image, "desc.host_shadows.image") }?;
            // SAFETY: as many as the caller says, or NULL.
            let given = unsafe { slice(shadows.maps, shadows.map_count as usize, "desc.host_shadows.maps") }?;
            maps.extend(given.iter().map(VairShadowMap::map));
            host_shadows = Some(HostShadows { image, maps: &maps });
        }
        let target = desc.target.target();
        let desc = FrameDesc {
            views: &views,
            target,
            lights: &lights,
            shadows: Shadows {
                are_cast: desc.casts_shadows != vk::FALSE,
                resolution_px: desc.shadow_resolution_px,
                filter_px: desc.shadow_filter_px,
            },
            host_shadows,
            cast_into: format(desc.cast_depth)
                .map(|format| CastTarget { format, depth_order: depth_order(desc.is_cast_depth_reversed) }),
            step_s: desc.step_s,
            layers: (desc.layers != VAIR_NONE).then_some(desc.layers),
            layer_scale: desc.layer_scale,
            ..FrameDesc::default()
        };
        frame.recording()?.prepare(&mut scene.device_scene, &desc)?;
        scene.target = target;
        scene.cast_depth = desc.cast_into.map(|target| target.format);
        Ok(())
    })
}

/// Draws opaque and masked surfaces, the skin under fur among them, of a view; depth is tested and written.
///
/// # Safety
/// The handles are valid or NULL. The command buffer is recording inside a dynamic rendering pass on the target that the scene was
/// prepared for; nobody else records into it during the call. It is submitted to the renderer's queue, after the one that the
/// frame began with or as that one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_frame_draw_opaque(
    frame: *mut VairFrame,
    command_buffer: vk::CommandBuffer,
    scene: *const VairScene,
    view: u32,
) -> VairResult {
    // SAFETY: this function's contract is that one's.
    border(|| unsafe { draw(frame, command_buffer, scene, view, VairScene::formats, Frame::draw_opaque) })
}

/// Draws shells of fur that does not blend; depth is tested and written.
///
/// # Safety
/// That of vair_frame_draw_opaque().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_frame_draw_fur(
    frame: *mut VairFrame,
    command_buffer: vk::CommandBuffer,
    scene: *const VairScene,
    view: u32,
) -> VairResult {
    // SAFETY: this function's contract is that one's.
    border(|| unsafe { draw(frame, command_buffer, scene, view, VairScene::formats, Frame::draw_fur) })
}

/// Draws what blends over what there is, from far to near as objects are sorted; depth is tested and not written.
///
/// # Safety
/// That of vair_frame_draw_opaque().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_frame_draw_transparent(
    frame: *mut VairFrame,
    command_buffer: vk::CommandBuffer,
    scene: *const VairScene,
    view: u32,
) -> VairResult {
    // SAFETY: this function's contract is that one's.
    border(|| unsafe { draw(frame, command_buffer, scene, view, VairScene::formats, Frame::draw_transparent) })
}

/// Draws motion vectors of what is not farther than the depth that there is: after the opaque surfaces and the fur, in a pass on the
/// target's motion image and that depth.
///
/// # Safety
/// That of vair_frame_draw_opaque().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_frame_draw_motion(
    frame: *mut VairFrame,
    command_buffer: vk::CommandBuffer,
    scene: *const VairScene,
    view: u32,
) -> VairResult {
    // SAFETY: this function's contract is that one's.
    border(|| unsafe { draw(frame, command_buffer, scene, view, VairScene::motion_formats, Frame::draw_motion) })
}

/// Draws depth alone of all that casts shadows, fur by its outermost strands, into a shadow map of the host's; `view` is the light's
/// eye.
///
/// # Safety
/// That of vair_frame_draw_opaque(), for a pass on depth alone, of the format that the scene was prepared for.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_frame_cast_shadows(
    frame: *mut VairFrame,
    command_buffer: vk::CommandBuffer,
    scene: *const VairScene,
    view: u32,
) -> VairResult {
    // SAFETY: this function's contract is that one's.
    border(|| unsafe { draw(frame, command_buffer, scene, view, VairScene::cast_formats, Frame::cast_shadows) })
}

/// Ends a frame and frees it, also where this fails, unless an argument is NULL. The host ends and submits its command buffers;
/// when the device is done with them, `token` goes to vair_renderer_frame_passed(), after a failure as well: what was recorded is
/// valid then, and something is missing in it.
///
/// # Safety
/// `frame` is valid or NULL, and is not used any more.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_frame_finish(frame: *mut VairFrame, token: *mut u64) -> VairResult {
    border(|| {
        // SAFETY: the caller's memory or NULL.
        let token = unsafe { result(token, "token") }?;
        // SAFETY: the caller's handle or NULL.
        unsafe { exclusive(frame, "frame") }?;
        // SAFETY: not NULL, and the caller gives it up.
        let mut frame = unsafe { Box::from_raw(frame) };
        token.write(0);
        let Some(recording) = frame.frame.take() else { return Ok(()) };
        match recording.finish() {
            Ok(passed) => {
                token.write(frame.home.keep(passed));
                Ok(())
            }
            Err(RenderError::Frame { token: passed, source }) => {
                token.write(frame.home.keep(passed));
                Err(source.into())
            }
            Err(error) => Err(error.into()),
        }
    })
}

/// How a frame draws one kind of thing.
type Draw = fn(&mut Frame<'static>, HostRendering, &DeviceScene, usize) -> Result<(), RenderError>;

/// # Safety
/// That of [`vair_frame_draw_opaque`], for a pass of the formats that `formats` gives.
unsafe fn draw(
    frame: *mut VairFrame,
    command_buffer: vk::CommandBuffer,
    scene: *const VairScene,
    view: u32,
    formats: fn(&VairScene) -> TargetFormats,
    draw: Draw,
) -> Result<(), Failure> {
    // SAFETY: the caller's handle or NULL.
    let frame = unsafe { exclusive(frame, "frame") }?;
    // SAFETY: the caller's handle or NULL.
    let scene = unsafe { shared(scene, "scene") }?;
    check_commands(command_buffer)?;
    // SAFETY: by this function's contract.
    let pass = unsafe { HostRendering::begun(command_buffer, formats(scene)) };
    Ok(draw(frame.recording()?, pass, &scene.device_scene, view as usize)?)
}

fn check_commands(command_buffer: vk::CommandBuffer) -> Result<(), Failure> {
    if command_buffer == vk::CommandBuffer::null() {
        return Err(Failure::argument("command_buffer is NULL"));
    }
    Ok(())
}

impl VairFrame {
    fn recording(&mut self) -> Result<&mut Frame<'static>, Failure> {
        self.frame.as_mut().ok_or_else(|| Failure::argument("frame has been finished"))
    }
}

impl VairShadowMap {
    fn map(&self) -> HostShadowMap {
        HostShadowMap {
            light: self.light as usize,
            clip_from_world: Mat4::from_cols_array(&self.clip_from_world),
            origin_px: [self.x_px, self.y_px],
            size_px: self.size_px,
        }
    }
}

/// The formats of passes that a host begins for what it prepared. Where a scene was prepared without one, the frame refuses to
/// draw before it looks at them.
impl VairScene {
    fn formats(&self) -> TargetFormats {
        self.target.formats()
    }

    fn motion_formats(&self) -> TargetFormats {
        self.target.motion_formats().unwrap_or_default()
    }

    fn cast_formats(&self) -> TargetFormats {
        TargetFormats::new([], self.cast_depth, 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objects_may_move_between_threads() {
        fn is_send<T: Send>() {}
        is_send::<VairRenderer>();
        is_send::<VairScene>();
        is_send::<VairImage>();
        // And with it what a `VairFrame` holds.
        is_send::<Frame<'static>>();
        is_send::<Renderer>();
    }
}
