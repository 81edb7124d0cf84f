//! JOINTS_n and WEIGHTS_n to influences whose weights sum to 1.

use super::AssetError;
use super::accessor::{Accessors, Normalize};
use super::context::Context;
use ::gltf::json::Index;
use ::gltf::json::mesh::{Primitive, Semantic};
use ::gltf::json::validation::Checked;

/// Influences a set holds.
const PER_SET: usize = 4;

/// All sets of one primitive, side by side in each vertex.
///
/// `joint_count`: joints of the smallest skin that draws the mesh. Returns the influences and how
/// many there are a vertex; none when the attributes hold no pair of sets.
///
/// # Errors
/// A list of another length than the positions; a joint with weight that the skin lacks.
pub(super) fn read(
    context: &Context,
    accessors: &Accessors,
    json: &Primitive,
    field: &str,
    vertex_count: usize,
    joint_count: usize,
) -> Result<(Vec<(u16, f32)>, usize), AssetError> {
    let attribute = |semantic: Semantic| json.attributes.get(&Checked::Valid(semantic)).map(Index::value);
    let mut sets = Vec::new();
    for set in 0.. {
        let Some(joints) = attribute(Semantic::Joints(set)) else { break };
        let Some(weights) = attribute(Semantic::Weights(set)) else {
            context.warn(field, format_args!("JOINTS_{set} has no WEIGHTS_{set}; it is ignored"));
            break;
        };
        let joints_field = format!("{field}.JOINTS_{set}");
        let weights_field = format!("{field}.WEIGHTS_{set}");
        let joints = accessors.unsigned::<PER_SET>(&joints_field, joints)?;
        let weights = accessors.floats::<PER_SET>(&weights_field, weights, Normalize::Always)?;
        for (name, len) in [(&joints_field, joints.len()), (&weights_field, weights.len())] {
            if len != vertex_count {
                return Err(context.error(name, format_args!("has {len} elements, POSITION has {vertex_count}")));
            }
        }
        sets.push((joints, weights));
    }
    if sets.is_empty() {
        return Ok((Vec::new(), 0));
    }

    let per_vertex = sets.len() * PER_SET;
    let bytes = (vertex_count * per_vertex * size_of::<(u16, f32)>()) as u64;
    context.spend(field, bytes)?;
    let mut influences = Vec::with_capacity(vertex_count * per_vertex);
    let mut without_weight = 0usize;
    let mut negative = 0usize;
    for vertex in 0..vertex_count {
        let start = influences.len();
        let mut sum = 0.0f64;
        for (set, (joints, weights)) in sets.iter().enumerate() {
            for (joint, weight) in joints[vertex].into_iter().zip(weights[vertex]) {
                negative += usize::from(weight < 0.0);
                let weight = weight.max(0.0);
                let joint = match usize::try_from(joint) {
                    Ok(joint) if joint < joint_count => joint,
                    // Exporters leave anything behind a zero weight.
                    _ if weight == 0.0 => 0,
                    _ => {
                        let problem =
                            format!("vertex {vertex} uses joint {joint}, but its skin has {joint_count} joints");
                        return Err(context.error(format_args!("{field}.JOINTS_{set}"), problem));
                    }
                };
                sum += f64::from(weight);
                // Unsigned shorts are the largest joint type; a 32-bit one below the joint count
                // could only be lost in a skin of more than 65536 joints.
                let joint = u16::try_from(joint).map_err(|_| {
                    context.error(format_args!("{field}.JOINTS_{set}"), format_args!("joint {joint} is over 65535"))
                })?;
                influences.push((joint, weight));
            }
        }
        if sum > 0.0 {
            influences[start..].iter_mut().for_each(|(_, weight)| *weight = (f64::from(*weight) / sum) as f32);
        } else {
            without_weight += 1;
            influences[start].1 = 1.0;
        }
    }
    if without_weight > 0 {
        let problem =
            format_args!("{without_weight} vertices have no weight; each follows its first joint").to_string();
        context.warn(field, problem);
    }
    if negative > 0 {
        context.warn(field, format_args!("{negative} weights are negative; they count as 0"));
    }
    Ok((influences, per_vertex))
}
