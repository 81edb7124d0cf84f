//! What a pass draws into, and what becomes of it before and after.

use super::barrier::{self, ImageUse};
use super::host::HostRendering;
use super::image::Image;
use super::pipeline::{MAX_COLOR_TARGETS, TargetFormats};
use ash::vk;

/// What a target holds when a pass starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Load {
    /// This value; depth takes the first component.
    Clear([f32; 4]),
    /// What it held.
    Keep,
    /// Anything: the pass writes all that is read later.
    Discard,
}

/// A colour target of a pass.
#[derive(Clone, Copy)]
pub struct ColorTarget<'a> {
    /// The image; level 0 is drawn.
    pub image: &'a Image,
    /// Contents at the start.
    pub load: Load,
    /// Keep the contents at the end.
    pub store: bool,
    /// Average of the samples goes here at the end: one sample, same format.
    pub resolve: Option<&'a Image>,
}

/// The depth target of a pass.
#[derive(Clone, Copy)]
pub struct DepthTarget<'a> {
    /// The image.
    pub image: &'a Image,
    /// Contents at the start.
    pub load: Load,
    /// Keep the contents at the end.
    pub store: bool,
}

/// A pass that draws.
#[derive(Clone, Copy)]
pub struct RenderPassDesc<'a> {
    /// Name: the label in debuggers and the row of the frame's times.
    pub name: &'a str,
    /// Area that is drawn, from the corner of the targets, texels.
    pub size: [u32; 2],
    /// Colour targets in the order of the fragment shader's locations.
    pub color: &'a [ColorTarget<'a>],
    /// Depth target.
    pub depth: Option<DepthTarget<'a>>,
    /// Images that shaders read and that were something else before (targets of earlier passes).
    pub sampled: &'a [&'a Image],
}

/// A part of the host's own pass, whose targets the host has bound.
#[derive(Clone, Copy)]
pub struct HostPass<'a> {
    /// Name: the label in debuggers.
    pub name: &'a str,
    /// The pass.
    pub rendering: HostRendering,
    /// Top left corner of what is drawn to, texels.
    pub origin: [u32; 2],
    /// Its size, texels.
    pub size: [u32; 2],
    /// Clip space points down, as Vulkan's own does; otherwise up.
    pub is_y_down: bool,
}

/// The formats of a pass's targets, or what is wrong with them.
pub(super) fn target_formats(desc: &RenderPassDesc<'_>) -> Result<TargetFormats, String> {
    let [width, height] = desc.size;
    let attachments = desc.color.iter().map(|target| target.image);
    let depth = desc.depth.map(|target| target.image);
    let resolves = desc.color.iter().filter_map(|target| target.resolve);
    for image in attachments.clone().chain(depth).chain(resolves) {
        let [w, h] = image.size();
        if width == 0 || height == 0 || width > w || height > h {
            return Err(format!("{width}x{height} does not fit in target '{}' of {w}x{h}", image.name()));
        }
    }
    let Some(samples) = attachments.clone().chain(depth).map(Image::samples).next() else {
        return Err("a pass has at least one target".to_owned());
    };
    for image in attachments.clone().chain(depth) {
        if image.samples() != samples {
            return Err(format!("target '{}' has {} samples, the first {samples}", image.name(), image.samples()));
        }
    }
    for image in attachments.clone() {
        if !image.0.usage.contains(vk::ImageUsageFlags::COLOR_ATTACHMENT) {
            return Err(format!("target '{}' lacks COLOR_ATTACHMENT", image.name()));
        }
    }
    if let Some(image) = depth.filter(|image| !image.0.usage.contains(vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT)) {
        return Err(format!("target '{}' lacks DEPTH_STENCIL_ATTACHMENT", image.name()));
    }
    for target in desc.color {
        let Some(resolve) = target.resolve else { continue };
        let is_target = resolve.0.usage.contains(vk::ImageUsageFlags::COLOR_ATTACHMENT);
        if !is_target || samples == 1 || resolve.samples() != 1 || resolve.format() != target.image.format() {
            let (from, to) = (target.image.name(), resolve.name());
            return Err(format!(
                "'{to}' cannot take the resolve of '{from}': one sample, same format, COLOR_ATTACHMENT"
            ));
        }
    }
    if desc.color.len() > MAX_COLOR_TARGETS {
        return Err(format!("{} colour targets (at most {MAX_COLOR_TARGETS})", desc.color.len()));
    }
    Ok(TargetFormats::new(attachments.map(Image::format), depth.map(Image::format), samples))
}

fn load_op(load: Load) -> vk::AttachmentLoadOp {
    match load {
        Load::Clear(_) => vk::AttachmentLoadOp::CLEAR,
        Load::Keep => vk::AttachmentLoadOp::LOAD,
        Load::Discard => vk::AttachmentLoadOp::DONT_CARE,
    }
}

fn store_op(store: bool) -> vk::AttachmentStoreOp {
    if store { vk::AttachmentStoreOp::STORE } else { vk::AttachmentStoreOp::DONT_CARE }
}

pub(super) fn color_attachment<'a>(target: &ColorTarget<'_>) -> vk::RenderingAttachmentInfo<'a> {
    let float32 = if let Load::Clear(color) = target.load { color } else { [0.0; 4] };
    let layout = barrier::layout(ImageUse::ColorTarget);
    let info = vk::RenderingAttachmentInfo::default()
        .image_view(target.image.0.level_0_view)
        .image_layout(layout)
        .load_op(load_op(target.load))
        .store_op(store_op(target.store))
        .clear_value(vk::ClearValue { color: vk::ClearColorValue { float32 } });
    match target.resolve {
        None => info,
        Some(resolve) => info
            .resolve_mode(vk::ResolveModeFlags::AVERAGE)
            .resolve_image_view(resolve.0.level_0_view)
            .resolve_image_layout(layout),
    }
}

pub(super) fn depth_attachment<'a>(target: DepthTarget<'_>) -> vk::RenderingAttachmentInfo<'a> {
    let depth = if let Load::Clear([depth, ..]) = target.load { depth } else { 0.0 };
    vk::RenderingAttachmentInfo::default()
        .image_view(target.image.0.level_0_view)
        .image_layout(barrier::layout(ImageUse::DepthTarget))
        .load_op(load_op(target.load))
        .store_op(store_op(target.store))
        .clear_value(vk::ClearValue { depth_stencil: vk::ClearDepthStencilValue { depth, stencil: 0 } })
}
