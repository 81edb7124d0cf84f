//! Renderers, their devices, and the tokens of frames.

use crate::features::enabled;
use crate::pointer::{exclusive, free, handle, optional_text, shared, slice_mut};
use crate::result::{Failure, VairResult, border, border_of_free};
use crate::scene::VairScene;
use std::collections::HashMap;
use std::ffi::c_char;
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use vair::gpu::{FrameToken, HostDevice, ash, vk};
use vair::{FrameOptions, Gpu, GpuOptions, Renderer};

/// `vkGetInstanceProcAddr`, or NULL.
pub type GetInstanceProcAddr = Option<vk::PFN_vkGetInstanceProcAddr>;

/// Draws scenes on one device: pipelines, look-up tables and prepared environments. One thread at a time uses it and the
/// frame that it records.
pub struct VairRenderer(pub(crate) Arc<Shared>);

/// What a renderer and its frame share, so that either may end first.
pub(crate) struct Shared {
    pub(crate) gpu: Gpu,
    state: Mutex<State>,
}

struct State {
    /// Away while a frame is being recorded.
    renderer: Option<Box<Renderer>>,
    tokens: HashMap<u64, FrameToken>,
    next_token: u64,
}

impl Shared {
    fn new(renderer: Renderer) -> Arc<Self> {
        let gpu = renderer.gpu().clone();
        let state = State { renderer: Some(Box::new(renderer)), tokens: HashMap::new(), next_token: 1 };
        Arc::new(Self { gpu, state: Mutex::new(state) })
    }

    /// A panic leaves nothing half-changed here.
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    pub(crate) fn take(&self) -> Result<Box<Renderer>, Failure> {
        let busy = "a frame of this renderer is being recorded: finish it first";
        self.state().renderer.take().ok_or_else(|| Failure::argument(busy))
    }

    pub(crate) fn give_back(&self, renderer: Box<Renderer>) {
        self.state().renderer = Some(renderer);
    }

    pub(crate) fn keep(&self, token: FrameToken) -> u64 {
        let mut state = self.state();
        let number = state.next_token;
        state.next_token += 1;
        state.tokens.insert(number, token);
        number
    }

    fn token(&self, number: u64) -> Result<FrameToken, Failure> {
        self.state().tokens.remove(&number).ok_or_else(|| {
            Failure::argument(format!("token {number} is not of a frame of this renderer, or was given back already"))
        })
    }
}

/// A device of the host's; vair destroys none of it.
#[repr(C)]
pub struct VairHostDevice {
    /// The loader's vkGetInstanceProcAddr.
    pub get_instance_proc_addr: GetInstanceProcAddr,
    /// Instance, created for Vulkan 1.3 or later.
    pub instance: vk::Instance,
    /// The device's physical device.
    pub physical_device: vk::PhysicalDevice,
    /// Device.
    pub device: vk::Device,
    /// Queue with graphics and compute.
    pub queue: vk::Queue,
    /// Family of `queue`.
    pub queue_family: u32,
    /// The features that the device was created with, as vair_enable_features() has completed them. Read during the call.
    pub enabled_features: *const vk::PhysicalDeviceFeatures2<'static>,
    /// VK_EXT_debug_utils is enabled on the instance: objects get names and passes get labels.
    pub has_debug_utils: vk::Bool32,
    /// Folder for the pipeline cache and for prepared environments; NULL keeps them in memory.
    pub cache_folder: *const c_char,
}

/// A device of vair's own.
#[repr(C)]
pub struct VairDeviceOptions {
    /// Part of the device's name, in any case; NULL takes the best kind.
    pub device: *const c_char,
    /// Turns on the validation layer.
    pub validates: vk::Bool32,
    /// Folder for the pipeline cache and for prepared environments; NULL keeps them in memory.
    pub cache_folder: *const c_char,
}

/// A renderer on the host's device.
///
/// VAIR_ERROR_UNSUPPORTED: the device lacks what vair requires, or was created without it; the message names each.
///
/// # Safety
/// The handles are valid, belong together, and stay so until the renderer, its frames and all scenes that it drew are freed.
/// While a call of vair runs, nobody else uses the queue. Before the last of them is freed, all command buffers that vair
/// recorded into have finished.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_renderer_new_on_host(
    host: *const VairHostDevice,
    renderer: *mut *mut VairRenderer,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's memory or NULL.
        let renderer = unsafe { handle(renderer, "renderer") }?;
        // SAFETY: the caller's structure or NULL.
        let host = unsafe { shared(host, "host") }?;
        // SAFETY: the instance is valid by this function's contract.
        let (entry, instance) = unsafe { instance_of(host.get_instance_proc_addr, host.instance) }?;
        let absent = [
            ("host.physical_device", host.physical_device == vk::PhysicalDevice::null()),
            ("host.device", host.device == vk::Device::null()),
            ("host.queue", host.queue == vk::Queue::null()),
        ];
        if let Some((name, _)) = absent.iter().find(|(_, is_null)| *is_null) {
            return Err(Failure::argument(format!("{name} is NULL")));
        }
        // SAFETY: the caller's structure or NULL.
        let features = unsafe { shared(host.enabled_features, "host.enabled_features") }?;
        // SAFETY: its chain is the caller's, of structures as their types say.
        let features = unsafe { enabled(features) };
        // SAFETY: text of the caller's or NULL.
        let cache_folder = unsafe { optional_text(host.cache_folder, "host.cache_folder") }?;
        // SAFETY: the device is the instance's by this function's contract.
        let device = unsafe { ash::Device::load(instance.fp_v1_0(), host.device) };
        let lent = HostDevice {
            entry,
            instance,
            physical_device: host.physical_device,
            device,
            queue: host.queue,
            queue_family: host.queue_family,
            features,
            has_debug_utils: host.has_debug_utils != vk::FALSE,
            pipeline_cache_dir: cache_folder.map(PathBuf::from),
        };
        // SAFETY: this function's contract is that one's.
        let gpu = unsafe { Gpu::from_host(lent) }?;
        *renderer = Box::into_raw(Box::new(VairRenderer(Shared::new(Renderer::with_gpu(gpu)))));
        Ok(())
    })
}

