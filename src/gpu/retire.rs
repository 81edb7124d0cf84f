//! What the device may still use: every submission owns its resources until its timeline value has passed, every frame of
//! a host until the host says so.

use super::barrier::ImageUse;
use super::image::ImageInner;
use std::any::Any;
use std::collections::HashMap;
use std::sync::Arc;

/// Shared ownership of things that commands refer to, each once.
#[derive(Default)]
pub(crate) struct Kept(HashMap<usize, Arc<dyn Any + Send + Sync>>);

impl Kept {
    pub(crate) fn keep<T: Any + Send + Sync>(&mut self, thing: &Arc<T>) {
        let address = Arc::as_ptr(thing).addr();
        self.0.entry(address).or_insert_with(|| thing.clone());
    }

    /// Lets go of all, and keeps the table's own memory for the next frame.
    pub(crate) fn release(&mut self) {
        self.0.clear();
    }
}

/// Tables of encoders that are done, to be used again.
#[derive(Default)]
pub(crate) struct Spare {
    pub(crate) kept: Vec<Kept>,
    pub(crate) claimed: Vec<Claimed>,
}

/// Images that an encoder has taken, with the use that they had before.
pub(crate) type Claimed = Vec<(Arc<ImageInner>, ImageUse)>;

impl Spare {
    pub(crate) fn take(&mut self) -> (Kept, Claimed) {
        (self.kept.pop().unwrap_or_default(), self.claimed.pop().unwrap_or_default())
    }
}

/// Submissions in flight, and frames recorded for the host.
#[derive(Default)]
pub(crate) struct RetireQueue {
    in_flight: Vec<(u64, Kept)>,
    /// By the number of the frame, and the value of the host's timeline at which it has passed, where one was given.
    on_host: Vec<(u64, Option<u64>, Kept)>,
}

impl RetireQueue {
    pub(crate) fn submitted(&mut self, timeline_value: u64, kept: Kept) {
        self.in_flight.push((timeline_value, kept));
    }

    pub(crate) fn recorded_on_host(&mut self, frame: u64, kept: Kept) {
        self.on_host.push((frame, None, kept));
    }

    /// Takes one thing that is no longer used once the timeline is at `passed`. The caller drops it outside of any lock.
    #[must_use]
    pub(crate) fn take_passed(&mut self, passed: u64) -> Option<Kept> {
        let index = self.in_flight.iter().position(|(value, _)| *value <= passed)?;
        Some(self.in_flight.swap_remove(index).1)
    }

    /// Takes what a frame of the host referred to.
    #[must_use]
    pub(crate) fn take_frame(&mut self, frame: u64) -> Option<Kept> {
        let index = self.on_host.iter().position(|(number, ..)| *number == frame)?;
        Some(self.on_host.swap_remove(index).2)
    }

    /// The frame has passed when the host's timeline is at `value`.
    pub(crate) fn on_timeline(&mut self, frame: u64, value: u64) {
        if let Some(entry) = self.on_host.iter_mut().find(|(number, ..)| *number == frame) {
            entry.1 = Some(value);
        }
    }

    /// Takes what one frame referred to that has passed now that the host's timeline is at `passed`.
    #[must_use]
    pub(crate) fn take_timeline(&mut self, passed: u64) -> Option<Kept> {
        let index = self.on_host.iter().position(|(_, value, _)| value.is_some_and(|value| value <= passed))?;
        Some(self.on_host.swap_remove(index).2)
    }

    /// Takes what any frame of the host referred to.
    #[must_use]
    pub(crate) fn take_host(&mut self) -> Option<Kept> {
        self.on_host.pop().map(|(_, _, kept)| kept)
    }

    /// Frames of the host that have not passed.
    pub(crate) fn host_frames(&self) -> usize {
        self.on_host.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept(thing: &Arc<u32>) -> Kept {
        let mut kept = Kept::default();
        kept.keep(thing);
        kept
    }

    #[test]
    fn a_thing_lives_until_its_value_has_passed() {
        let thing = Arc::new(5_u32);
        let mut queue = RetireQueue::default();
        let mut kept = kept(&thing);
        kept.keep(&thing);
        assert_eq!(Arc::strong_count(&thing), 2, "kept once");
        queue.submitted(3, kept);
        drop(queue.take_passed(2));
        assert_eq!(Arc::strong_count(&thing), 2);
        drop(queue.take_passed(3));
        assert_eq!(Arc::strong_count(&thing), 1);
    }

    #[test]
    fn a_frame_of_the_host_waits_for_its_own_token() {
        let (first, second) = (Arc::new(5_u32), Arc::new(6_u32));
        let mut queue = RetireQueue::default();
        queue.recorded_on_host(1, kept(&first));
        queue.recorded_on_host(2, kept(&second));
        drop(queue.take_passed(u64::MAX));
        drop(queue.take_frame(2));
        assert_eq!((Arc::strong_count(&first), Arc::strong_count(&second)), (2, 1));
        assert!(queue.take_frame(2).is_none());
        assert_eq!(queue.host_frames(), 1);
        drop(queue.take_host());
        assert_eq!(Arc::strong_count(&first), 1);
    }

    #[test]
    fn a_frame_on_the_hosts_timeline_waits_for_its_value() {
        let thing = Arc::new(5_u32);
        let mut queue = RetireQueue::default();
        queue.recorded_on_host(1, kept(&thing));
        assert!(queue.take_timeline(u64::MAX).is_none(), "no value was given yet");
        queue.on_timeline(1, 7);
        assert!(queue.take_timeline(6).is_none());
        drop(queue.take_timeline(7));
        assert_eq!(Arc::strong_count(&thing), 1);
    }
}
