//! Descriptor set layouts and pipeline layouts, each kind created once per device, and the descriptor sets of each layout,
//! which are recycled.

use super::calls::Device;
use super::error::GpuError;
use super::interface::{Interface, SET_COUNT, Slot};
use ash::vk;
use std::collections::HashMap;

/// What makes two sets the same: their bindings, by number, name and type.
type SetKey = Vec<(u32, &'static str, i32)>;
type LayoutKey = (Vec<vk::DescriptorSetLayout>, u32, u32);

/// Sets of a pool.
const SETS_PER_POOL: u32 = 16;

/// All layouts of a device; few, so they live as long as it does.
#[derive(Default)]
pub(crate) struct Layouts {
    sets: HashMap<SetKey, vk::DescriptorSetLayout>,
    pipelines: HashMap<LayoutKey, vk::PipelineLayout>,
    /// Sets that nobody uses, by layout.
    free: HashMap<vk::DescriptorSetLayout, Vec<vk::DescriptorSet>>,
    pools: Vec<vk::DescriptorPool>,
}

/// Every binding is visible to every stage, so that a group fits all pipelines that name the same things.
const STAGES: vk::ShaderStageFlags = vk::ShaderStageFlags::from_raw(
    vk::ShaderStageFlags::VERTEX.as_raw()
        | vk::ShaderStageFlags::FRAGMENT.as_raw()
        | vk::ShaderStageFlags::COMPUTE.as_raw(),
);

impl Layouts {
    /// Set layouts and pipeline layout of an interface.
    pub(crate) fn of(
        &mut self,
        device: &Device,
        name: &str,
        interface: &Interface,
    ) -> Result<([vk::DescriptorSetLayout; SET_COUNT], vk::PipelineLayout), GpuError> {
        let mut sets = [vk::DescriptorSetLayout::null(); SET_COUNT];
        for (layout, slots) in sets.iter_mut().zip(&interface.sets) {
            *layout = self.set(device, name, slots)?;
        }
        let used = interface.sets.iter().rposition(|slots| !slots.is_empty()).map_or(0, |last| last + 1);
        let key = (sets[..used].to_vec(), interface.push_bytes, interface.push_stages.as_raw());
        if let Some(layout) = self.pipelines.get(&key) {
            return Ok((sets, *layout));
        }
        let ranges = [vk::PushConstantRange::default().stage_flags(interface.push_stages).size(interface.push_bytes)];
        let mut info = vk::PipelineLayoutCreateInfo::default().set_layouts(&key.0);
        if interface.push_bytes > 0 {
            info = info.push_constant_ranges(&ranges);
        }
        // SAFETY: the set layouts are alive; sets and push bytes are within the limits that `Interface` checks.
        let layout = unsafe { device.create_pipeline_layout(&info, None) }
            .map_err(|result| GpuError::from_vk("creating the layout of pipeline", name, result))?;
        self.pipelines.insert(key, layout);
        Ok((sets, layout))
    }

    /// A set of a layout with these slots: one that was given back, or of a new pool. Its contents are anything.
    pub(crate) fn take_set(
        &mut self,
        device: &Device,
        name: &str,
        layout: vk::DescriptorSetLayout,
        slots: &[Slot],
    ) -> Result<vk::DescriptorSet, GpuError> {
        let free = self.free.entry(layout).or_default();
        if let Some(set) = free.pop() {
            return Ok(set);
        }
        let failed = |result| GpuError::from_vk("creating bind group", name, result);
        let size = |slot: &Slot| vk::DescriptorPoolSize::default().ty(slot.descriptor).descriptor_count(SETS_PER_POOL);
        let sizes: Vec<_> = slots.iter().map(size).collect();
        let info = vk::DescriptorPoolCreateInfo::default().max_sets(SETS_PER_POOL).pool_sizes(&sizes);
        // SAFETY: sets and counts of at least 1 are asked for.
        let pool = unsafe { device.create_descriptor_pool(&info, None) }.map_err(failed)?;
        self.pools.push(pool);
        let layouts = [layout; SETS_PER_POOL as usize];
        let info = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
        // SAFETY: the pool has room for exactly these sets.
        free.extend(unsafe { device.allocate_descriptor_sets(&info) }.map_err(failed)?);
        free.pop().ok_or_else(|| failed(vk::Result::ERROR_OUT_OF_POOL_MEMORY))
    }

    /// The set is no longer used, by no submission either.
    pub(crate) fn give_back(&mut self, layout: vk::DescriptorSetLayout, set: vk::DescriptorSet) {
        self.free.entry(layout).or_default().push(set);
    }

    fn set(&mut self, device: &Device, name: &str, slots: &[Slot]) -> Result<vk::DescriptorSetLayout, GpuError> {
        let key: SetKey = slots.iter().map(|slot| (slot.binding, slot.name, slot.descriptor.as_raw())).collect();
        if let Some(layout) = self.sets.get(&key) {
            return Ok(*layout);
        }
        let bindings: Vec<_> = slots
            .iter()
            .map(|slot| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(slot.binding)
                    .descriptor_type(slot.descriptor)
                    .descriptor_count(1)
                    .stage_flags(STAGES)
            })
            .collect();
        let info = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: binding numbers are unique within a set, as `Interface` checks.
        let layout = unsafe { device.create_descriptor_set_layout(&info, None) }
            .map_err(|result| GpuError::from_vk("creating a set layout of pipeline", name, result))?;
        self.sets.insert(key, layout);
        Ok(layout)
    }

    pub(crate) fn destroy(&mut self, device: &Device) {
        for pool in self.pools.drain(..) {
            // SAFETY: bind groups hold the context, so none uses a set any more; sets go with their pool.
            unsafe { device.destroy_descriptor_pool(pool, None) };
        }
        for (_, layout) in self.pipelines.drain() {
            // SAFETY: pipelines and encoders hold the context, so none refers to it any more.
            unsafe { device.destroy_pipeline_layout(layout, None) };
        }
        for (_, layout) in self.sets.drain() {
            // SAFETY: as above, for bind groups.
            unsafe { device.destroy_descriptor_set_layout(layout, None) };
        }
    }
}
