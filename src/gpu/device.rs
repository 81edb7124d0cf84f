//! The logical device and everything that lives as long as it does.

use super::cache::PipelineCache;
use super::calls::Device;
use super::choose::{self, Candidate, DeviceInfo};
use super::encoder::Encoder;
use super::error::GpuError;
use super::host::{FrameToken, HostCommands, HostDevice};
use super::instance::{Instance, ValidationLog};
use super::layout::Layouts;
use super::memory::{Heap, MemoryReport};
use super::query::RawRecording;
use super::retire::{Kept, RetireQueue, Spare};
use super::sampler::Samplers;
use ash::vk;
use std::ffi::CString;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicU64;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// How to open a device.
#[derive(Debug, Clone, Default)]
pub struct GpuOptions {
    /// Part of the device's name, in any case; `None` takes the best kind.
    pub device: Option<String>,
    /// Turns on the validation layer with synchronization validation.
    pub validate: bool,
    /// Folder for the pipeline cache and for prepared environments; `None` keeps them in memory.
    pub pipeline_cache_dir: Option<PathBuf>,
}

/// A device: makes every other object. Cheap to clone; the last clone waits for the device to finish. It is `Send` and
/// `Sync`: threads share it.
#[derive(Clone)]
pub struct Gpu(Arc<Owner>);

/// Ends the submissions in flight when the last [`Gpu`] goes. Resources hold only the context, so that a submission,
/// which holds resources, is not what keeps itself alive.
struct Owner(Arc<Context>);

impl Drop for Owner {
    fn drop(&mut self) {
        if let Err(error) = self.0.wait_idle() {
            tracing::error!("waiting for the device at its end: {error}");
        }
        self.0.recycle(|retired| retired.take_passed(u64::MAX));
        self.0.recycle(RetireQueue::take_host);
        // What is spare holds nothing that needs the device.
        *lock(&self.0.spare) = Spare::default();
        self.0.cache.save(&self.0.device);
    }
}

/// The queue and the timeline value of the last submission to it.
pub(crate) struct Queue {
    pub(crate) raw: vk::Queue,
    pub(crate) last_submitted: u64,
}

/// Shared by all objects of a device. Fields drop in order: memory before device before instance.
pub(crate) struct Context {
    pub(crate) info: DeviceInfo,
    pub(crate) family: u32,
    pub(crate) physical: vk::PhysicalDevice,
    pub(crate) timeline: vk::Semaphore,
    pub(crate) queue: Mutex<Queue>,
    pub(crate) retired: Mutex<RetireQueue>,
    pub(crate) spare: Mutex<Spare>,
    pub(crate) layouts: Mutex<Layouts>,
    pub(crate) samplers: Mutex<Samplers>,
    pub(crate) recordings: Mutex<Vec<RawRecording>>,
    /// Number of encoders so far; an encoder is known by its number.
    pub(crate) encoders: AtomicU64,
    pub(crate) cache: PipelineCache,
    pub(crate) debug: Option<ash::ext::debug_utils::Device>,
    pub(crate) heap: Mutex<Heap>,
    pub(crate) device: Device,
    pub(crate) instance: Instance,
}

