//! Vertices that move: what the deform and sway passes write and read.

use super::Shot;
use super::frame_data::filled;
use super::options::FrameOptions;
use super::resources::Resources;
use super::stream::{Moment, Stream};
use super::sway::{SwayMemory, sway_draw};
use crate::gpu::{BindGroup, Buffer, Gpu, GpuError, Memory, Resource};
use crate::scene::{Instance, Scene, joint_matrices};
use crate::shader::layout::{SwayDraw, SwayVertex};
use ash::vk;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

const STORAGE: vk::BufferUsageFlags = vk::BufferUsageFlags::STORAGE_BUFFER;

/// What moves in one frame.
#[derive(Default)]
pub struct Motion {
    /// Moved streams of (instance, stream, moment).
    pub streams: HashMap<(usize, Stream, Moment), Buffer>,
    /// Bind groups of the deform dispatches, in the plan's order.
    pub deform_groups: Vec<BindGroup>,
    /// Bind groups and values of the sway dispatches, in the plan's order.
    pub sways: Vec<(BindGroup, SwayDraw)>,
}

impl Motion {
    /// Uploads this frame's pose and binds it; strands go on from `memory`.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn new(
        gpu: &Gpu,
        resources: &Resources,
        scene: &Scene,
        shot: &Shot,
        options: &FrameOptions,
        memory: &mut SwayMemory,
    ) -> Result<Self, GpuError> {
        let mut motion = Self::default();
        motion.bind_deforms(gpu, resources, scene, shot)?;
        let step_s = memory.begin(scene, options);
        motion.bind_sways(gpu, resources, scene, shot, memory, step_s)?;
        Ok(motion)
    }

    fn bind_deforms(
        &mut self,
        gpu: &Gpu,
        resources: &Resources,
        scene: &Scene,
        Shot { plan, pose, previous, .. }: &Shot,
    ) -> Result<(), GpuError> {
        let mut joints: HashMap<(usize, Moment), Buffer> = HashMap::new();
        for deform in &plan.deforms {
            let (instances, pose) = match previous {
                Some(previous) if deform.moment == Moment::Previous => (&previous.instances, &previous.pose),
                _ => (&plan.instances, pose),
            };
            let instance = &instances[deform.instance];
            let index = (instance.mesh, instance.primitive);
            let target = moved_stream(gpu, scene, instance, deform.stream)?;
            let mut offered = vec![
                ("SourceStream", Resource::Buffer(&resources.streams[&(index, deform.stream)])),
                ("TargetStream", Resource::Buffer(&target)),
            ];
            if let (Some(skin), Some((indices, weights))) = (instance.skin, resources.influences.get(&index)) {
                let buffer = match joints.entry((skin, deform.moment)) {
                    Entry::Occupied(known) => known.into_mut(),
                    Entry::Vacant(new) => {
                        let matrices = joint_matrices(scene.asset(), skin, pose);
                        new.insert(filled(gpu, "joints", STORAGE, &matrices)?)
                    }
                };
                offered.push(("JointList", Resource::Buffer(buffer)));
                offered.push(("InfluenceList", Resource::Buffer(indices)));
                offered.push(("InfluenceWeightList", Resource::Buffer(weights)));
            }
            let deltas = resources.morph_deltas.get(&(index, deform.stream));
            let weights = deltas.map(|_| filled(gpu, "morph weights", STORAGE, &instance.morph_weights)).transpose()?;
            // Without targets nothing is read of either.
            let rest = &resources.streams[&(index, deform.stream)];
            offered.push(("MorphDeltas", Resource::Buffer(deltas.unwrap_or(rest))));
            offered.push(("MorphWeights", Resource::Buffer(weights.as_ref().unwrap_or(rest))));
            let pipeline = resources.compute_pipeline(&plan.compute_pipelines[deform.pipeline]);
            self.deform_groups.push(gpu.bind_group(pipeline, 0, "deform", &offered)?);
            self.streams.insert((deform.instance, deform.stream, deform.moment), target);
        }
        Ok(())
    }

    fn bind_sways(
        &mut self,
        gpu: &Gpu,
        resources: &Resources,
        scene: &Scene,
        Shot { plan, .. }: &Shot,
        memory: &mut SwayMemory,
        step_s: f32,
    ) -> Result<(), GpuError> {
        // What is not taken over belongs to objects that are not shown any more.
        let mut known = std::mem::take(&mut memory.vertices);
        for sway in &plan.sways {
            let instance = &plan.instances[sway.instance];
            let Some(fur) = &scene.materials()[instance.material].fur else { continue };
            let count = vertex_count(scene, instance);
            let key = (instance.node, instance.primitive);
            let (vertices, reset) = match known.remove(&key) {
                Some(vertices) => (vertices, 0),
                None => {
                    let bytes = (count.max(1) * size_of::<SwayVertex>()) as u64;
                    (gpu.buffer("swaying strands", bytes, STORAGE, Memory::Device)?, 1)
                }
            };
            let target = moved_stream(gpu, scene, instance, Stream::Sway)?;
            let rest = &resources.streams[&((instance.mesh, instance.primitive), Stream::Position)];
            let position = self.streams.get(&(sway.instance, Stream::Position, Moment::Frame)).unwrap_or(rest);
            let offered = [
                ("PositionStream", Resource::Buffer(position)),
                ("SwayVertexList", Resource::Buffer(&vertices)),
                ("SwayStream", Resource::Buffer(&target)),
            ];
            let pipeline = resources.compute_pipeline(&plan.compute_pipelines[sway.pipeline]);
            let group = gpu.bind_group(pipeline, 0, "sway", &offered)?;
            self.sways.push((group, SwayDraw { reset, step_s, ..sway_draw(scene, instance, fur, count as u32) }));
            self.streams.insert((sway.instance, Stream::Sway, Moment::Frame), target);
            memory.vertices.insert(key, vertices);
        }
        Ok(())
    }
}

fn vertex_count(scene: &Scene, instance: &Instance) -> usize {
    scene.asset().meshes[instance.mesh].primitives[instance.primitive].vertices.positions.len()
}

/// Room for a stream of an instance that a pass writes.
fn moved_stream(gpu: &Gpu, scene: &Scene, instance: &Instance, stream: Stream) -> Result<Buffer, GpuError> {
    let bytes = (vertex_count(scene, instance) as u64 * u64::from(stream.stride())).max(4);
    gpu.buffer("moved stream", bytes, STORAGE | vk::BufferUsageFlags::VERTEX_BUFFER, Memory::Device)
}
