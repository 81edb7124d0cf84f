//! Host-visible memory in slices: what frames write anew, and blocks that change now and then.
//!
//! A slice returns to its pool when its last owner goes. Frames in flight own the slices that they read, so that a value
//! is never overwritten under the device: to change one, take another slice. After the first frames every request is
//! served from what has returned, and nothing is created.

use super::buffer::Buffer;
use super::device::{Gpu, lock};
use super::error::GpuError;
use super::memory::Memory;
use ash::vk;
use std::sync::{Arc, Mutex, Weak};

/// Smallest buffer of a pool, bytes.
const LEAST_CHUNK_BYTES: u64 = 64 << 10;
/// Frames that a new buffer has room for: those in flight, and one more.
const FRAMES: u64 = 4;

/// Slices of a few buffers, of which the newest and largest serves all that still fits.
pub struct TransientPool {
    gpu: Gpu,
    inner: Arc<PoolInner>,
}

struct PoolInner {
    name: String,
    chunks: Mutex<Vec<Chunk>>,
}

struct Chunk {
    number: u64,
    buffer: Buffer,
    free: FreeRanges,
}

impl Chunk {
    fn is_unused(&self) -> bool {
        self.free.0 == [(0, self.buffer.bytes())]
    }
}

/// Start and end of what is free, ascending, never touching.
struct FreeRanges(Vec<(u64, u64)>);

impl FreeRanges {
    /// The place of so many bytes at a multiple of `alignment`, which need not be a power of two.
    fn take(&mut self, bytes: u64, alignment: u64) -> Option<u64> {
        let fits = |&(start, end): &(u64, u64)| {
            let place = start.checked_next_multiple_of(alignment)?;
            place.checked_add(bytes).is_some_and(|needed| needed <= end).then_some((place, start, end))
        };
        let (index, (place, start, end)) =
            self.0.iter().enumerate().find_map(|(index, range)| Some((index, fits(range)?)))?;
        let rest = [(start, place), (place + bytes, end)].map(|range| (range.0 < range.1).then_some(range));
        match rest {
            [None, None] => drop(self.0.remove(index)),
            [Some(one), None] | [None, Some(one)] => self.0[index] = one,
            [Some(before), Some(after)] => {
                self.0[index] = before;
                self.0.insert(index + 1, after);
            }
        }
        Some(place)
    }

    fn give_back(&mut self, start: u64, end: u64) {
        let index = self.0.partition_point(|range| range.0 < start);
        self.0.insert(index, (start, end));
        if self.0.get(index + 1).is_some_and(|next| next.0 == end) {
            self.0[index].1 = self.0.remove(index + 1).1;
        }
        if index > 0 && self.0[index - 1].1 == start {
            self.0[index - 1].1 = self.0.remove(index).1;
        }
    }
}

impl Gpu {
    /// A pool of that name, without memory yet.
    pub fn transient_pool(&self, name: &str) -> TransientPool {
        let inner = PoolInner { name: name.to_owned(), chunks: Mutex::default() };
        TransientPool { gpu: self.clone(), inner: Arc::new(inner) }
    }
}

