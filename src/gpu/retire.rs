//! What the device may still use: every submission owns its resources until its timeline value has passed.

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
}

/// Submissions in flight, and work recorded for the host.
#[derive(Default)]
pub(crate) struct RetireQueue {
    in_flight: Vec<(u64, Kept)>,
    on_host: Vec<Kept>,
}

impl RetireQueue {
    pub(crate) fn submitted(&mut self, timeline_value: u64, kept: Kept) {
        self.in_flight.push((timeline_value, kept));
    }

    pub(crate) fn recorded_on_host(&mut self, kept: Kept) {
        self.on_host.push(kept);
    }

    /// Takes what is no longer used once the timeline is at `passed`. The caller drops it outside of any lock.
    #[must_use]
    pub(crate) fn take_passed(&mut self, passed: u64) -> Vec<Kept> {
        let (done, waiting) = std::mem::take(&mut self.in_flight).into_iter().partition(|(value, _)| *value <= passed);
        self.in_flight = waiting;
        let done: Vec<(u64, Kept)> = done;
        done.into_iter().map(|(_, kept)| kept).collect()
    }

    /// Takes what the host's command buffers referred to.
    #[must_use]
    pub(crate) fn take_host(&mut self) -> Vec<Kept> {
        std::mem::take(&mut self.on_host)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thing_lives_until_its_value_has_passed() {
        let thing = Arc::new(5_u32);
        let mut queue = RetireQueue::default();
        let mut kept = Kept::default();
        kept.keep(&thing);
        kept.keep(&thing);
        assert_eq!(Arc::strong_count(&thing), 2, "kept once");
        queue.submitted(3, kept);
        drop(queue.take_passed(2));
        assert_eq!(Arc::strong_count(&thing), 2);
        drop(queue.take_passed(3));
        assert_eq!(Arc::strong_count(&thing), 1);
    }

    #[test]
    fn host_work_waits_for_the_host_only() {
        let thing = Arc::new(5_u32);
        let mut queue = RetireQueue::default();
        let mut kept = Kept::default();
        kept.keep(&thing);
        queue.recorded_on_host(kept);
        drop(queue.take_passed(u64::MAX));
        assert_eq!(Arc::strong_count(&thing), 2);
        drop(queue.take_host());
        assert_eq!(Arc::strong_count(&thing), 1);
    }
}
