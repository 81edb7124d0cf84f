//! Foreign commands between two wgpu passes.
//!
//! A wgpu encoder records either wgpu's commands or foreign ones, not both: once `as_hal_mut` has opened it, its own methods
//! panic. So the frame has three encoders, submitted together and run in that order: wgpu's first passes, this one, wgpu's
//! last passes.
//!
//! **Layouts.** wgpu tracks them from submission to submission and does not see what happens here. It is told where the
//! textures must be ([`hand_over`]), and finds them as it left them: dynamic rendering does not change a layout.
//!
//! | texture | state in wgpu | layout |
//! |---|---|---|
//! | colour | `TextureUses::COLOR_TARGET` | `COLOR_ATTACHMENT_OPTIMAL` |
//! | depth | `TextureUses::DEPTH_STENCIL_WRITE` | `DEPTH_STENCIL_ATTACHMENT_OPTIMAL` |
//!
//! **Hazards.** Towards the first passes a barrier of our own orders attachment writes. Towards the last ones wgpu's own
//! does: to read a texture that it knows as a target, it waits for all attachment writes before.

use crate::Problem;
use crate::engine::Engine;
use vair::gpu::{ash, vk};
use wgpu::hal::api::Vulkan;

/// Brings the engine's targets into the states of the table, at the end of the encoder before the foreign one.
pub fn hand_over(encoder: &mut wgpu::CommandEncoder, engine: &Engine) {
    let state = |texture, state| wgpu::wgt::TextureTransition { texture, selector: None, state };
    let color = state(&engine.color.texture, wgpu::TextureUses::COLOR_TARGET);
    let depth = state(&engine.depth.texture, wgpu::TextureUses::DEPTH_STENCIL_WRITE);
    encoder.transition_resources(std::iter::empty(), [color, depth].into_iter());
}

/// An encoder whose commands are `record`'s; they go into its Vulkan command buffer, outside a pass.
pub fn encode<T>(
    device: &wgpu::Device,
    record: impl FnOnce(vk::CommandBuffer) -> Result<T, Problem>,
) -> Result<(wgpu::CommandBuffer, T), Problem> {
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("vair") });
    let record = |hal: Option<&mut wgpu::hal::vulkan::CommandEncoder>| {
        let hal = hal.ok_or("the encoder is not of wgpu's Vulkan backend")?;
        // SAFETY: the command buffer is not destroyed, nor ended.
        record(unsafe { hal.raw_handle() })
    };
    // SAFETY: while `record` runs, nothing touches the encoder; it leaves the command buffer recording.
    let recorded = unsafe { encoder.as_hal_mut::<Vulkan, _, _>(record) }?;
    Ok((encoder.finish(), recorded))
}

/// A dynamic rendering pass on the engine's targets, which keeps what is there and stores what `draw` adds.
///
/// # Safety
/// `command_buffer` is recording, outside a pass, and runs when the targets are as [`hand_over`] leaves them. `draw` begins
/// no pass and ends none.
pub unsafe fn draw_into(
    device: &ash::Device,
    engine: &Engine,
    command_buffer: vk::CommandBuffer,
    draw: impl FnOnce() -> Result<(), Problem>,
) -> Result<(), Problem> {
    let writes = vk::AccessFlags2::COLOR_ATTACHMENT_WRITE | vk::AccessFlags2::DEPTH_STENCIL_ATTACHMENT_WRITE;
    let reads = vk::AccessFlags2::COLOR_ATTACHMENT_READ | vk::AccessFlags2::DEPTH_STENCIL_ATTACHMENT_READ;
    let stages = vk::PipelineStageFlags2::COLOR_ATTACHMENT_OUTPUT
        | vk::PipelineStageFlags2::EARLY_FRAGMENT_TESTS
        | vk::PipelineStageFlags2::LATE_FRAGMENT_TESTS;
    let barrier = [vk::MemoryBarrier2::default()
        .src_stage_mask(stages)
        .src_access_mask(writes)
        .dst_stage_mask(stages)
        .dst_access_mask(writes | reads)];
    let dependency = vk::DependencyInfo::default().memory_barriers(&barrier);

    let attachment = |view, layout| {
        vk::RenderingAttachmentInfo::default()
            .image_view(view)
            .image_layout(layout)
            .load_op(vk::AttachmentLoadOp::LOAD)
            .store_op(vk::AttachmentStoreOp::STORE)
    };
    let color = [attachment(raw_view(&engine.color.view)?, vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL)];
    let depth = attachment(raw_view(&engine.depth.view)?, vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
    let [width, height] = engine.size;
    let info = vk::RenderingInfo::default()
        .render_area(vk::Extent2D { width, height }.into())
        .layer_count(1)
        .color_attachments(&color)
        .depth_attachment(&depth);

    // SAFETY: the command buffer is recording outside a pass, and `synchronization2` is enabled.
    unsafe { device.cmd_pipeline_barrier2(command_buffer, &dependency) };
    // SAFETY: the views are whole targets of this size, in these layouts, and `dynamic_rendering` is enabled.
    unsafe { device.cmd_begin_rendering(command_buffer, &info) };
    let drawn = draw();
    // SAFETY: begun above.
    unsafe { device.cmd_end_rendering(command_buffer) };
    drawn
}

/// The Vulkan view of a wgpu one. wgpu panics on a second such look while the first is held, so each is let go at once.
fn raw_view(view: &wgpu::TextureView) -> Result<vk::ImageView, Problem> {
    // SAFETY: the view is not destroyed.
    let hal = unsafe { view.as_hal::<Vulkan>() }.ok_or("a target is not of wgpu's Vulkan backend")?;
    // SAFETY: as above.
    Ok(unsafe { hal.raw_handle() })
}