/// A renderer on a device of its own, for pictures: vair_renderer_picture(). NULL options take the best device.
///
/// # Safety
/// `options` is NULL or valid.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_renderer_new(
    options: *const VairDeviceOptions,
    renderer: *mut *mut VairRenderer,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's memory or NULL.
        let renderer = unsafe { handle(renderer, "renderer") }?;
        let mut chosen = GpuOptions::default();
        if !options.is_null() {
            // SAFETY: the caller's structure.
            let options = unsafe { shared(options, "options") }?;
            // SAFETY: text of the caller's or NULL.
            chosen.device = unsafe { optional_text(options.device, "options.device") }?.map(str::to_owned);
            // SAFETY: text of the caller's or NULL.
            let cache_folder = unsafe { optional_text(options.cache_folder, "options.cache_folder") }?;
            chosen.pipeline_cache_dir = cache_folder.map(PathBuf::from);
            chosen.validate = options.validates != vk::FALSE;
        }
        *renderer = Box::into_raw(Box::new(VairRenderer(Shared::new(Renderer::new(&chosen)?))));
        Ok(())
    })
}

/// Frees a renderer; a frame that it records may still be finished. NULL is nothing.
///
/// # Safety
/// It is not used any more. On a host's device, see vair_renderer_new_on_host().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_renderer_free(renderer: *mut VairRenderer) {
    // SAFETY: by this function's contract.
    border_of_free(|| unsafe { free(renderer) });
}

/// The picture that the program `vair` makes of a scene: its nodes, its own camera or one that frames all, the studio's light
/// and background, tone-mapped. What vair_scene_add() has placed is not in it. Writes width * height RGBA pixels of sRGB-coded
/// colour, rows from the top; `bytes` is how many `rgba` holds. It submits, and waits.
///
/// # Safety
/// The handles are valid; `rgba` holds `bytes` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_renderer_picture(
    renderer: *mut VairRenderer,
    scene: *const VairScene,
    width: u32,
    height: u32,
    rgba: *mut u8,
    bytes: usize,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let shared_state = &unsafe { exclusive(renderer, "renderer") }?.0;
        // SAFETY: the caller's handle or NULL.
        let scene = unsafe { shared(scene, "scene") }?;
        // SAFETY: as many bytes as the caller says, or NULL.
        let rgba = unsafe { slice_mut(rgba, bytes, "rgba") }?;
        let needed = u64::from(width) * u64::from(height) * 4;
        if needed == 0 || bytes as u64 != needed {
            let problem = format!("rgba holds {bytes} bytes; {width} x {height} pixels, at least one, take {needed}");
            return Err(Failure::argument(problem));
        }
        let mut renderer = shared_state.take()?;
        let options = FrameOptions { size: [width, height], ..FrameOptions::default() };
        let picture = renderer.render(scene.device_scene.scene(), &options);
        shared_state.give_back(renderer);
        rgba.copy_from_slice(&picture?.rgba);
        Ok(())
    })
}

/// The host's word that the device is done with a frame: what only that frame used comes back. Each token is given back once.
///
/// # Safety
/// It is true: the frame's command buffers have finished, or were never submitted and never will be.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_renderer_frame_passed(renderer: *mut VairRenderer, token: u64) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let shared = &unsafe { exclusive(renderer, "renderer") }?.0;
        let token = shared.token(token)?;
        // SAFETY: by this function's contract.
        Ok(unsafe { shared.gpu.frame_passed(token) }?)
    })
}

/// Gives a token up for a value of the host's timeline semaphore: the frame will have passed when that is at `value`, which
/// vair_renderer_timeline_passed() says. One timeline serves all frames.
///
/// # Safety
/// `renderer` is valid or NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_renderer_frame_on_timeline(
    renderer: *mut VairRenderer,
    token: u64,
    value: u64,
) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let shared = &unsafe { exclusive(renderer, "renderer") }?.0;
        Ok(shared.gpu.frame_on_timeline(shared.token(token)?, value)?)
    })
}

/// The host's word that its timeline is at `value`: what only the frames up to there used comes back.
///
/// # Safety
/// It is true, and the frames' values were right.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn vair_renderer_timeline_passed(renderer: *mut VairRenderer, value: u64) -> VairResult {
    border(|| {
        // SAFETY: the caller's handle or NULL.
        let shared = &unsafe { exclusive(renderer, "renderer") }?.0;
        // SAFETY: by this function's contract.
        unsafe { shared.gpu.timeline_passed(value) };
        Ok(())
    })
}

/// The functions of a host's instance.
///
/// # Safety
/// The instance is valid, and the pointer is the loader's.
pub(crate) unsafe fn instance_of(
    get_instance_proc_addr: GetInstanceProcAddr,
    instance: vk::Instance,
) -> Result<(ash::Entry, ash::Instance), Failure> {
    let get_instance_proc_addr =
        get_instance_proc_addr.ok_or_else(|| Failure::argument("get_instance_proc_addr is NULL"))?;
    if instance == vk::Instance::null() {
        return Err(Failure::argument("instance is NULL"));
    }
    let functions = ash::StaticFn { get_instance_proc_addr };
    // SAFETY: the loader's function by this function's contract.
    let instance = unsafe { ash::Instance::load(&functions, instance) };
    // SAFETY: as above.
    Ok((unsafe { ash::Entry::from_static_fn(functions) }, instance))
}