/// Nothing here can be left half-changed by a panic, so poisoning is not an error.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Gpu {
    /// Opens the best usable device.
    ///
    /// # Errors
    /// [`GpuError::NoLoader`], [`GpuError::NoDevice`] with what each device lacks, [`GpuError::MissingLayer`] or
    /// [`GpuError::MissingExtension`] when validation is asked for and absent, or what the driver answers.
    pub fn new(options: &GpuOptions) -> Result<Self, GpuError> {
        let instance = Instance::new(options.validate)?;
        let candidate = choose::choose(&instance, options.device.as_deref())?;
        let priorities = [1.0];
        let queues =
            [vk::DeviceQueueCreateInfo::default().queue_family_index(candidate.family).queue_priorities(&priorities)];
        let mut features = candidate.features.wanted();
        let mut chain = features.chain();
        let info = vk::DeviceCreateInfo::default().queue_create_infos(&queues).push_next(&mut chain);
        // SAFETY: only supported features and an existing queue family are asked for.
        let raw = unsafe { instance.create_device(candidate.physical, &info, None) }
            .map_err(|result| GpuError::from_vk("opening device", &candidate.info.name, result))?;
        let device = Device::new(raw, true);
        // SAFETY: the device was created with one queue of this family.
        let queue = unsafe { device.get_device_queue(candidate.family, 0) };
        Self::assemble(instance, device, queue, candidate, options.pipeline_cache_dir.as_deref())
    }

    /// Uses the host's device.
    ///
    /// # Safety
    /// All handles are valid and belong together, as [`HostDevice`] says, and stay so until the last object made from
    /// this is dropped. While a method of this crate runs, the host does not use the queue. Before the last clone of
    /// this is dropped, all host command buffers that this crate recorded into have finished.
    ///
    /// # Errors
    /// [`GpuError::NoDevice`] when the device lacks Vulkan 1.3, the queue family graphics or compute, or
    /// `host.features` a required feature; or what the driver answers.
    pub unsafe fn from_host(host: HostDevice) -> Result<Self, GpuError> {
        let mut candidate = choose::examine(&host.instance, host.physical_device, Some(host.queue_family));
        // What the device lacks, the host cannot have enabled: named once.
        let not_enabled = host.features.missing().into_iter().filter(|name| !candidate.missing.contains(name));
        let not_enabled: Vec<_> = not_enabled.collect();
        candidate.missing.extend(not_enabled);
        if !candidate.missing.is_empty() {
            return Err(GpuError::NoDevice { asked: None, refused: vec![candidate.report()] });
        }
        candidate.features = host.features;
        candidate.info.set_optional(&host.features);
        let instance = Instance::from_host(host.entry, host.instance, host.has_debug_utils);
        let device = Device::new(host.device, false);
        Self::assemble(instance, device, host.queue, candidate, host.pipeline_cache_dir.as_deref())
    }

    fn assemble(
        instance: Instance,
        device: Device,
        queue: vk::Queue,
        candidate: Candidate,
        cache_dir: Option<&Path>,
    ) -> Result<Self, GpuError> {
        let Candidate { physical, family, info, .. } = candidate;
        let heap = Heap::new(&instance, &device, physical, info.memory_bytes)?;
        let debug = instance.has_debug_utils.then(|| ash::ext::debug_utils::Device::new(&instance, device.uncounted()));
        let mut kind = vk::SemaphoreTypeCreateInfo::default().semaphore_type(vk::SemaphoreType::TIMELINE);
        let semaphore = vk::SemaphoreCreateInfo::default().push_next(&mut kind);
        // SAFETY: timeline semaphores are a required feature.
        let timeline = unsafe { device.create_semaphore(&semaphore, None) }
            .map_err(|result| GpuError::from_vk("creating", "timeline", result))?;
        let cache = PipelineCache::open(&device, &info, cache_dir);
        let context = Context {
            info,
            family,
            physical,
            timeline,
            queue: Mutex::new(Queue { raw: queue, last_submitted: 0 }),
            retired: Mutex::default(),
            spare: Mutex::default(),
            layouts: Mutex::default(),
            samplers: Mutex::default(),
            recordings: Mutex::default(),
            encoders: AtomicU64::new(0),
            cache,
            debug,
            heap: Mutex::new(heap),
            device,
            instance,
        };
        context.set_name(timeline, "timeline");
        Ok(Self(Arc::new(Owner(Arc::new(context)))))
    }

    /// A number that no other open device has.
    pub fn id(&self) -> usize {
        Arc::as_ptr(&self.0.0).addr()
    }

    /// The device, its abilities and limits.
    pub fn info(&self) -> &DeviceInfo {
        &self.0.0.info
    }

    /// Folder for what is kept between runs, [`GpuOptions::pipeline_cache_dir`].
    pub fn cache_dir(&self) -> Option<&Path> {
        self.context().cache.dir.as_deref()
    }

    /// All warnings and errors of the validation layer so far, each `error: <id>: <text>` or `warning: ...`. Empty
    /// without validation and on a host's device, where the host has its own messenger.
    pub fn validation_messages(&self) -> Vec<String> {
        self.validation_log().messages()
    }

    /// The validation layer's messages, readable after the device and all made from it are gone: what the end itself
    /// brought up is in there, too.
    pub fn validation_log(&self) -> ValidationLog {
        self.0.0.instance.log.clone()
    }

    /// What the live objects hold.
    pub fn memory(&self) -> MemoryReport {
        lock(&self.0.0.heap).report()
    }

    /// Waits for all that this crate has submitted, and frees what only that used.
    ///
    /// # Errors
    /// [`GpuError::DeviceLost`] or [`GpuError::OutOfMemory`].
    pub fn wait_idle(&self) -> Result<(), GpuError> {
        self.0.0.wait_idle()
    }

    /// The host's word that the device is done with a frame: frees what only that frame used.
    ///
    /// # Safety
    /// It is true: the frame's command buffers have finished, or were never submitted and never will be.
    ///
    /// # Errors
    /// [`GpuError::Range`] for a token of another device.
    pub unsafe fn frame_passed(&self, token: FrameToken) -> Result<(), GpuError> {
        self.0.0.owns(&token)?;
        self.0.0.recycle(|retired| retired.take_frame(token.frame));
        Ok(())
    }

    /// The frame will have passed when the host's timeline is at `value`, which [`Self::timeline_passed`] says. A host
    /// uses one timeline for all frames that it gives up like this.
    ///
    /// # Errors
    /// [`GpuError::Range`] for a token of another device.
    pub fn frame_on_timeline(&self, token: FrameToken, value: u64) -> Result<(), GpuError> {
        self.0.0.owns(&token)?;
        lock(&self.0.0.retired).on_timeline(token.frame, value);
        Ok(())
    }

    /// The host's word that its timeline is at `value`: frees what only the frames up to there used.
    ///
    /// # Safety
    /// It is true, and the frames' values were right.
    pub unsafe fn timeline_passed(&self, value: u64) {
        self.0.0.recycle(|retired| retired.take_timeline(value));
    }

    /// Frames of the host that have not passed yet, as far as it has said.
    pub fn host_frames_in_flight(&self) -> usize {
        lock(&self.0.0.retired).host_frames()
    }

    /// Starts recording. An image is recorded by one encoder at a time, until that is submitted or dropped; so whatever
    /// the order of submission, each finds its images as it was told.
    ///
    /// # Errors
    /// [`GpuError::OutOfMemory`] or [`GpuError::DeviceLost`].
    pub fn encoder(&self, name: &str) -> Result<Encoder, GpuError> {
        Encoder::new(self, name)
    }

    /// Records into the host's command buffer; [`Encoder::finish_on_host`] ends it, the host submits.
    pub fn encoder_on_host(&self, name: &str, commands: HostCommands) -> Encoder {
        Encoder::on_host(self, name, commands.0)
    }

    pub(crate) fn context(&self) -> &Arc<Context> {
        &self.0.0
    }
}

