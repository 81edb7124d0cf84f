//! Nodes and scenes: a checked forest.

use super::context::Context;
use super::document::Document;
use super::{AssetError, AssetScene, Node, Transform, mesh};
use ::gltf::json::scene::UnitQuaternion;
use ::gltf::json::{self, Index};
use glam::{DQuat, Mat4, Quat, Vec3, Vec4};

/// How far from 1 a rotation's length may be before it is worth a word.
const UNIT_TOLERANCE: f64 = 1e-3;

/// The rotation of a file's x, y, z, w and what was wrong with it.
pub(super) fn rotation(xyzw: [f32; 4], tolerance: f64) -> (Quat, Option<&'static str>) {
    let quaternion = DQuat::from_array(xyzw.map(f64::from));
    let length = quaternion.length();
    if length == 0.0 {
        return (Quat::IDENTITY, Some("is zero; no rotation is used"));
    }
    let odd = (length - 1.0).abs() > tolerance;
    let unit = if (length - 1.0).abs() > 1e-6 { (quaternion / length).as_quat() } else { Quat::from_array(xyzw) };
    (unit, odd.then_some("is not of unit length; it is normalised"))
}

/// How errors call a node.
fn title(document: &Document, node: usize) -> String {
    match document.root.nodes.get(node).and_then(|node| node.name.as_ref()) {
        Some(name) => format!("nodes[{node}] `{name}`"),
        None => format!("nodes[{node}]"),
    }
}

/// All nodes.
///
/// # Errors
/// Indices out of range, numbers that are not finite, a node with two parents or inside itself.
pub(super) fn read(context: &Context, document: &Document) -> Result<Vec<Node>, AssetError> {
    check_forest(context, document)?;
    let node = |(n, json): (usize, &json::Node)| {
        let field = format!("nodes[{n}]");
        let point = |name: &str, index: Option<usize>, list: &str, len: usize| match index {
            Some(index) => context.index(format_args!("{field}.{name}"), index, list, len).map(Some),
            None => Ok(None),
        };
        let mesh = point("mesh", json.mesh.map(|mesh| mesh.value()), "meshes", document.root.meshes.len())?;
        let mut skin = point("skin", json.skin.map(|skin| skin.value()), "skins", document.root.skins.len())?;
        if skin.is_some() && mesh.is_none() {
            context.warn(format_args!("{field}.skin"), "the node has no mesh; it is ignored");
            skin = None;
        }
        let camera = point("camera", json.camera.map(|camera| camera.value()), "cameras", document.root.cameras.len())?;
        let light = json.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref());
        let light = light.map(|extension| extension.light.value());
        let light = point("extensions.KHR_lights_punctual.light", light, "lights", document.lights().len())?;
        let weights = match (mesh, &json.weights) {
            (Some(mesh), Some(weights)) if !weights.is_empty() => {
                let targets = mesh::target_count(&document.root.meshes[mesh]);
                mesh::fit_weights(context, &format!("{field}.weights"), weights, targets)?
            }
            _ => Vec::new(),
        };
        Ok(Node {
            name: json.name.clone(),
            children: json.children.iter().flatten().map(Index::value).collect(),
            transform: transform(context, &field, json)?,
            mesh,
            skin,
            camera,
            light,
            weights,
        })
    };
    document.root.nodes.iter().enumerate().map(node).collect()
}

fn transform(context: &Context, field: &str, json: &json::Node) -> Result<Transform, AssetError> {
    if let Some(matrix) = &json.matrix {
        context.finite(format_args!("{field}.matrix"), matrix)?;
        let mut matrix = Mat4::from_cols_array(matrix);
        if matrix.row(3) != Vec4::W {
            context.warn(format_args!("{field}.matrix"), "its last row is not 0 0 0 1; that row is used");
            for (column, last) in [0.0, 0.0, 0.0, 1.0].into_iter().enumerate() {
                matrix.col_mut(column).w = last;
            }
        }
        return Ok(Transform::Matrix(matrix));
    }
    let translation = json.translation.unwrap_or([0.0; 3]);
    let scale = json.scale.unwrap_or([1.0; 3]);
    let UnitQuaternion(xyzw) = json.rotation.unwrap_or_default();
    context.finite(format_args!("{field}.translation"), &translation)?;
    context.finite(format_args!("{field}.rotation"), &xyzw)?;
    context.finite(format_args!("{field}.scale"), &scale)?;
    let (rotation, odd) = rotation(xyzw, UNIT_TOLERANCE);
    if let Some(problem) = odd {
        context.warn(format_args!("{field}.rotation"), problem);
    }
    Ok(Transform::Trs { translation: Vec3::from(translation), rotation, scale: Vec3::from(scale) })
}

