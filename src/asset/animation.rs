//! Animation clips.

use super::accessor::{Accessors, Normalize};
use super::context::Context;
use super::document::{Document, present};
use super::{Animation, AssetError, Channel, Interpolation, Keys, mesh, node};
use ::gltf::json;
use ::gltf::json::animation::{self, Property};
use glam::{Quat, Vec3};
use std::collections::HashSet;

/// Rotation keys come in as few as 8 bits; only lengths beyond that rounding are worth a word.
const KEY_UNIT_TOLERANCE: f64 = 2e-2;

/// All clips. Channels that drive nothing vair has are dropped with a warning.
///
/// # Errors
/// Indices out of range, key and value counts that disagree, numbers that are not finite.
pub(super) fn read(
    context: &Context,
    document: &Document,
    accessors: &Accessors,
) -> Result<Vec<Animation>, AssetError> {
    let mut animations = Vec::with_capacity(document.root.animations.len());
    for (a, json) in document.root.animations.iter().enumerate() {
        let mut channels: Vec<Channel> = Vec::with_capacity(json.channels.len());
        let mut driven = HashSet::new();
        for (c, channel) in json.channels.iter().enumerate() {
            let field = format!("animations[{a}].channels[{c}]");
            let reader = Reader { context, document, accessors, animation: json, index: a };
            let path = document.code(&format!("{field}.target.path"), &channel.target.path);
            // Unknown paths differ by their names.
            let key = (channel.target.node.value(), path.map(|path| path as u8));
            if !driven.insert(key) {
                context.warn(field, "drives what an earlier channel drives; it is ignored");
            } else {
                channels.extend(reader.channel(&field, channel, path)?);
            }
        }
        let last = |channel: &Channel| channel.times_s.last().copied().unwrap_or(0.0);
        let duration_s = channels.iter().map(last).fold(0.0, f32::max);
        animations.push(Animation { name: json.name.clone(), duration_s, channels });
    }
    Ok(animations)
}

struct Reader<'a> {
    context: &'a Context,
    document: &'a Document,
    accessors: &'a Accessors<'a>,
    animation: &'a json::Animation,
    index: usize,
}

