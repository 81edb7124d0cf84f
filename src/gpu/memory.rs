//! Device memory: one allocator, and a table of who holds what.

use super::calls::Device;
use super::error::GpuError;
use ash::vk;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme, Allocator, AllocatorCreateDesc};
use gpu_allocator::{AllocationError, AllocationSizes, AllocatorDebugSettings, MemoryLocation};
use std::collections::BTreeMap;

/// Memory blocks that the allocator takes from the driver, bytes.
const BLOCK_BYTES: u64 = 64 << 20;

/// Where a buffer lives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Memory {
    /// Fast for the device, not mapped; filled by [`Upload`](super::Upload).
    Device,
    /// Written by the host, read by the device.
    Upload,
    /// Written by the device, read by the host.
    Readback,
}

/// What an object's memory is for, by the uses that it was created with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum MemoryUse {
    /// Images that are drawn into.
    Targets,
    /// Images that are only read.
    Textures,
    /// Vertex streams and indices.
    Geometry,
    /// Other buffers of the device: materials, what the deform pass reads, counters.
    Data,
    /// What the host writes anew: the frame's own values, and staging memory.
    Upload,
    /// What comes back to the host.
    Readback,
}

impl MemoryUse {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Targets => "targets",
            Self::Textures => "textures",
            Self::Geometry => "geometry",
            Self::Data => "data",
            Self::Upload => "upload",
            Self::Readback => "readback",
        }
    }

    pub(crate) fn of_image(usage: vk::ImageUsageFlags) -> Self {
        let drawn = vk::ImageUsageFlags::COLOR_ATTACHMENT | vk::ImageUsageFlags::DEPTH_STENCIL_ATTACHMENT;
        if usage.intersects(drawn) { Self::Targets } else { Self::Textures }
    }

    pub(crate) fn of_buffer(usage: vk::BufferUsageFlags, memory: Memory) -> Self {
        let geometry = vk::BufferUsageFlags::VERTEX_BUFFER | vk::BufferUsageFlags::INDEX_BUFFER;
        match memory {
            Memory::Upload => Self::Upload,
            Memory::Readback => Self::Readback,
            Memory::Device if usage.intersects(geometry) => Self::Geometry,
            Memory::Device => Self::Data,
        }
    }
}

/// What the live objects hold. Objects that the device still uses count until it is done.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MemoryReport {
    /// Bytes now.
    pub device_bytes: u64,
    /// Largest number of bytes so far.
    pub peak_bytes: u64,
    /// Memory blocks that these lie in, each one `vkAllocateMemory`.
    pub blocks: usize,
    /// Bytes of the blocks.
    pub block_bytes: u64,
    /// Bytes by object name, names ascending; objects of one name are summed.
    pub by_owner: Vec<(String, u64)>,
    /// Bytes by use, in the order of [`MemoryUse`]; uses without objects are left out.
    pub by_use: Vec<(MemoryUse, u64)>,
}

/// An allocation and its row in the table.
pub(crate) struct Block {
    pub(crate) allocation: Allocation,
    row: u64,
}

/// The allocator and the table.
pub(crate) struct Heap {
    allocator: Allocator,
    rows: BTreeMap<u64, (String, MemoryUse, u64)>,
    next_row: u64,
    bytes: u64,
    peak_bytes: u64,
    capacity_bytes: u64,
}

impl Heap {
    pub(crate) fn new(
        instance: &ash::Instance,
        device: &Device,
        physical_device: vk::PhysicalDevice,
        capacity_bytes: u64,
    ) -> Result<Self, GpuError> {
        let mut debug_settings = AllocatorDebugSettings::default();
        debug_settings.log_leaks_on_shutdown = false;
        let allocator = Allocator::new(&AllocatorCreateDesc {
            instance: instance.clone(),
            device: device.uncounted().clone(),
            physical_device,
            debug_settings,
            buffer_device_address: false,
            allocation_sizes: AllocationSizes::new(BLOCK_BYTES, BLOCK_BYTES),
        })
        .map_err(|source| GpuError::Allocation { name: "allocator".into(), source })?;
        Ok(Self { allocator, rows: BTreeMap::new(), next_row: 0, bytes: 0, peak_bytes: 0, capacity_bytes })
    }

    pub(crate) fn allocate(
        &mut self,
        name: &str,
        requirements: vk::MemoryRequirements,
        memory: Memory,
        memory_use: MemoryUse,
        linear: bool,
    ) -> Result<Block, GpuError> {
        let out_of_memory = || GpuError::OutOfMemory { name: name.to_owned() };
        // Software drivers promise more than the machine has; the heap's size is the honest bound.
        if self.bytes.saturating_add(requirements.size) > self.capacity_bytes {
            return Err(out_of_memory());
        }
        let location = match memory {
            Memory::Device => MemoryLocation::GpuOnly,
            Memory::Upload => MemoryLocation::CpuToGpu,
            Memory::Readback => MemoryLocation::GpuToCpu,
        };
        let allocation_scheme = AllocationScheme::GpuAllocatorManaged;
        let desc = AllocationCreateDesc { name, requirements, location, linear, allocation_scheme };
        let allocation = self.allocator.allocate(&desc).map_err(|source| match source {
            AllocationError::OutOfMemory => out_of_memory(),
            source => GpuError::Allocation { name: name.to_owned(), source },
        })?;
        let bytes = allocation.size();
        let row = self.next_row;
        self.next_row += 1;
        self.rows.insert(row, (name.to_owned(), memory_use, bytes));
        self.bytes += bytes;
        self.peak_bytes = self.peak_bytes.max(self.bytes);
        Ok(Block { allocation, row })
    }

    pub(crate) fn free(&mut self, block: Block) {
        if let Some((_, _, bytes)) = self.rows.remove(&block.row) {
            self.bytes -= bytes;
        }
        if let Err(error) = self.allocator.free(block.allocation) {
            tracing::error!("freeing device memory: {error}");
        }
    }

    pub(crate) fn report(&self) -> MemoryReport {
        let mut owners: BTreeMap<&str, u64> = BTreeMap::new();
        let mut uses: BTreeMap<MemoryUse, u64> = BTreeMap::new();
        for (name, memory_use, bytes) in self.rows.values() {
            *owners.entry(name).or_default() += bytes;
            *uses.entry(*memory_use).or_default() += bytes;
        }
        let blocks = self.allocator.generate_report();
        MemoryReport {
            device_bytes: self.bytes,
            peak_bytes: self.peak_bytes,
            blocks: blocks.blocks.len(),
            block_bytes: blocks.total_capacity_bytes,
            by_owner: owners.into_iter().map(|(name, bytes)| (name.to_owned(), bytes)).collect(),
            by_use: uses.into_iter().collect(),
        }
    }
}
