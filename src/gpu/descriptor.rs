//! Bind groups: descriptor sets filled by name. The sets themselves are recycled.

use super::barrier::{ImageUse, layout};
use super::buffer::Buffer;
use super::device::{Context, Gpu, lock};
use super::error::GpuError;
use super::image::{Image, ImageInner};
use super::interface::{SET_COUNT, Slot};
use super::pipeline::Pipeline;
use super::sampler::Sampler;
use ash::vk;
use std::any::Any;
use std::sync::Arc;

/// What a binding may refer to.
#[derive(Clone, Copy)]
pub enum Resource<'a> {
    /// A buffer: the whole of it as storage block; as uniform block, as much as the block has from an offset on that is
    /// given when the group is bound.
    Buffer(&'a Buffer),
    /// An image that is read through a sampler, all levels.
    Texture(&'a Image),
    /// An image that is loaded and stored, level 0.
    StorageImage(&'a Image),
    /// A sampler.
    Sampler(&'a Sampler),
}

/// A filled descriptor set. Keeps alive what it refers to.
pub struct BindGroup(pub(crate) Arc<GroupInner>);

pub(crate) struct GroupInner {
    context: Arc<Context>,
    pub(crate) raw: vk::DescriptorSet,
    pub(crate) layout: vk::DescriptorSetLayout,
    pub(crate) name: String,
    /// Images and the use that the shaders make of them.
    pub(crate) images: Vec<(Arc<ImageInner>, ImageUse)>,
    /// Of each uniform block, by binding: the largest offset at which its buffer holds all of it, bytes.
    pub(crate) last_offsets: Vec<u64>,
    _kept: Vec<Arc<dyn Any + Send + Sync>>,
}

impl BindGroup {
    /// Name given at creation.
    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// Uniform blocks in it: as many offsets may be given when it is bound.
    pub fn uniform_blocks(&self) -> usize {
        self.0.last_offsets.len()
    }
}

/// A descriptor write whose info structures need a stable address.
enum Info {
    Buffer([vk::DescriptorBufferInfo; 1]),
    Image([vk::DescriptorImageInfo; 1]),
}

impl Gpu {
    /// Fills set `set` of `pipeline` with the `resources` that it names; names that it does not have are ignored. The
    /// group binds to every pipeline whose set has the same bindings, names and types.
    ///
    /// # Errors
    /// [`GpuError::Interface`] naming pipeline, set and binding for a missing name, a resource of the wrong kind or
    /// usage, or a buffer that is too small or too large; [`GpuError::OutOfMemory`].
    pub fn bind_group(
        &self,
        pipeline: &Pipeline,
        set: u32,
        name: &str,
        resources: &[(&str, Resource<'_>)],
    ) -> Result<BindGroup, GpuError> {
        let context = self.context();
        let inner = &pipeline.0;
        let problem = |problem: String| GpuError::Interface { pipeline: inner.name.clone(), problem };
        let index = set as usize;
        let (Some(slots), Some(set_layout)) = (inner.interface.sets.get(index), inner.set_layouts.get(index)) else {
            return Err(problem(format!("set {set} of group '{name}': sets are 0 to {}", SET_COUNT - 1)));
        };

        let mut infos = Vec::with_capacity(slots.len());
        let mut images = Vec::new();
        let mut kept: Vec<Arc<dyn Any + Send + Sync>> = Vec::new();
        for slot in slots {
            let place = format!("set {set} binding {} '{}'", slot.binding, slot.name);
            let (_, resource) = resources
                .iter()
                .find(|(offered, _)| *offered == slot.name)
                .ok_or_else(|| problem(format!("{place} has no resource in group '{name}'")))?;
            infos.push(info(context, slot, *resource).map_err(|what| problem(format!("{place}: {what}")))?);
            match resource {
                Resource::Buffer(buffer) => kept.push(buffer.0.clone()),
                Resource::Texture(image) => images.push((image.0.clone(), ImageUse::Sampled)),
                Resource::StorageImage(image) => images.push((image.0.clone(), ImageUse::Storage)),
                Resource::Sampler(sampler) => kept.push(sampler.0.clone()),
            }
        }

        let mut last_offsets = Vec::new();
        for slot in slots.iter().filter(|slot| slot.descriptor == vk::DescriptorType::UNIFORM_BUFFER_DYNAMIC) {
            let given = resources.iter().find(|(offered, _)| *offered == slot.name);
            if let Some((_, Resource::Buffer(buffer))) = given {
                last_offsets.push(buffer.bytes() - slot.bytes);
            }
        }
        let raw = lock(&context.layouts).take_set(&context.device, name, *set_layout, slots)?;
        // From here on the inner value gives the set back on every path.
        let group = GroupInner {
            context: context.clone(),
            raw,
            layout: *set_layout,
            name: name.to_owned(),
            images,
            last_offsets,
            _kept: kept,
        };
        context.set_name(group.raw, name);
        let writes: Vec<_> = slots
            .iter()
            .zip(&infos)
            .map(|(slot, info)| {
                let write = vk::WriteDescriptorSet::default()
                    .dst_set(group.raw)
                    .dst_binding(slot.binding)
                    .descriptor_type(slot.descriptor);
                match info {
                    Info::Buffer(buffer) => write.buffer_info(buffer),
                    Info::Image(image) => write.image_info(image),
                }
            })
            .collect();
        // SAFETY: kinds, usages, ranges and alignment were checked; the resources are alive and kept.
        unsafe { context.device.update_descriptor_sets(&writes, &[]) };
        Ok(BindGroup(Arc::new(group)))
    }
}

/// The descriptor for a slot, or what is wrong with the resource.
fn info(context: &Context, slot: &Slot, resource: Resource<'_>) -> Result<Info, String> {
    use vk::DescriptorType as T;
    match (slot.descriptor, resource) {
        (T::UNIFORM_BUFFER_DYNAMIC | T::STORAGE_BUFFER, Resource::Buffer(buffer)) => buffer_info(context, slot, buffer),
        (T::SAMPLED_IMAGE, Resource::Texture(image)) if slot.is_cube != (image.0.layers == 6) => {
            let (asked, given) = if slot.is_cube { ("a cube", "flat") } else { ("a flat texture", "a cube") };
            Err(format!("the shader has {asked} and '{}' is {given}", image.name()))
        }
        (T::SAMPLED_IMAGE, Resource::Texture(image)) => {
            image_info(image, image.0.view, vk::ImageUsageFlags::SAMPLED, ImageUse::Sampled)
        }
        (T::STORAGE_IMAGE, Resource::StorageImage(image)) => {
            image_info(image, image.0.level_0_view, vk::ImageUsageFlags::STORAGE, ImageUse::Storage)
        }
        (T::SAMPLER, Resource::Sampler(sampler)) => {
            Ok(Info::Image([vk::DescriptorImageInfo::default().sampler(sampler.0.raw)]))
        }
        (expected, given) => {
            let given = match given {
                Resource::Buffer(_) => "a buffer",
                Resource::Texture(_) => "a texture",
                Resource::StorageImage(_) => "a storage image",
                Resource::Sampler(_) => "a sampler",
            };
            Err(format!("the shader has {expected:?} and the group offers {given}"))
        }
    }
}

fn buffer_info(context: &Context, slot: &Slot, buffer: &Buffer) -> Result<Info, String> {
    let info = &context.info;
    let (name, bytes) = (buffer.name(), buffer.bytes());
    let (usage, range, limit) = match slot.descriptor {
        vk::DescriptorType::UNIFORM_BUFFER_DYNAMIC => {
            (vk::BufferUsageFlags::UNIFORM_BUFFER, slot.bytes, info.max_uniform_bytes)
        }
        _ => (vk::BufferUsageFlags::STORAGE_BUFFER, bytes, info.max_storage_bytes),
    };
    if !buffer.0.usage.contains(usage) {
        return Err(format!("buffer '{name}' lacks {usage:?}"));
    }
    if bytes < slot.bytes {
        return Err(format!("buffer '{name}' gives {bytes} bytes and the block has {}", slot.bytes));
    }
    if range > limit {
        return Err(format!("{range} bytes of buffer '{name}' are beyond this device's {limit}"));
    }
    Ok(Info::Buffer([vk::DescriptorBufferInfo { buffer: buffer.0.raw, offset: 0, range }]))
}

fn image_info(
    image: &Image,
    view: vk::ImageView,
    usage: vk::ImageUsageFlags,
    image_use: ImageUse,
) -> Result<Info, String> {
    if !image.0.usage.contains(usage) {
        return Err(format!("image '{}' lacks {usage:?}", image.name()));
    }
    Ok(Info::Image([vk::DescriptorImageInfo::default().image_view(view).image_layout(layout(image_use))]))
}

impl Drop for GroupInner {
    fn drop(&mut self) {
        // The last owner is gone, submissions in flight among them.
        lock(&self.context.layouts).give_back(self.layout, self.raw);
    }
}