impl Reader<'_> {
    fn channel(
        &self,
        field: &str,
        json: &json::animation::Channel,
        path: Result<Property, &str>,
    ) -> Result<Option<Channel>, AssetError> {
        let context = self.context;
        let (samplers, index) = (&self.animation.samplers, json.sampler.value());
        context.index(format_args!("{field}.sampler"), index, "samplers", samplers.len())?;
        let sampler = &samplers[index];
        let place = format!("animations[{}].samplers[{index}]", self.index);
        let ignore = |why: &str| {
            context.warn(field, format_args!("{why}; the channel is ignored"));
            Ok(None)
        };

        let Some(target) = present(json.target.node) else { return ignore("targets no node") };
        let nodes = &self.document.root.nodes;
        context.index(format_args!("{field}.target.node"), target, "nodes", nodes.len())?;
        let here = format!("{place}.interpolation");
        let interpolation = match self.document.code(&here, &sampler.interpolation) {
            Ok(animation::Interpolation::Linear) => Interpolation::Linear,
            Ok(animation::Interpolation::Step) => Interpolation::Step,
            Ok(animation::Interpolation::CubicSpline) => Interpolation::CubicSpline,
            Err(name) => {
                let problem = format!("`{name}` does not exist; use LINEAR, STEP or CUBICSPLINE");
                return Err(context.error(here, problem));
            }
        };
        if path != Ok(Property::MorphTargetWeights) && nodes[target].matrix.is_some() {
            return ignore("targets a node that has a matrix, which only a rest pose may");
        }

        let per_key = if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        let (input, values) = (sampler.input.value(), sampler.output.value());
        let input = self.accessors.floats::<1>(&format!("{place}.input"), input, Normalize::AsFlagged)?;
        let output = format!("{place}.output");
        // The file's keys, then those that stay: times must increase strictly.
        let kept = self.increasing(&format!("{place}.input"), &input);
        let values = match path {
            Ok(Property::Translation) => {
                Keys::Translation(self.vectors(&output, values, input.len(), per_key, &kept)?)
            }
            Ok(Property::Scale) => Keys::Scale(self.vectors(&output, values, input.len(), per_key, &kept)?),
            Ok(Property::Rotation) => Keys::Rotation(self.rotations(&output, values, input.len(), per_key, &kept)?),
            Ok(Property::MorphTargetWeights) => {
                let mesh = nodes[target].mesh.and_then(|mesh| self.document.root.meshes.get(mesh.value()));
                let targets = mesh.map_or(0, mesh::target_count);
                if targets == 0 {
                    return ignore("targets weights of a node without morph targets");
                }
                let values = self.accessors.floats::<1>(&output, values, Normalize::AsFlagged)?;
                let values = self.keep(&output, &values, input.len(), per_key * targets, &kept)?;
                Keys::Weights { targets, values: values.into_iter().flatten().collect() }
            }
            Err(path) => return ignore(&format!("targets `{path}`, which is not known")),
        };
        if kept.is_empty() {
            return ignore("has no keys");
        }
        let times_s = kept.iter().map(|&key| input[key][0]).collect();
        Ok(Some(Channel { node: target, times_s, interpolation, values }))
    }

    /// Keys whose time is later than that of every key before.
    fn increasing(&self, field: &str, times: &[[f32; 1]]) -> Vec<usize> {
        let mut latest = f32::NEG_INFINITY;
        let mut kept = Vec::with_capacity(times.len());
        for (key, &[time]) in times.iter().enumerate() {
            if time > latest {
                latest = time;
                kept.push(key);
            }
        }
        if kept.len() < times.len() {
            let dropped = times.len() - kept.len();
            self.context.warn(field, format_args!("times must increase; {dropped} keys that do not are dropped"));
        }
        kept
    }

    /// The values of the kept keys, after checking how many there are.
    fn keep<T: Copy>(
        &self,
        field: &str,
        values: &[T],
        keys: usize,
        per_key: usize,
        kept: &[usize],
    ) -> Result<Vec<T>, AssetError> {
        if Some(values.len()) != keys.checked_mul(per_key) {
            let problem = format!("has {} elements; {keys} keys need {per_key} each", values.len());
            return Err(self.context.error(field, problem));
        }
        Ok(kept.iter().flat_map(|key| values[key * per_key..][..per_key].iter().copied()).collect())
    }

    fn vectors(
        &self,
        field: &str,
        accessor: usize,
        keys: usize,
        per_key: usize,
        kept: &[usize],
    ) -> Result<Vec<Vec3>, AssetError> {
        let values = self.accessors.floats::<3>(field, accessor, Normalize::AsFlagged)?;
        Ok(self.keep(field, &values, keys, per_key, kept)?.into_iter().map(Vec3::from).collect())
    }

    fn rotations(
        &self,
        field: &str,
        accessor: usize,
        keys: usize,
        per_key: usize,
        kept: &[usize],
    ) -> Result<Vec<Quat>, AssetError> {
        let values = self.accessors.floats::<4>(field, accessor, Normalize::AsFlagged)?;
        let values = self.keep(field, &values, keys, per_key, kept)?;
        let quaternion = |(i, xyzw): (usize, [f32; 4])| {
            // Of a cubic key (in-tangent, value, out-tangent) only the value is a rotation.
            if per_key == 3 && i % 3 != 1 {
                return Quat::from_array(xyzw);
            }
            let (rotation, odd) = node::rotation(xyzw, KEY_UNIT_TOLERANCE);
            if let Some(problem) = odd {
                self.context.warn(field, format_args!("a rotation {problem}"));
            }
            rotation
        };
        Ok(values.into_iter().enumerate().map(quaternion).collect())
    }
}
