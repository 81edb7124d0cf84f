//! Where the time, the fragments and the memory of a frame go.
//!
//! [`Profile::measure`] starts a device twice, with an empty pipeline cache and with the one that the first start left,
//! renders on the second, counts fragments, and keeps all frames for a [`Profile::trace`].

mod family;
mod spread;
mod trace;

pub use family::{FamilyCost, FamilyProfile};
pub use spread::Spread;

use crate::gpu::{CallCounts, DeviceInfo, GpuOptions, MemoryReport};
use crate::measure::{PassFragments, can_count_fragments, count_fragments};
use crate::render::{FrameOptions, FrameReport, FurReport, RenderError, Renderer, Skipped};
use crate::scene::Scene;
use std::time::Instant;

/// Timed frames that a profile takes where nobody says otherwise.
pub const DEFAULT_FRAMES: u32 = 10;
/// Frames before the timed ones, after the first.
const WARM_UP_FRAMES: u32 = 2;

/// Why a profile could not be made or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// A frame failed, or a trace could not be written.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// There is no place for the pipeline cache that is measured.
    #[error("temporary folder for a pipeline cache: {0}; set TMPDIR to a folder that can be written")]
    Cache(std::io::Error),
}

/// One start of a device: pipelines are made, then the first frame is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Start {
    /// Creation of all pipelines, ms.
    pub pipelines_ms: f64,
    /// The whole first frame, those pipelines and the uploads in it, ms. Drivers that compile when first drawing do so
    /// here, and may keep a cache of their own, which nobody outside can empty.
    pub first_frame_ms: f64,
}

/// One pass over all timed frames.
#[derive(Debug, Clone, PartialEq)]
pub struct PassProfile {
    /// Name.
    pub name: String,
    /// Time on the device, ms; `None` without timestamps.
    pub gpu_ms: Option<Spread>,
    /// Draws and dispatches.
    pub draws: u32,
    /// Instances of all draws.
    pub instances: u64,
    /// Vertices that go in: indices of all draws and instances.
    pub vertices: u64,
    /// Vertex shader invocations as the driver counts them: fewer than `vertices` where it reuses some; `None` where it
    /// does not count.
    pub vertex_invocations: Option<u64>,
    /// Triangles of all draws and instances.
    pub triangles: u64,
    /// Fragments; `None` for what draws none, and on devices that cannot count them.
    pub fragments: Option<PassFragments>,
}

/// One timed frame.
#[derive(Debug, Clone)]
pub struct TimedFrame {
    /// From the start of the first timed frame to the start of this one, ms.
    pub start_ms: f64,
    /// What it took.
    pub report: FrameReport,
}

/// Where the time, the fragments and the memory of a frame go.
#[derive(Debug, Clone)]
pub struct Profile {
    /// The device.
    pub device: DeviceInfo,
    /// Wall clock from the call to the finished frame, ms.
    pub frame_ms: Spread,
    /// From the start of the first pass to the end of the last on the device, ms; `None` without timestamps.
    pub gpu_ms: Option<Spread>,
    /// The host's time by phase, ms, in order.
    pub cpu_ms: Vec<(&'static str, Spread)>,
    /// Passes in order.
    pub passes: Vec<PassProfile>,
    /// Fur.
    pub fur: Vec<FurReport>,
    /// Device memory by owner and use, without the counters.
    pub memory: MemoryReport,
    /// Vulkan calls and uploaded bytes of the last frame.
    pub calls: CallCounts,
    /// A start with an empty pipeline cache.
    pub cold: Start,
    /// A start with the pipeline cache that the cold one left on disk.
    pub warm: Start,
    /// What the frame did without.
    pub left_out: Vec<Skipped>,
    /// The timed frames.
    pub frames: Vec<TimedFrame>,
    /// What the validation layer said, to the end of both devices.
    pub validation_messages: Vec<String>,
}

impl Profile {
    /// Measures `frame_count` frames (at least 1) after a first one and two more. `device` names device and validation;
    /// its pipeline cache is neither read nor written, a temporary one stands in.
    ///
    /// # Errors
    /// Those of rendering, and [`ProfileError::Cache`].
    pub fn measure(
        device: &GpuOptions,
        scene: &Scene,
        options: &FrameOptions,
        frame_count: u32,
    ) -> Result<Self, ProfileError> {
        let folder = tempfile::tempdir().map_err(ProfileError::Cache)?;
        let device = GpuOptions { pipeline_cache_dir: Some(folder.path().to_owned()), ..device.clone() };
        let mut validation_messages = Vec::new();

        // The folder is empty now, and filled when this device ends.
        let mut renderer = Renderer::new(&device)?;
        let cold = start(&mut renderer, scene, options)?;
        end(renderer, &mut validation_messages);

        let mut renderer = Renderer::new(&device)?;
        let warm = start(&mut renderer, scene, options)?;
        for _ in 0..WARM_UP_FRAMES {
            renderer.render_reported(scene, options, false)?;
        }
        let origin = Instant::now();
        let mut frames = Vec::new();
        for _ in 0..frame_count.max(1) {
            let start_ms = origin.elapsed().as_secs_f64() * 1e3;
            let (_, report) = renderer.render_reported(scene, options, false)?;
            frames.push(TimedFrame { start_ms, report });
        }
        let info = renderer.gpu().info().clone();
        let fragments = match can_count_fragments(renderer.gpu(), options) {
            true => count_fragments(&mut renderer, scene, options)?,
            false => Vec::new(),
        };
        end(renderer, &mut validation_messages);
        Ok(Self::new(info, frames, &fragments, [cold, warm], validation_messages))
    }

