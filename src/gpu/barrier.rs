//! Which stages and accesses a use means, as pure functions ("Vulkan 1.3", chapter 7, Synchronization).

use ash::vk;
use vk::{AccessFlags2 as A, PipelineStageFlags2 as S};

/// How an image is used; each use has one layout, one set of stages and accesses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageUse {
    /// Never used; its contents are undefined.
    Undefined,
    /// Colour attachment or resolve target.
    ColorTarget,
    /// Depth attachment.
    DepthTarget,
    /// Read by any shader.
    Sampled,
    /// Storage image of any shader.
    Storage,
    /// Source of a copy.
    CopySource,
    /// Target of a copy.
    CopyTarget,
    /// The host's business, in that layout.
    Host(vk::ImageLayout),
}

/// Kind of a pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PassKind {
    Render,
    Compute,
    Copy,
}

/// Kinds of the passes recorded so far.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct PassKinds {
    render: bool,
    compute: bool,
    copy: bool,
}

impl PassKinds {
    pub(crate) fn insert(&mut self, kind: PassKind) {
        match kind {
            PassKind::Render => self.render = true,
            PassKind::Compute => self.compute = true,
            PassKind::Copy => self.copy = true,
        }
    }

    fn iter(self) -> impl Iterator<Item = PassKind> {
        [(self.render, PassKind::Render), (self.compute, PassKind::Compute), (self.copy, PassKind::Copy)]
            .into_iter()
            .filter_map(|(is_present, kind)| is_present.then_some(kind))
    }
}

const SHADERS: S = S::from_raw(S::VERTEX_SHADER.as_raw() | S::FRAGMENT_SHADER.as_raw() | S::COMPUTE_SHADER.as_raw());

/// Stages, reads, writes and layout of a use.
struct UseMasks {
    stages: S,
    reads: A,
    writes: A,
    layout: vk::ImageLayout,
}

fn masks(image_use: ImageUse) -> UseMasks {
    let (stages, reads, writes, layout) = match image_use {
        ImageUse::Undefined => (S::NONE, A::NONE, A::NONE, vk::ImageLayout::UNDEFINED),
        ImageUse::ColorTarget => (
            S::COLOR_ATTACHMENT_OUTPUT,
            A::COLOR_ATTACHMENT_READ,
            A::COLOR_ATTACHMENT_WRITE,
            vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
        ),
        ImageUse::DepthTarget => (
            S::EARLY_FRAGMENT_TESTS | S::LATE_FRAGMENT_TESTS,
            A::DEPTH_STENCIL_ATTACHMENT_READ,
            A::DEPTH_STENCIL_ATTACHMENT_WRITE,
            vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
        ),
        ImageUse::Sampled => (SHADERS, A::SHADER_SAMPLED_READ, A::NONE, vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL),
        ImageUse::Storage => (SHADERS, A::SHADER_STORAGE_READ, A::SHADER_STORAGE_WRITE, vk::ImageLayout::GENERAL),
        ImageUse::CopySource => (S::ALL_TRANSFER, A::TRANSFER_READ, A::NONE, vk::ImageLayout::TRANSFER_SRC_OPTIMAL),
        ImageUse::CopyTarget => (S::ALL_TRANSFER, A::NONE, A::TRANSFER_WRITE, vk::ImageLayout::TRANSFER_DST_OPTIMAL),
        ImageUse::Host(layout) => (S::ALL_COMMANDS, A::MEMORY_READ, A::MEMORY_WRITE, layout),
    };
    UseMasks { stages, reads, writes, layout }
}

/// Layout in which an image is for a use.
pub(crate) fn layout(image_use: ImageUse) -> vk::ImageLayout {
    masks(image_use).layout
}

/// One dependency; layouts are equal for a pure memory dependency.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Dependency {
    pub(crate) src_stages: S,
    pub(crate) src_access: A,
    pub(crate) dst_stages: S,
    pub(crate) dst_access: A,
    pub(crate) old_layout: vk::ImageLayout,
    pub(crate) new_layout: vk::ImageLayout,
}

/// What must stand between two uses of an image; `None` where the second use may simply follow.
///
/// Reads need no visibility from reads, only order before a later write. Storage after storage is left to the memory
/// barrier at the start of each pass, which covers images as well.
pub(crate) fn between_uses(before: ImageUse, after: ImageUse) -> Option<Dependency> {
    let follows_freely = matches!(after, ImageUse::Sampled | ImageUse::Storage | ImageUse::CopySource);
    if before == after && follows_freely {
        return None;
    }
    let (before, after) = (masks(before), masks(after));
    Some(Dependency {
        src_stages: before.stages,
        src_access: before.writes,
        dst_stages: after.stages,
        dst_access: after.reads | after.writes,
        old_layout: before.layout,
        new_layout: after.layout,
    })
}

/// Stages, reads and writes of buffers in a pass.
fn buffer_masks(kind: PassKind) -> (S, A, A) {
    let shader_reads = A::UNIFORM_READ | A::SHADER_STORAGE_READ | A::SHADER_SAMPLED_READ;
    match kind {
        PassKind::Render => (
            S::VERTEX_ATTRIBUTE_INPUT | S::INDEX_INPUT | S::VERTEX_SHADER | S::FRAGMENT_SHADER,
            A::VERTEX_ATTRIBUTE_READ | A::INDEX_READ | shader_reads,
            A::SHADER_STORAGE_WRITE,
        ),
        PassKind::Compute => (S::COMPUTE_SHADER, shader_reads, A::SHADER_STORAGE_WRITE),
        PassKind::Copy => (S::ALL_TRANSFER, A::TRANSFER_READ, A::TRANSFER_WRITE),
    }
}

