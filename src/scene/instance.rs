//! What a scene draws: one entry per primitive of every node that holds a mesh.

use glam::{Mat4, Vec3};

use super::Pose;
use crate::asset::Asset;

/// One primitive to draw.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    /// Index into [`Asset::nodes`].
    pub node: usize,
    /// Index into [`Asset::meshes`].
    pub mesh: usize,
    /// Index into the mesh's primitives.
    pub primitive: usize,
    /// Index into [`Asset::materials`], the variant's where one is chosen.
    pub material: usize,
    /// Identity for a skinned mesh: its joints carry it to the world and its node is ignored (glTF 2.0, 3.7.3.3).
    pub world_from_object: Mat4,
    /// The transform mirrors, so that clockwise triangles are the front ones.
    pub mirrored: bool,
    /// Index into [`Asset::skins`].
    pub skin: Option<usize>,
    /// One per morph target; empty without any.
    pub morph_weights: Vec<f32>,
}

/// All primitives of a scene in file order (depth first). Nodes whose scale is 0 on all axes are invisible and left
/// out (glTF 2.0, 3.5.3; a flattened one is shown); a scene index beyond the file shows nothing.
///
/// A skinned mesh is taken as mirrored when its first joint mirrors: rigs mirror as a whole.
pub fn instances(asset: &Asset, scene: usize, pose: &Pose, variant: Option<usize>) -> Vec<Instance> {
    let mut found = Vec::new();
    for index in nodes_of_scene(asset, scene) {
        let node = &asset.nodes[index];
        let Some(mesh) = node.mesh else { continue };
        let skin = node.skin.filter(|&skin| !asset.skins[skin].joints.is_empty());
        let carrier = skin.map_or(index, |skin| asset.skins[skin].joints[0]);
        let volume = unit_volume(pose.world_from_node[carrier]);
        let vanishes = |matrix: Mat4| (0..3).all(|axis| matrix.col(axis).truncate() == Vec3::ZERO);
        if skin.is_none() && vanishes(pose.world_from_node[index]) {
            continue;
        }
        for (primitive, data) in asset.meshes[mesh].primitives.iter().enumerate() {
            let of_variant = data.variant_materials.iter().find(|&&(of, _)| Some(of) == variant);
            found.push(Instance {
                node: index,
                mesh,
                primitive,
                material: of_variant.map_or(data.material, |&(_, material)| material),
                world_from_object: if skin.is_some() { Mat4::IDENTITY } else { pose.world_from_node[index] },
                mirrored: volume < 0.0,
                skin,
                morph_weights: pose.weights[index].clone(),
            });
        }
    }
    found
}

/// `world_from_mesh` per joint of a skin: where the joint is now times where it was bound.
pub fn joint_matrices(asset: &Asset, skin: usize, pose: &Pose) -> Vec<Mat4> {
    let skin = &asset.skins[skin];
    skin.joints
        .iter()
        .zip(&skin.inverse_bind)
        .map(|(&joint, &joint_from_mesh)| pose.world_from_node[joint] * joint_from_mesh)
        .collect()
}

/// Nodes of a scene, parents before children, in file order; none for an index beyond the file.
pub fn nodes_of_scene(asset: &Asset, scene: usize) -> Vec<usize> {
    let mut open: Vec<usize> =
        asset.scenes.get(scene).map(|scene| scene.roots.iter().rev().copied().collect()).unwrap_or_default();
    let mut nodes = Vec::new();
    while let Some(node) = open.pop() {
        nodes.push(node);
        open.extend(asset.nodes[node].children.iter().rev());
    }
    nodes
}

/// Determinant of the 3x3 part with its columns normalised: independent of scale, 0 when a column vanishes.
fn unit_volume(matrix: Mat4) -> f32 {
    let axis = |column: glam::Vec4| column.truncate().normalize_or_zero();
    axis(matrix.x_axis).dot(axis(matrix.y_axis).cross(axis(matrix.z_axis)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::{AssetScene, Mesh, Node, Primitive, Skin, Transform};
    use crate::scene::pose;
    use glam::Quat;

    fn scaled(scale: Vec3, children: Vec<usize>) -> Node {
        let transform = Transform::Trs { translation: Vec3::ZERO, rotation: Quat::from_rotation_x(0.3), scale };
        Node { mesh: Some(0), transform, children, ..Node::default() }
    }

    fn asset(nodes: Vec<Node>) -> Asset {
        let primitive = Primitive { material: 1, variant_materials: vec![(0, 2)], ..Primitive::default() };
        Asset {
            scenes: vec![AssetScene { name: None, roots: vec![0] }],
            nodes,
            meshes: vec![Mesh { primitives: vec![primitive], ..Mesh::default() }],
            ..Asset::default()
        }
    }

    #[test]
    fn mirrors_multiply_down_the_tree() {
        let mirror = Vec3::new(-1.0, 1.0, 1.0);
        let asset = asset(vec![scaled(mirror, vec![1]), scaled(mirror, vec![2]), scaled(-Vec3::ONE, vec![])]);
        let mirrored: Vec<bool> =
            instances(&asset, 0, &pose(&asset, None, 0.0), None).iter().map(|instance| instance.mirrored).collect();
        assert_eq!(mirrored, [true, false, true]);
    }

    #[test]
    fn nothing_is_invisible_with_its_children_and_flat_or_tiny_is_not() {
        let flat = asset(vec![scaled(Vec3::new(1.0, 0.0, 1.0), vec![1]), scaled(Vec3::ONE, vec![])]);
        assert_eq!(instances(&flat, 0, &pose(&flat, None, 0.0), None).len(), 2);
        let nothing = asset(vec![scaled(Vec3::ZERO, vec![1]), scaled(Vec3::ONE, vec![])]);
        assert!(instances(&nothing, 0, &pose(&nothing, None, 0.0), None).is_empty());
        let tiny = asset(vec![scaled(Vec3::splat(1e-12), vec![])]);
        assert_eq!(instances(&tiny, 0, &pose(&tiny, None, 0.0), None).len(), 1);
    }

    #[test]
    fn variants_choose_materials() {
        let asset = asset(vec![scaled(Vec3::ONE, vec![])]);
        let pose = pose(&asset, None, 0.0);
        let material = |variant| instances(&asset, 0, &pose, variant)[0].material;
        assert_eq!((material(None), material(Some(0)), material(Some(1))), (1, 2, 1));
    }

    #[test]
    fn skinned_meshes_ignore_their_node_and_mirror_with_their_joints() {
        let mut asset = asset(vec![scaled(Vec3::ZERO, vec![]), scaled(Vec3::new(1.0, -2.0, 1.0), vec![])]);
        let bind = Mat4::from_translation(Vec3::X);
        asset.skins = vec![Skin { joints: vec![1], inverse_bind: vec![bind] }];
        asset.nodes[0].skin = Some(0);
        let pose = pose(&asset, None, 0.0);
        let [instance] = &instances(&asset, 0, &pose, None)[..] else { panic!("one instance") };
        assert_eq!((instance.world_from_object, instance.mirrored, instance.skin), (Mat4::IDENTITY, true, Some(0)));
        assert_eq!(joint_matrices(&asset, 0, &pose), [pose.world_from_node[1] * bind]);
    }

    #[test]
    fn an_unknown_scene_shows_nothing() {
        let asset = asset(vec![scaled(Vec3::ONE, vec![])]);
        assert!(instances(&asset, 9, &pose(&asset, None, 0.0), None).is_empty());
    }
}
