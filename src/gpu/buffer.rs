//! Buffers.

use super::device::{Context, Gpu, lock};
use super::error::GpuError;
use super::memory::{Block, Memory, MemoryUse};
use ash::vk;
use std::sync::{Arc, Mutex};

/// A buffer of bytes.
pub struct Buffer(pub(crate) Arc<BufferInner>);

pub(crate) struct BufferInner {
    context: Arc<Context>,
    pub(crate) raw: vk::Buffer,
    pub(crate) name: String,
    pub(crate) bytes: u64,
    pub(crate) usage: vk::BufferUsageFlags,
    memory: Memory,
    block: Mutex<Option<Block>>,
}

impl Gpu {
    /// Creates a buffer of `bytes` (at least 1). Copies from and to it are always allowed, as its `memory` makes sense.
    ///
    /// # Errors
    /// [`GpuError::Range`] for 0 bytes, [`GpuError::OutOfMemory`], [`GpuError::Allocation`].
    pub fn buffer(
        &self,
        name: &str,
        bytes: u64,
        usage: vk::BufferUsageFlags,
        memory: Memory,
    ) -> Result<Buffer, GpuError> {
        if bytes == 0 {
            return Err(GpuError::Range { name: name.to_owned(), problem: "a buffer has at least 1 byte".to_owned() });
        }
        let context = self.context().clone();
        let usage = usage
            | match memory {
                Memory::Device => vk::BufferUsageFlags::TRANSFER_DST | vk::BufferUsageFlags::TRANSFER_SRC,
                Memory::Upload => vk::BufferUsageFlags::TRANSFER_SRC,
                Memory::Readback => vk::BufferUsageFlags::TRANSFER_DST,
            };
        let info = vk::BufferCreateInfo::default().size(bytes).usage(usage);
        // SAFETY: size is not zero; the usage has at least one bit.
        let raw = unsafe { context.device.create_buffer(&info, None) }
            .map_err(|result| GpuError::from_vk("creating buffer", name, result))?;
        // From here on the inner value frees the handle on every path.
        let inner = Arc::new(BufferInner {
            context: context.clone(),
            raw,
            name: name.to_owned(),
            bytes,
            usage,
            memory,
            block: Mutex::new(None),
        });
        context.set_name(raw, name);
        // SAFETY: the buffer was just created.
        let requirements = unsafe { context.device.get_buffer_memory_requirements(raw) };
        let memory_use = MemoryUse::of_buffer(usage, memory);
        let block = lock(&context.heap).allocate(name, requirements, memory, memory_use, true)?;
        // SAFETY: the memory belongs to `allocation` for as long as the block lives.
        let device_memory = unsafe { block.allocation.memory() };
        let offset = block.allocation.offset();
        *lock(&inner.block) = Some(block);
        // SAFETY: the range satisfies the buffer's requirements and is bound once.
        unsafe { context.device.bind_buffer_memory(raw, device_memory, offset) }
            .map_err(|result| GpuError::from_vk("binding memory of", name, result))?;
        Ok(Buffer(inner))
    }
}

impl Buffer {
    /// Size in bytes.
    pub fn bytes(&self) -> u64 {
        self.0.bytes
    }

    /// A number that no other live buffer has.
    pub fn place(&self) -> usize {
        Arc::as_ptr(&self.0).addr()
    }

    /// Name given at creation.
    pub fn name(&self) -> &str {
        &self.0.name
    }

    /// Writes `values` at `byte_offset` of a [`Memory::Upload`] buffer. The device sees it in later submissions; a
    /// range that a submission in flight reads must not be written.
    ///
    /// # Errors
    /// [`GpuError::Range`] when it does not fit or the memory is of another kind.
    pub fn write<T: bytemuck::NoUninit>(&self, byte_offset: u64, values: &[T]) -> Result<(), GpuError> {
        let bytes: &[u8] = bytemuck::cast_slice(values);
        let inner = &self.0;
        if inner.memory != Memory::Upload {
            return Err(inner.range("only Upload memory can be written by the host".to_owned()));
        }
        let end = byte_offset.checked_add(bytes.len() as u64).filter(|end| *end <= inner.bytes);
        let problem = || inner.range(format!("{} bytes at {byte_offset} do not fit in {}", bytes.len(), inner.bytes));
        let end = end.ok_or_else(problem)? as usize;
        let mut block = lock(&inner.block);
        let mapped = block.as_mut().and_then(|block| block.allocation.mapped_slice_mut()).ok_or_else(problem)?;
        mapped.get_mut(byte_offset as usize..end).ok_or_else(problem)?.copy_from_slice(bytes);
        inner.context.device.count_upload(bytes.len() as u64);
        Ok(())
    }

    /// All values of a [`Memory::Readback`] buffer. Wait for the submission that wrote it first.
    ///
    /// # Errors
    /// [`GpuError::Range`] when the size is no multiple of `T` or the memory is of another kind.
    pub fn read<T: bytemuck::AnyBitPattern>(&self) -> Result<Vec<T>, GpuError> {
        let inner = &self.0;
        let problem = || inner.range(format!("{} bytes cannot be read as values of {}", inner.bytes, size_of::<T>()));
        if inner.memory != Memory::Readback {
            return Err(inner.range("only Readback memory can be read by the host".to_owned()));
        }
        if size_of::<T>() == 0 || !inner.bytes.is_multiple_of(size_of::<T>() as u64) {
            return Err(problem());
        }
        let block = lock(&inner.block);
        let mapped = block.as_ref().and_then(|block| block.allocation.mapped_slice()).ok_or_else(problem)?;
        let bytes = mapped.get(..inner.bytes as usize).ok_or_else(problem)?;
        Ok(match bytemuck::try_cast_slice(bytes) {
            Ok(values) => values.to_vec(),
            Err(_) => bytes.chunks_exact(size_of::<T>()).map(bytemuck::pod_read_unaligned).collect(),
        })
    }
}

impl BufferInner {
    pub(crate) fn range(&self, problem: String) -> GpuError {
        GpuError::Range { name: self.name.clone(), problem }
    }
}

impl Drop for BufferInner {
    fn drop(&mut self) {
        // SAFETY: the last owner is gone, submissions in flight among them.
        unsafe { self.context.device.destroy_buffer(self.raw, None) };
        if let Some(block) = lock(&self.block).take() {
            lock(&self.context.heap).free(block);
        }
    }
}