/// The memory barrier before a pass of kind `next` in a command buffer that holds passes of the kinds `before`.
///
/// All earlier kinds count, not only the last: visibility does not chain through a pass of another kind.
pub(crate) fn before_pass(before: PassKinds, next: PassKind) -> Option<Dependency> {
    let mut src = (S::NONE, A::NONE);
    for kind in before.iter() {
        let (stages, _, writes) = buffer_masks(kind);
        src = (src.0 | stages, src.1 | writes);
    }
    if src.0.is_empty() {
        return None;
    }
    let (dst_stages, reads, writes) = buffer_masks(next);
    Some(memory(src.0, src.1, dst_stages, reads | writes))
}

/// At the start of a command buffer: all that was submitted before is done and visible.
pub(crate) fn at_start() -> Dependency {
    memory(S::ALL_COMMANDS, A::MEMORY_WRITE, S::ALL_COMMANDS, A::MEMORY_READ | A::MEMORY_WRITE)
}

/// Order alone, no memory.
pub(crate) fn order() -> Dependency {
    memory(S::ALL_COMMANDS, A::NONE, S::ALL_COMMANDS, A::NONE)
}

/// At the end of a command buffer: the host may read what was written.
pub(crate) fn at_end() -> Dependency {
    memory(S::ALL_COMMANDS, A::MEMORY_WRITE, S::HOST, A::HOST_READ)
}

fn memory(src_stages: S, src_access: A, dst_stages: S, dst_access: A) -> Dependency {
    let layout = vk::ImageLayout::UNDEFINED;
    Dependency { src_stages, src_access, dst_stages, dst_access, old_layout: layout, new_layout: layout }
}

impl Dependency {
    pub(crate) fn memory_barrier(&self) -> vk::MemoryBarrier2<'static> {
        vk::MemoryBarrier2::default()
            .src_stage_mask(self.src_stages)
            .src_access_mask(self.src_access)
            .dst_stage_mask(self.dst_stages)
            .dst_access_mask(self.dst_access)
    }

    pub(crate) fn image_barrier(
        &self,
        image: vk::Image,
        aspects: vk::ImageAspectFlags,
    ) -> vk::ImageMemoryBarrier2<'static> {
        vk::ImageMemoryBarrier2::default()
            .src_stage_mask(self.src_stages)
            .src_access_mask(self.src_access)
            .dst_stage_mask(self.dst_stages)
            .dst_access_mask(self.dst_access)
            .old_layout(self.old_layout)
            .new_layout(self.new_layout)
            .src_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .dst_queue_family_index(vk::QUEUE_FAMILY_IGNORED)
            .image(image)
            .subresource_range(
                vk::ImageSubresourceRange::default()
                    .aspect_mask(aspects)
                    .level_count(vk::REMAINING_MIP_LEVELS)
                    .layer_count(vk::REMAINING_ARRAY_LAYERS),
            )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawn_target_becomes_readable() {
        let dependency = between_uses(ImageUse::ColorTarget, ImageUse::Sampled).unwrap();
        assert_eq!(dependency.src_stages, S::COLOR_ATTACHMENT_OUTPUT);
        assert_eq!(dependency.src_access, A::COLOR_ATTACHMENT_WRITE);
        assert!(dependency.dst_stages.contains(S::FRAGMENT_SHADER | S::COMPUTE_SHADER));
        assert_eq!(dependency.dst_access, A::SHADER_SAMPLED_READ);
        assert_eq!(dependency.new_layout, vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
    }

    #[test]
    fn reading_again_needs_nothing_but_drawing_again_does() {
        assert_eq!(between_uses(ImageUse::Sampled, ImageUse::Sampled), None);
        assert_eq!(between_uses(ImageUse::CopySource, ImageUse::CopySource), None);
        assert!(between_uses(ImageUse::ColorTarget, ImageUse::ColorTarget).is_some());
        assert!(between_uses(ImageUse::CopyTarget, ImageUse::CopyTarget).is_some());
    }

    #[test]
    fn a_write_after_a_read_waits_without_a_cache_flush() {
        let dependency = between_uses(ImageUse::Sampled, ImageUse::ColorTarget).unwrap();
        assert_eq!(dependency.src_access, A::NONE);
        assert!(dependency.src_stages.contains(S::FRAGMENT_SHADER));
    }

    #[test]
    fn a_fresh_image_waits_for_nothing() {
        let dependency = between_uses(ImageUse::Undefined, ImageUse::DepthTarget).unwrap();
        assert_eq!((dependency.src_stages, dependency.src_access), (S::NONE, A::NONE));
        assert_eq!(dependency.old_layout, vk::ImageLayout::UNDEFINED);
    }

    #[test]
    fn compute_output_is_visible_to_vertex_input_even_past_a_copy() {
        let mut before = PassKinds::default();
        before.insert(PassKind::Compute);
        before.insert(PassKind::Copy);
        let dependency = before_pass(before, PassKind::Render).unwrap();
        assert!(dependency.src_stages.contains(S::COMPUTE_SHADER));
        assert!(dependency.src_access.contains(A::SHADER_STORAGE_WRITE | A::TRANSFER_WRITE));
        assert!(dependency.dst_stages.contains(S::VERTEX_ATTRIBUTE_INPUT));
        assert!(dependency.dst_access.contains(A::VERTEX_ATTRIBUTE_READ | A::INDEX_READ));
    }

    #[test]
    fn the_first_pass_needs_no_barrier_of_its_own() {
        assert_eq!(before_pass(PassKinds::default(), PassKind::Render), None);
        assert!(at_end().dst_access.contains(A::HOST_READ));
        assert!(at_start().dst_access.contains(A::MEMORY_READ));
    }
}
