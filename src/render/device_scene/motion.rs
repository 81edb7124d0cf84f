//! Vertices that move: what skinning and strand dynamics write and read. All of it stays while the plan does.

use super::content::Content;
use super::stream::{Stream, StreamPose};
use crate::gpu::{BindGroup, Buffer, Gpu, GpuError, Memory, Pipeline, Resource};
use crate::render::plan::Staging;
use crate::scene::{Part, Scene};
use crate::shader::layout::StrandVertex;
use ash::vk;
use std::collections::HashMap;
use std::sync::Arc;

const STORAGE: vk::BufferUsageFlags = vk::BufferUsageFlags::STORAGE_BUFFER;

/// A part, whatever its place in the list: key of its instance, primitive.
type PartKey = (usize, usize);

/// How strands have moved on since the frame before.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct DynamicsStep {
    /// Strands start from rest.
    pub is_reset: bool,
    /// Seconds since the frame before; 0 for the same time once more.
    pub step_s: f32,
}

/// What moves.
#[derive(Default)]
pub struct Motion {
    moved: HashMap<(PartKey, Stream, StreamPose), Buffer>,
    /// One [`StrandVertex`] a vertex.
    strands: HashMap<PartKey, Buffer>,
    /// Those whose strands have no past yet.
    fresh: Vec<bool>,
    skinning_groups: Vec<BindGroup>,
    dynamics_groups: Vec<BindGroup>,
}

impl Motion {
    /// Makes what the plan writes, and lets go of what it no longer does.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn prepare(&mut self, gpu: &Gpu, scene: &Scene, staging: &Staging) -> Result<(), GpuError> {
        let plan = &staging.plan;
        let mut before = std::mem::take(&mut self.moved);
        let moved = plan.deforms.iter().map(|deform| (deform.part, deform.stream, deform.pose));
        let swayed = plan.dynamics.iter().map(|dynamics| (dynamics.part, Stream::Sway, StreamPose::Current));
        for (part, stream, pose) in moved.chain(swayed) {
            let key = (part_key(staging, plan.parts[part]), stream, pose);
            let bytes = (vertex_count(scene, plan.parts[part]) as u64 * u64::from(stream.stride())).max(4);
            let kept = before.remove(&key).filter(|buffer| buffer.bytes() == bytes);
            let usage = STORAGE | vk::BufferUsageFlags::VERTEX_BUFFER;
            let buffer = match kept {
                Some(buffer) => buffer,
                None => gpu.buffer("moved stream", bytes, usage, Memory::Device)?,
            };
            self.moved.insert(key, buffer);
        }
        let mut before = std::mem::take(&mut self.strands);
        self.fresh.clear();
        for dynamics in &plan.dynamics {
            let part = plan.parts[dynamics.part];
            let bytes = (vertex_count(scene, part).max(1) * size_of::<StrandVertex>()) as u64;
            let kept = before.remove(&part_key(staging, part)).filter(|buffer| buffer.bytes() == bytes);
            self.fresh.push(kept.is_none());
            let buffer = match kept {
                Some(buffer) => buffer,
                None => gpu.buffer("swaying strands", bytes, STORAGE, Memory::Device)?,
            };
            self.strands.insert(part_key(staging, part), buffer);
        }
        Ok(())
    }

    /// Binds it all; `values` is where joints and morph weights are read from.
    ///
    /// # Errors
    /// When the device is out of memory or lost.
    pub fn bind(
        &mut self,
        gpu: &Gpu,
        content: &Content,
        staging: &Staging,
        compute: &[Arc<Pipeline>],
        values: &Buffer,
    ) -> Result<(), GpuError> {
        let plan = &staging.plan;
        self.skinning_groups.clear();
        for deform in &plan.deforms {
            let part = plan.parts[deform.part];
            let index = (part.mesh, part.primitive);
            let rest = &content.streams[&(index, deform.stream)];
            let target = &self.moved[&(part_key(staging, part), deform.stream, deform.pose)];
            let mut offered = vec![
                ("SourceStream", Resource::Buffer(rest)),
                ("TargetStream", Resource::Buffer(target)),
                ("JointList", Resource::Buffer(values)),
                ("MorphWeights", Resource::Buffer(values)),
                // Without targets nothing is read of it.
                ("MorphDeltas", Resource::Buffer(content.morph_deltas.get(&(index, deform.stream)).unwrap_or(rest))),
            ];
            if let Some((indices, weights)) = content.influences.get(&index) {
                offered.push(("InfluenceList", Resource::Buffer(indices)));
                offered.push(("InfluenceWeightList", Resource::Buffer(weights)));
            }
            self.skinning_groups.push(gpu.bind_group(&compute[deform.pipeline], 0, "skinning", &offered)?);
        }
        self.dynamics_groups.clear();
        for dynamics in &plan.dynamics {
            let part = plan.parts[dynamics.part];
            let key = part_key(staging, part);
            let rest = &content.streams[&((part.mesh, part.primitive), Stream::Position)];
            let position = self.moved.get(&(key, Stream::Position, StreamPose::Current)).unwrap_or(rest);
            let offered = [
                ("PositionStream", Resource::Buffer(position)),
                ("StrandVertexList", Resource::Buffer(&self.strands[&key])),
                ("StrandStream", Resource::Buffer(&self.moved[&(key, Stream::Sway, StreamPose::Current)])),
            ];
            let pipeline = &compute[dynamics.pipeline];
            self.dynamics_groups.push(gpu.bind_group(pipeline, 0, "strand dynamics", &offered)?);
        }
        Ok(())
    }

    /// The stream of a part that a pass writes, if one does.
    pub fn moved(&self, staging: &Staging, part: Part, stream: Stream, pose: StreamPose) -> Option<&Buffer> {
        self.moved.get(&(part_key(staging, part), stream, pose))
    }

    /// The group of a dispatch of the plan's deforms.
    pub fn skinning_group(&self, index: usize) -> &BindGroup {
        &self.skinning_groups[index]
    }

    /// The group of a dispatch of the plan's dynamics.
    pub fn dynamics_group(&self, index: usize) -> &BindGroup {
        &self.dynamics_groups[index]
    }

    /// Whether strands of a part have no past to move on from.
    pub fn is_fresh(&self, index: usize) -> bool {
        self.fresh[index]
    }

    /// The frame's commands are complete: all strands have a past.
    pub fn keep(&mut self) {
        self.fresh.fill(false);
    }
}

fn part_key(staging: &Staging, part: Part) -> PartKey {
    (staging.keys[part.instance], part.primitive)
}

fn vertex_count(scene: &Scene, part: Part) -> usize {
    scene.asset().meshes[part.mesh].primitives[part.primitive].vertices.positions.len()
}
