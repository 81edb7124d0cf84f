//! What one frame took: times, draws, memory, and what it left out.

use super::left_out::LeftOut;
use super::pass::transparency::ListUse;
use super::plan::{DrawKind, Plan};
use crate::gpu::{CallCounts, FrameTimes, MemoryReport, PassTime};
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
    /// Coats.
    pub fur: Vec<CoatReport>,
    /// What blended; `None` where nothing was listed.
    pub lists: Option<ListUse>,
    /// Device memory.
    pub memory: MemoryReport,
    /// Vulkan calls and bytes from the call to the finished frame.
    pub calls: CallCounts,
    /// What the frame did without.
    pub left_out: Vec<LeftOut>,
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

/// A coat that was drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CoatReport {
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
        plan: &Plan,
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
            fur: coats(scene, plan),
            lists: None,
            memory,
            calls,
            left_out: plan.left_out.clone(),
        }
    }
}

fn coats(scene: &Scene, plan: &Plan) -> Vec<CoatReport> {
    let mut coats: BTreeMap<usize, CoatReport> = BTreeMap::new();
    let mut counted = BTreeSet::new();
    for draw in plan.fur.iter().chain(&plan.transparent) {
        let DrawKind::Fur { material, layers } = draw.kind else { continue };
        let instance = &plan.instances[draw.instance];
        let (mesh, primitive) = (instance.mesh, instance.primitive);
        let coat = coats.entry(material).or_insert_with(|| CoatReport {
            material: scene.materials()[material].name.clone(),
            layers,
            instances: 0,
            vertices_stored: 0,
        });
        coat.instances += layers;
        if counted.insert((material, mesh, primitive)) {
            let vertices = &scene.asset().meshes[mesh].primitives[primitive].vertices;
            coat.vertices_stored += vertices.positions.len() as u32 * plan.copies_of((mesh, primitive));
        }
    }
    coats.into_values().collect()
}
