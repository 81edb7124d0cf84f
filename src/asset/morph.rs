//! Morph targets.

use super::accessor::{Accessors, Normalize};
use super::context::Context;
use super::document::Document;
use super::{AssetError, MorphTarget};
use ::gltf::json::mesh::Primitive;
use ::gltf::json::{Accessor, Index};
use glam::Vec3;

/// Bytes of a vertex and target on the device: offsets of position, normal, tangent and shell direction, kept for
/// targets that move nothing, too, because weights go by a target's place in the list.
pub(super) const DELTA_BYTES: u64 = 4 * size_of::<Vec3>() as u64;

/// The targets of one primitive, padded with empty ones to `target_count`.
///
/// # Errors
/// A list of another length than the positions; NaN; indices out of range.
pub(super) fn read(
    context: &Context,
    document: &Document,
    accessors: &Accessors,
    json: &Primitive,
    field: &str,
    vertex_count: usize,
    target_count: usize,
) -> Result<Vec<MorphTarget>, AssetError> {
    let bytes = DELTA_BYTES.saturating_mul(vertex_count as u64).saturating_add(size_of::<MorphTarget>() as u64);
    context.spend(format_args!("{field}.targets"), bytes.saturating_mul(target_count as u64))?;
    let mut read = Vec::with_capacity(target_count);
    for (t, json) in json.targets.iter().flatten().enumerate() {
        let here = format!("{field}.targets[{t}]");
        for name in document.unknown_names(&here) {
            context.warn(field, format_args!("morph targets move `{name}`, which is not read"));
        }
        let offsets = |name: &str, accessor: Option<Index<Accessor>>| {
            let Some(accessor) = accessor else { return Ok(Vec::new()) };
            let here = format!("{here}.{name}");
            let offsets = accessors.floats::<3>(&here, accessor.value(), Normalize::AsFlagged)?;
            if offsets.len() != vertex_count {
                let problem = format!("has {} elements, POSITION has {vertex_count}", offsets.len());
                return Err(context.error(here, problem));
            }
            Ok(offsets.into_iter().map(Vec3::from).collect())
        };
        read.push(MorphTarget {
            positions: offsets("POSITION", json.positions)?,
            normals: offsets("NORMAL", json.normals)?,
            tangents: offsets("TANGENT", json.tangents)?,
        });
    }
    if read.len() < target_count {
        let problem = format!("has {} morph targets, its mesh {target_count}; the others leave it", read.len());
        context.warn(field, problem);
        read.resize_with(target_count, MorphTarget::default);
    }
    Ok(read)
}
