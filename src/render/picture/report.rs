//! What one frame took: times, draws, memory, and what it left out.

use crate::gpu::{CallCounts, FrameTimes, MemoryReport, PassTime};
use crate::render::pass::oit_resolve::ListUse;
use crate::render::plan::{DrawKind, FrameSetup, Plan, Skipped};
use crate::scene::Scene;
use std::collections::{BTreeMap, BTreeSet};

/// What one frame took.
#[derive(Debug, Clone)]
pub struct FrameReport {
    /// From the call to the finished frame, wall clock, milliseconds; reading it back is not in it.
    pub frame_ms: f64,
    /// Where the host's time went.
    pub cpu: CpuPhases,
    /// From the start of the first pass to the end of the last on the device, milliseconds; `None` without timestamps.
    pub gpu_ms: Option<f64>,
    /// Creation of every pipeline so far, milliseconds.
    pub pipelines_ms: f64,
    /// Passes in order.
    pub passes: Vec<PassTime>,
    /// Fur, by material.
    pub fur: Vec<FurReport>,
    /// What blended; `None` where nothing was listed.
    pub lists: Option<ListUse>,
    /// Device memory.
    pub memory: MemoryReport,
    /// Vulkan calls and bytes from the call to the finished frame.
    pub calls: CallCounts,
    /// Skipped work.
    pub skipped: Vec<Skipped>,
}

/// The host's time of one frame by phase, in order and without gaps, milliseconds.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct CpuPhases {
    /// Pose, camera, lights and the plan.
    pub plan_ms: f64,
    /// Making what is not there yet, pipelines among it, and this frame's values.
    pub prepare_ms: f64,
    /// Recording the passes.
    pub record_ms: f64,
    /// Handing them to the device. Some software devices draw here.
    pub submit_ms: f64,
    /// Waiting for the device.
    pub wait_ms: f64,
}

impl CpuPhases {
    /// Name and milliseconds of each, in order.
    pub fn named(&self) -> [(&'static str, f64); 5] {
        let Self { plan_ms, prepare_ms, record_ms, submit_ms, wait_ms } = *self;
        [("plan", plan_ms), ("prepare", prepare_ms), ("record", record_ms), ("submit", submit_ms), ("wait", wait_ms)]
    }
}

/// Fur of one material that was drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FurReport {
    /// Name of its material.
    pub material: String,
    /// Shells.
    pub layers: u32,
    /// Instances drawn: shells of all objects with this material.
    pub instances: u32,
    /// Vertices on the device: those of the mesh, once; once a shell where they are duplicated.
    pub vertices_stored: u32,
}

impl FrameReport {
    pub(super) fn new(
        scene: &Scene,
        setup: &FrameSetup,
        times: FrameTimes,
        cpu: CpuPhases,
        pipelines_ms: f64,
        memory: MemoryReport,
        calls: CallCounts,
    ) -> Self {
        Self {
            frame_ms: cpu.named().iter().map(|(_, ms)| ms).sum(),
            cpu,
            gpu_ms: times.gpu_ms,
            pipelines_ms,
            passes: times.passes,
            fur: fur_of(scene, &setup.staging.plan),
            lists: None,
            memory,
            calls,
            skipped: setup.skipped(scene),
        }
    }
}

fn fur_of(scene: &Scene, plan: &Plan) -> Vec<FurReport> {
    let mut by_material: BTreeMap<usize, FurReport> = BTreeMap::new();
    let mut counted = BTreeSet::new();
    for draw in plan.shown() {
        let DrawKind::Fur { material, layers } = draw.kind else { continue };
        let part = plan.parts[draw.part];
        let fur = by_material.entry(material).or_insert_with(|| FurReport {
            material: scene.materials()[material].name.clone(),
            layers,
            instances: 0,
            vertices_stored: 0,
        });
        fur.instances += layers;
        if counted.insert((material, part.mesh, part.primitive)) {
            let vertices = &scene.asset().meshes[part.mesh].primitives[part.primitive].vertices;
            fur.vertices_stored += vertices.positions.len() as u32 * plan.copies_of((part.mesh, part.primitive));
        }
    }
    by_material.into_values().collect()
}