    fn new(
        device: DeviceInfo,
        frames: Vec<TimedFrame>,
        fragments: &[PassFragments],
        [cold, warm]: [Start; 2],
        validation_messages: Vec<String>,
    ) -> Self {
        let reports: Vec<&FrameReport> = frames.iter().map(|frame| &frame.report).collect();
        let last = reports[reports.len() - 1];
        let named: Vec<_> = reports.iter().map(|report| report.cpu.named()).collect();
        let cpu_ms = (0..named[0].len()).filter_map(|phase| {
            let values: Vec<f64> = named.iter().map(|phases| phases[phase].1).collect();
            Some((named[0][phase].0, Spread::of(&values)?))
        });
        let gpu_ms: Option<Vec<f64>> = reports.iter().map(|report| report.gpu_ms).collect();
        let frame_ms: Vec<f64> = reports.iter().map(|report| report.frame_ms).collect();
        let passes = last.passes.iter().enumerate().map(|(index, pass)| {
            let times: Option<Vec<f64>> = reports.iter().map(|report| report.passes[index].gpu_ms).collect();
            PassProfile {
                name: pass.name.clone(),
                gpu_ms: times.and_then(|times| Spread::of(&times)),
                draws: pass.draws,
                instances: pass.instances,
                vertices: pass.vertices,
                vertex_invocations: pass.statistics.map(|statistics| statistics.vertex_invocations),
                triangles: pass.triangles,
                fragments: fragments.iter().find(|counted| counted.pass.name() == pass.name).copied(),
            }
        });
        Self {
            device,
            frame_ms: Spread::of(&frame_ms).unwrap_or(Spread { median: 0.0, min: 0.0, max: 0.0, count: 0 }),
            gpu_ms: gpu_ms.and_then(|times| Spread::of(&times)),
            cpu_ms: cpu_ms.collect(),
            passes: passes.collect(),
            fur: last.fur.clone(),
            memory: last.memory.clone(),
            calls: last.calls.clone(),
            cold,
            warm,
            left_out: last.skipped.clone(),
            validation_messages,
            frames,
        }
    }
}

fn start(renderer: &mut Renderer, scene: &Scene, options: &FrameOptions) -> Result<Start, RenderError> {
    let (_, report) = renderer.render_reported(scene, options, false)?;
    Ok(Start { pipelines_ms: report.pipelines_ms, first_frame_ms: report.frame_ms })
}

/// Ends the device, and hears what the validation layer says until then.
fn end(renderer: Renderer, validation_messages: &mut Vec<String>) {
    let log = renderer.gpu().validation_log();
    drop(renderer);
    validation_messages.extend(log.messages());
}