/// The parent of each node.
fn parents(context: &Context, document: &Document) -> Result<Vec<Option<usize>>, AssetError> {
    let mut parents: Vec<Option<usize>> = vec![None; document.root.nodes.len()];
    for (n, node) in document.root.nodes.iter().enumerate() {
        for (c, child) in node.children.iter().flatten().map(Index::value).enumerate() {
            let field = format!("nodes[{n}].children[{c}]");
            context.index(&field, child, "nodes", document.root.nodes.len())?;
            if let Some(other) = parents[child].replace(n) {
                let (other, here) = (title(document, other), title(document, n));
                let problem = format!("has two parents, {other} and {here}; give it one");
                return Err(context.error(title(document, child), problem));
            }
        }
    }
    Ok(parents)
}

fn check_forest(context: &Context, document: &Document) -> Result<(), AssetError> {
    match in_cycle(&parents(context, document)?) {
        Some(node) => Err(context.error(title(document, node), "is its own ancestor; break the cycle of children")),
        None => Ok(()),
    }
}

/// A node that is its own ancestor. Climbs from every node; marks spare climbing a path twice, so deep chains cost nothing
/// more.
pub(super) fn in_cycle(parents: &[Option<usize>]) -> Option<usize> {
    // 0 = not seen; otherwise the climb that saw it.
    let mut seen = vec![0; parents.len()];
    (0..parents.len()).find_map(|start| {
        let mut at = Some(start);
        while let Some(node) = at.filter(|node| seen[*node] == 0) {
            seen[node] = start + 1;
            at = parents[node];
        }
        at.filter(|node| seen[*node] == start + 1)
    })
}

/// The root above each node of a forest; each path is climbed once.
fn tree_roots(parents: &[Option<usize>]) -> Vec<usize> {
    let mut roots: Vec<Option<usize>> = vec![None; parents.len()];
    let mut path = Vec::new();
    for start in 0..parents.len() {
        let mut at = start;
        let root = loop {
            if let Some(root) = roots[at] {
                break root;
            }
            path.push(at);
            match parents[at] {
                Some(parent) => at = parent,
                None => break at,
            }
        };
        path.drain(..).for_each(|node| roots[node] = Some(root));
    }
    roots.into_iter().flatten().collect()
}

/// All scenes and the default one.
///
/// # Errors
/// Indices out of range.
pub(super) fn read_scenes(context: &Context, document: &Document) -> Result<(Vec<AssetScene>, usize), AssetError> {
    let parents = parents(context, document)?;
    let tree_roots = tree_roots(&parents);
    let mut scenes = Vec::with_capacity(document.root.scenes.len().max(1));
    for (s, json) in document.root.scenes.iter().enumerate() {
        let mut roots = Vec::with_capacity(json.nodes.len());
        let mut known = std::collections::HashSet::new();
        for (n, node) in json.nodes.iter().map(Index::value).enumerate() {
            let field = format!("scenes[{s}].nodes[{n}]");
            context.index(&field, node, "nodes", parents.len())?;
            let root = tree_roots[node];
            if root != node {
                let problem = format!("{} is no root node; its whole tree is shown", title(document, node));
                context.warn(&field, problem);
            }
            if known.insert(root) {
                roots.push(root);
            }
        }
        scenes.push(AssetScene { name: json.name.clone(), roots });
    }
    if scenes.is_empty() {
        let roots = (0..parents.len()).filter(|node| parents[*node].is_none()).collect();
        scenes.push(AssetScene { name: None, roots });
    }
    let default_scene = match document.root.scene {
        Some(scene) => context.index("scene", scene.value(), "scenes", document.root.scenes.len())?,
        None => 0,
    };
    Ok((scenes, default_scene))
}
