//! How large things are in a pose.

use glam::{Mat4, Vec3};

use super::deform::{deformed_positions, influences, morphed_positions};
use super::{Instance, Pose, instances, joint_matrices, pose};
use crate::asset::{Asset, Primitive, Topology};
use crate::math::{Aabb, Hull};

/// Skinned vertices beyond this many (per primitive) are bounded by boxes around each joint's share instead of one by
/// one.
const EXACT_SKINNED_VERTICES: usize = 100_000;

/// [`world_scale`] of a node's mesh in its rest pose.
pub fn object_scale(asset: &Asset, node: usize) -> f32 {
    let Some(mesh) = asset.nodes[node].mesh else { return 1.0 };
    let rest = pose(asset, None, 0.0);
    let joints = asset.nodes[node].skin.map(|skin| joint_matrices(asset, skin, &rest)).unwrap_or_default();
    let matrix = if joints.is_empty() { rest.world_from_node[node] } else { Mat4::IDENTITY };
    world_scale(asset, mesh, matrix, &joints, &rest.weights[node])
}

/// World metres per unit of a mesh that is posed like that: the square root of how its surface grows, so that turning it,
/// as a whole or at its joints, changes nothing. 1 for a mesh without surface.
pub fn world_scale(asset: &Asset, mesh: usize, world_from_object: Mat4, joints: &[Mat4], weights: &[f32]) -> f32 {
    let (mut in_mesh, mut in_world) = (0.0, 0.0);
    for primitive in &asset.meshes[mesh].primitives {
        let places: Vec<Vec3> = deformed_positions(primitive, joints, weights)
            .iter()
            .map(|&position| world_from_object.transform_point3(position))
            .collect();
        in_mesh += area(&primitive.vertices.positions, primitive);
        in_world += area(&places, primitive);
    }
    let scale = (in_world / in_mesh).sqrt() as f32;
    if scale.is_finite() && scale > 0.0 { scale } else { 1.0 }
}

fn area(positions: &[Vec3], primitive: &Primitive) -> f64 {
    if primitive.topology != Topology::Triangles {
        return 0.0;
    }
    let corner = |index: u32| positions[index as usize].as_dvec3();
    let triangles = primitive.indices.chunks_exact(3).map(|triangle| triangle.iter().map(|&index| corner(index)));
    triangles
        .map(|mut triangle| match (triangle.next(), triangle.next(), triangle.next()) {
            (Some(a), Some(b), Some(c)) => 0.5 * (b - a).cross(c - a).length(),
            _ => 0.0,
        })
        .sum()
}

/// Outline of everything that a scene shows in a pose, in world space; empty for an empty scene.
///
/// From the vertices of rigid, morphed and skinned meshes; a skinned primitive of more than 100,000 vertices adds a box
/// that is never too small.
pub fn world_hull(asset: &Asset, scene: usize, pose: &Pose) -> Hull {
    let mut hull = Hull::default();
    for instance in instances(asset, scene, pose).iter().filter(|instance| instance.is_visible) {
        for primitive in &asset.meshes[instance.mesh].primitives {
            let Instance { world_from_object, joints, morph_weights, .. } = instance;
            hull.extend(&outer_points(primitive, *world_from_object, joints, morph_weights));
        }
    }
    hull
}

/// Only vertices that an index uses count: files share one vertex list among primitives.
fn outer_points(primitive: &Primitive, matrix: Mat4, joints: &[Mat4], weights: &[f32]) -> Vec<Vec3> {
    let mut used = vec![false; primitive.vertices.positions.len()];
    for &index in &primitive.indices {
        used[index as usize] = true;
    }
    if !joints.is_empty() && used.len() > EXACT_SKINNED_VERTICES {
        let bounds = joint_boxes(primitive, &used, joints, weights).transformed(matrix);
        return if bounds.is_empty() { Vec::new() } else { bounds.corners().to_vec() };
    }
    let positions = deformed_positions(primitive, joints, weights);
    let places = positions.iter().zip(&used).filter(|&(_, &used)| used);
    places.map(|(&position, _)| matrix.transform_point3(position)).collect()
}

/// Boxes around what each joint of a primitive moves, in the space of the mesh: from these, and from nothing else of the
/// mesh, follows a box around any pose.
#[derive(Debug, Clone)]
pub struct JointBoxes {
    /// By joint; the one box around all vertices where no joint moves any.
    boxes: Vec<Aabb>,
    is_skinned: bool,
    /// Longest offset of each morph target.
    morphs: Vec<f32>,
}

impl JointBoxes {
    /// Those of a primitive.
    pub fn of(primitive: &Primitive) -> Self {
        let vertices = &primitive.vertices;
        let longest = |offsets: &[Vec3]| offsets.iter().map(|offset| offset.length()).fold(0.0, f32::max);
        let morphs = primitive.morph_targets.iter().map(|target| longest(&target.positions)).collect();
        if vertices.influences_per_vertex == 0 {
            let boxes = vec![Aabb::around(vertices.positions.iter().copied())];
            return Self { boxes, is_skinned: false, morphs };
        }
        let joints = vertices.joints.iter().map(|(joint, _)| usize::from(*joint) + 1).max().unwrap_or(0);
        let mut boxes = vec![Aabb::EMPTY; joints];
        for (vertex, &position) in vertices.positions.iter().enumerate() {
            for &(joint, weight) in influences(vertices, vertex) {
                if weight > 0.0 {
                    let joint_box = &mut boxes[usize::from(joint)];
                    *joint_box = joint_box.union(Aabb { min: position, max: position });
                }
            }
        }
        Self { boxes, is_skinned: true, morphs }
    }