impl TransientPool {
    /// A slice of at least one byte whose offset is a multiple of `alignment` bytes (any number above 0) and serves as a
    /// uniform block, too, where that is one of [`DeviceInfo::uniform_alignment`](super::DeviceInfo::uniform_alignment).
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`], [`GpuError::Allocation`].
    pub fn slice(&self, bytes: u64, alignment: u64) -> Result<TransientSlice, GpuError> {
        let (bytes, alignment) = (bytes.max(1), alignment.max(1));
        let mut chunks = lock(&self.inner.chunks);
        let newest = chunks.last_mut().and_then(|chunk| Some((chunk.free.take(bytes, alignment)?, chunk.number)));
        let (offset, number) = match newest {
            Some(found) => found,
            None => {
                let last = chunks.last().map_or((0, 0), |chunk| (chunk.number + 1, chunk.buffer.bytes()));
                let size = (bytes + alignment).saturating_mul(FRAMES).next_power_of_two().max(2 * last.1);
                let usage = vk::BufferUsageFlags::UNIFORM_BUFFER | vk::BufferUsageFlags::STORAGE_BUFFER;
                let size = size.max(LEAST_CHUNK_BYTES);
                let buffer = self.gpu.buffer(&self.inner.name, size, usage, Memory::Upload)?;
                chunks.retain(|chunk| !chunk.is_unused());
                chunks.push(Chunk { number: last.0, buffer, free: FreeRanges(vec![(0, size)]) });
                let chunk =
                    chunks.last_mut().and_then(|chunk| Some((chunk.free.take(bytes, alignment)?, chunk.number)));
                chunk.ok_or_else(|| GpuError::OutOfMemory { name: self.inner.name.clone() })?
            }
        };
        let Some(chunk) = chunks.last() else { return Err(GpuError::OutOfMemory { name: self.inner.name.clone() }) };
        let buffer = Buffer(chunk.buffer.0.clone());
        let pool = Arc::downgrade(&self.inner);
        Ok(TransientSlice(Arc::new(SliceInner { pool, number, buffer, offset, bytes })))
    }
}

/// A part of a buffer of a pool. Clones share it.
#[derive(Clone)]
pub struct TransientSlice(pub(crate) Arc<SliceInner>);

pub(crate) struct SliceInner {
    pool: Weak<PoolInner>,
    number: u64,
    buffer: Buffer,
    offset: u64,
    bytes: u64,
}

impl TransientSlice {
    /// The buffer that it is a part of.
    pub fn buffer(&self) -> &Buffer {
        &self.0.buffer
    }

    /// Where in the buffer it starts, bytes.
    pub fn offset(&self) -> u64 {
        self.0.offset
    }

    /// Its size, bytes.
    pub fn bytes(&self) -> u64 {
        self.0.bytes
    }

    /// Whether bind groups that were made for `buffer` can read it: they then differ in their offsets alone.
    pub fn is_in(&self, buffer: &Buffer) -> bool {
        Arc::ptr_eq(&self.0.buffer.0, &buffer.0)
    }

    /// Writes values at `byte_offset` of the slice. The device sees them in later submissions.
    ///
    /// # Errors
    /// [`GpuError::Range`] when they do not fit.
    pub fn write<T: bytemuck::NoUninit>(&self, byte_offset: u64, values: &[T]) -> Result<(), GpuError> {
        let bytes = size_of_val(values) as u64;
        if byte_offset.checked_add(bytes).is_none_or(|end| end > self.0.bytes) {
            let problem = format!("{bytes} bytes at {byte_offset} do not fit in a slice of {}", self.0.bytes);
            return Err(self.0.buffer.0.range(problem));
        }
        self.0.buffer.write(self.0.offset + byte_offset, values)
    }
}

impl Drop for SliceInner {
    fn drop(&mut self) {
        let Some(pool) = self.pool.upgrade() else { return };
        let mut chunks = lock(&pool.chunks);
        let newest = chunks.last().map(|chunk| chunk.number);
        let Some(index) = chunks.iter().position(|chunk| chunk.number == self.number) else { return };
        chunks[index].free.give_back(self.offset, self.offset + self.bytes);
        if Some(self.number) != newest && chunks[index].is_unused() {
            // Freed outside of the lock.
            let unused = chunks.remove(index);
            drop(chunks);
            drop(unused);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn places_are_aligned_and_the_first_that_fit() {
        let mut free = FreeRanges(vec![(3, 10), (12, 64)]);
        assert_eq!(free.take(4, 6), Some(6), "6 is no power of two");
        assert_eq!(free.0, [(3, 6), (12, 64)]);
        assert_eq!(free.take(3, 1), Some(3), "a whole range");
        assert_eq!(free.take(8, 16), Some(16), "what is skipped stays free");
        assert_eq!(free.0, [(12, 16), (24, 64)]);
        assert_eq!(free.take(64, 1), None);
        assert_eq!(free.take(u64::MAX, 16), None);
        assert_eq!(free.take(1, u64::MAX), None);
        assert_eq!(free.0, [(12, 16), (24, 64)], "what fails takes nothing");
    }

    #[test]
    fn what_is_given_back_joins_its_neighbours() {
        let mut free = FreeRanges(vec![(0, 10), (30, 40)]);
        free.give_back(15, 20);
        assert_eq!(free.0, [(0, 10), (15, 20), (30, 40)]);
        free.give_back(10, 15);
        assert_eq!(free.0, [(0, 20), (30, 40)]);
        free.give_back(20, 30);
        assert_eq!(free.0, [(0, 40)]);
    }

    proptest! {
        #[test]
        fn slices_never_overlap_and_all_comes_back(
            steps in prop::collection::vec((1u64..200, 1u64..65, any::<prop::sample::Index>(), any::<bool>()), 1..80),
        ) {
            const SIZE: u64 = 1000;
            let mut free = FreeRanges(vec![(0, SIZE)]);
            let mut taken: Vec<(u64, u64)> = Vec::new();
            for (bytes, alignment, index, gives_back) in steps {
                if gives_back && !taken.is_empty() {
                    let (start, end) = taken.swap_remove(index.index(taken.len()));
                    free.give_back(start, end);
                } else if let Some(place) = free.take(bytes, alignment) {
                    prop_assert!(place.is_multiple_of(alignment) && place + bytes <= SIZE);
                    prop_assert!(taken.iter().all(|&(start, end)| place + bytes <= start || end <= place));
                    taken.push((place, place + bytes));
                }
                prop_assert!(free.0.iter().all(|(start, end)| start < end));
                prop_assert!(free.0.windows(2).all(|pair| pair[0].1 < pair[1].0), "ascending, never touching");
                let bytes = |ranges: &[(u64, u64)]| ranges.iter().map(|(start, end)| end - start).sum::<u64>();
                prop_assert_eq!(bytes(&free.0) + bytes(&taken), SIZE);
            }
            taken.into_iter().for_each(|(start, end)| free.give_back(start, end));
            prop_assert_eq!(free.0, [(0, SIZE)]);
        }
    }
}