impl Context {
    /// Names an object for the validation layer and for debuggers.
    pub(crate) fn set_name<T: vk::Handle>(&self, handle: T, name: &str) {
        let Some(debug) = &self.debug else { return };
        let Ok(name) = CString::new(name) else { return };
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(handle).object_name(&name);
        // SAFETY: the handle was just created from this device.
        if let Err(result) = unsafe { debug.set_debug_utils_object_name(&info) } {
            tracing::warn!("naming {name:?}: {result}");
        }
    }

    /// Waits until the timeline is at `value`; `None` waits without end.
    pub(crate) fn wait(&self, name: &str, value: u64, timeout_ms: Option<u64>) -> Result<(), GpuError> {
        let (semaphores, values) = ([self.timeline], [value]);
        let info = vk::SemaphoreWaitInfo::default().semaphores(&semaphores).values(&values);
        let timeout_ns = timeout_ms.map_or(u64::MAX, |ms| ms.saturating_mul(1_000_000));
        // SAFETY: the semaphore lives as long as the context.
        let waited = unsafe { self.device.wait_semaphores(&info, timeout_ns) };
        waited.map_err(|result| match result {
            vk::Result::TIMEOUT => {
                GpuError::Timeout { name: name.to_owned(), timeout_ms: timeout_ms.unwrap_or(u64::MAX) }
            }
            result => GpuError::from_vk("waiting for", name, result),
        })?;
        self.retire()
    }

    pub(crate) fn wait_idle(&self) -> Result<(), GpuError> {
        let last = lock(&self.queue).last_submitted;
        self.wait("device idle", last, None)
    }

    /// Frees what the device no longer uses.
    pub(crate) fn retire(&self) -> Result<(), GpuError> {
        // SAFETY: the semaphore lives as long as the context.
        let passed = unsafe { self.device.get_semaphore_counter_value(self.timeline) }
            .map_err(|result| GpuError::from_vk("reading", "timeline", result))?;
        self.recycle(|retired| retired.take_passed(passed));
        Ok(())
    }

    /// Lets go of what the queue says is no longer used.
    fn recycle(&self, take: impl Fn(&mut RetireQueue) -> Option<Kept>) {
        loop {
            let taken = take(&mut lock(&self.retired));
            let Some(mut kept) = taken else { return };
            // Outside of the lock: freeing takes other locks.
            kept.release();
            lock(&self.spare).kept.push(kept);
        }
    }

    fn owns(self: &Arc<Self>, token: &FrameToken) -> Result<(), GpuError> {
        if token.device == Arc::as_ptr(self).addr() {
            return Ok(());
        }
        let problem = "the token is of another device: give it to the one that the frame was recorded on".to_owned();
        Err(GpuError::Range { name: "frame token".to_owned(), problem })
    }
}

impl Drop for Context {
    fn drop(&mut self) {
        for recording in std::mem::take(&mut *lock(&self.recordings)) {
            recording.destroy(&self.device);
        }
        lock(&self.samplers).destroy(&self.device);
        lock(&self.layouts).destroy(&self.device);
        // SAFETY: pipelines hold the context, so none is being compiled; null is allowed.
        unsafe { self.device.destroy_pipeline_cache(self.cache.raw, None) };
        // SAFETY: the owner waited for the last submission before the context could go.
        unsafe { self.device.destroy_semaphore(self.timeline, None) };
    }
}