    /// A box around the primitive, posed by `world_from_mesh` of each joint and morph weights: a skinned vertex is a
    /// weighted mean of its joints' images of it, so it lies in the union of each joint's image of the box around all
    /// vertices that the joint moves.
    pub fn posed(&self, joints: &[Mat4], weights: &[f32]) -> Aabb {
        let reach: f32 = self.morphs.iter().zip(weights).map(|(longest, weight)| longest * weight.abs()).sum();
        let grown = |bounds: &Aabb| match bounds.is_empty() {
            true => *bounds,
            false => Aabb { min: bounds.min - reach, max: bounds.max + reach },
        };
        if !self.is_skinned || joints.is_empty() {
            return self.boxes.iter().fold(Aabb::EMPTY, |all, bounds| all.union(grown(bounds)));
        }
        let posed = self.boxes.iter().zip(joints).map(|(bounds, joint)| grown(bounds).transformed(*joint));
        posed.fold(Aabb::EMPTY, Aabb::union)
    }
}

/// A skinned vertex is a weighted mean of its joints' images of it, so it lies in the union of each joint's image of
/// the box around all vertices that the joint moves.
fn joint_boxes(primitive: &Primitive, used: &[bool], joints: &[Mat4], weights: &[f32]) -> Aabb {
    let mut boxes = vec![Aabb::EMPTY; joints.len()];
    for (vertex, &position) in morphed_positions(primitive, weights).iter().enumerate().filter(|&(i, _)| used[i]) {
        for &(joint, weight) in influences(&primitive.vertices, vertex) {
            if weight > 0.0 {
                let joint_box = &mut boxes[usize::from(joint)];
                *joint_box = joint_box.union(Aabb { min: position, max: position });
            }
        }
    }
    boxes.iter().zip(joints).fold(Aabb::EMPTY, |bounds, (joint_box, &joint)| bounds.union(joint_box.transformed(joint)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::{AssetScene, Mesh, MorphTarget, Node, Skin, Transform, Vertices};
    use glam::Quat;

    fn asset() -> Asset {
        let primitive = Primitive {
            indices: vec![0, 1],
            vertices: Vertices {
                // The third vertex is used by no index.
                positions: vec![Vec3::ZERO, Vec3::new(2.0, 0.0, 0.0), Vec3::splat(1e6)],
                joints: vec![(0, 1.0), (1, 1.0), (1, 1.0)],
                influences_per_vertex: 1,
                ..Vertices::default()
            },
            morph_targets: vec![MorphTarget { positions: vec![Vec3::Z; 3], ..MorphTarget::default() }],
            ..Primitive::default()
        };
        let place = |translation, scale| Transform::Trs { translation, rotation: Quat::from_rotation_z(1.0), scale };
        Asset {
            scenes: vec![AssetScene { name: None, roots: vec![0, 1] }],
            nodes: vec![
                Node { mesh: Some(0), weights: vec![0.0], ..Node::default() },
                Node { transform: place(Vec3::new(0.0, 5.0, 0.0), Vec3::splat(3.0)), ..Node::default() },
            ],
            meshes: vec![Mesh { primitives: vec![primitive], ..Mesh::default() }],
            skins: vec![Skin { joints: vec![0, 1], inverse_bind: vec![Mat4::IDENTITY; 2] }],
            ..Asset::default()
        }
    }

    fn bounds(asset: &Asset) -> Aabb {
        world_hull(asset, 0, &pose(asset, None, 0.0)).bounds()
    }

    #[test]
    fn turning_joints_does_not_change_the_scale() {
        let mut asset = asset();
        let primitive = &mut asset.meshes[0].primitives[0];
        primitive.vertices.positions[2] = Vec3::Y;
        primitive.indices = vec![0, 1, 2];
        asset.nodes[0].skin = Some(0);
        // Both joints turn the triangle by the same angle; the second one's node also moves and scales it by 3.
        asset.meshes[0].primitives[0].vertices.joints = vec![(1, 1.0); 3];
        assert!((object_scale(&asset, 0) - 3.0).abs() < 1e-5);
        asset.nodes[0].skin = None;
        assert!((object_scale(&asset, 0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn unused_vertices_do_not_count_and_morphs_do() {
        let mut asset = asset();
        assert_eq!(bounds(&asset), Aabb { min: Vec3::ZERO, max: Vec3::new(2.0, 0.0, 0.0) });
        asset.nodes[0].weights = vec![0.5];
        assert_eq!(bounds(&asset), Aabb { min: Vec3::new(0.0, 0.0, 0.5), max: Vec3::new(2.0, 0.0, 0.5) });
    }

    #[test]
    fn skinned_meshes_are_bounded_where_their_joints_put_them() {
        let mut asset = asset();
        asset.nodes[0].skin = Some(0);
        let exact = bounds(&asset);
        let tip = Vec3::new(6.0 * 1f32.cos(), 5.0 + 6.0 * 1f32.sin(), 0.0);
        assert!((exact.max - tip).length() < 1e-5 && exact.min == Vec3::ZERO);
        let joints = joint_matrices(&asset, 0, &pose(&asset, None, 0.0));
        let boxes = joint_boxes(&asset.meshes[0].primitives[0], &[true, true, false], &joints, &[]);
        assert!((boxes.max - exact.max).length() < 1e-5 && (boxes.min - exact.min).length() < 1e-5);
    }

    #[test]
    fn an_empty_scene_has_empty_bounds() {
        assert!(bounds(&Asset::default()).is_empty());
    }
}
