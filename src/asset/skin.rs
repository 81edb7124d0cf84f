//! Skins: joints and inverse bind matrices.

use super::accessor::{Accessors, Normalize};
use super::context::Context;
use super::document::Document;
use super::{AssetError, Skin};
use ::gltf::json::Index;
use glam::Mat4;

/// All skins; missing inverse bind matrices are identities.
///
/// # Errors
/// A skin without joints, a joint that is no node, too few matrices.
pub(super) fn read(context: &Context, document: &Document, accessors: &Accessors) -> Result<Vec<Skin>, AssetError> {
    let mut skins = Vec::with_capacity(document.root.skins.len());
    for (s, json) in document.root.skins.iter().enumerate() {
        let field = format!("skins[{s}]");
        if json.joints.is_empty() {
            return Err(context.error(format_args!("{field}.joints"), "is empty; a skin needs at least one joint"));
        }
        for (j, joint) in json.joints.iter().enumerate() {
            context.index(format_args!("{field}.joints[{j}]"), joint.value(), "nodes", document.root.nodes.len())?;
        }
        let inverse_bind = match json.inverse_bind_matrices {
            None => vec![Mat4::IDENTITY; json.joints.len()],
            Some(accessor) => {
                let here = format!("{field}.inverseBindMatrices");
                let matrices = accessors.floats::<16>(&here, accessor.value(), Normalize::AsFlagged)?;
                if matrices.len() < json.joints.len() {
                    let problem = format!("has {} matrices for {} joints", matrices.len(), json.joints.len());
                    return Err(context.error(here, problem));
                }
                matrices.iter().take(json.joints.len()).map(Mat4::from_cols_array).collect()
            }
        };
        skins.push(Skin { joints: json.joints.iter().map(Index::value).collect(), inverse_bind });
    }
    Ok(skins)
}
