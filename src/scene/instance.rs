//! What a scene draws: placed meshes, and their parts with a material each.

use glam::{Mat4, Vec3};

use super::Pose;
use crate::asset::Asset;

/// A mesh, placed and posed.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    /// Index into [`Asset::nodes`] of the node that places it; `None` where a host does.
    pub node: Option<usize>,
    /// Index into [`Asset::meshes`].
    pub mesh: usize,
    /// Index into [`Asset::skins`].
    pub skin: Option<usize>,
    /// Identity for a skinned mesh: its joints carry it to the world and its node is ignored (glTF 2.0, 3.7.3.3).
    pub world_from_object: Mat4,
    /// The transform mirrors, so that clockwise triangles are the front ones. A skinned mesh is taken as mirrored when its
    /// first joint mirrors: rigs mirror as a whole.
    pub mirrored: bool,
    /// `world_from_mesh` of each joint of the skin: where the joint is times the inverse of where it was bound. Empty
    /// without a skin.
    pub joints: Vec<Mat4>,
    /// One per morph target; empty without any.
    pub morph_weights: Vec<f32>,
    /// False for a scale of 0 on all axes (glTF 2.0, 3.5.3; a flattened one is shown).
    pub is_visible: bool,
}

/// A primitive of an instance: one material, one set of vertices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Part {
    /// Index into the list of instances.
    pub instance: usize,
    /// Index into [`Asset::meshes`].
    pub mesh: usize,
    /// Index into the mesh's primitives.
    pub primitive: usize,
    /// Index into [`Asset::materials`], the variant's where one is chosen.
    pub material: usize,
}

impl Instance {
    /// A mesh in a place, at rest. Joints come with [`Self::set_joints`].
    pub fn placed(asset: &Asset, mesh: usize, skin: Option<usize>, world_from_object: Mat4) -> Self {
        let joints = vec![Mat4::IDENTITY; skin.map_or(0, |skin| asset.skins[skin].joints.len())];
        let morph_weights = asset.meshes[mesh].weights.clone();
        let (mirrored, is_visible) = (false, true);
        let mut instance =
            Self { node: None, mesh, skin, world_from_object, mirrored, joints, morph_weights, is_visible };
        instance.set_transform(world_from_object);
        instance
    }

    /// Moves it; of a skinned one, only joints do.
    pub fn set_transform(&mut self, world_from_object: Mat4) {
        if self.joints.is_empty() {
            self.world_from_object = world_from_object;
            self.mirrored = unit_volume(world_from_object) < 0.0;
            self.is_visible = !vanishes(world_from_object);
        } else {
            self.world_from_object = Mat4::IDENTITY;
        }
    }

    /// Poses a skinned one: `world_from_mesh` of each joint.
    pub fn set_joints(&mut self, world_from_mesh: impl IntoIterator<Item = Mat4>) {
        for (joint, matrix) in self.joints.iter_mut().zip(world_from_mesh) {
            *joint = matrix;
        }
    }

    /// Takes the place that a pose gives its node, in the memory that it has.
    fn pose(&mut self, asset: &Asset, pose: &Pose) {
        let Some(node) = self.node else { return };
        self.morph_weights.clone_from(&pose.weights[node]);
        let Some(skin) = self.skin.map(|skin| &asset.skins[skin]) else {
            return self.set_transform(pose.world_from_node[node]);
        };
        self.world_from_object = Mat4::IDENTITY;
        // The joint itself tells whether it mirrors; its matrix here says how it has moved since it was bound.
        self.mirrored = unit_volume(pose.world_from_node[skin.joints[0]]) < 0.0;
        let bound = skin.joints.iter().zip(&skin.inverse_bind);
        self.set_joints(bound.map(|(&joint, &joint_from_mesh)| pose.world_from_node[joint] * joint_from_mesh));
    }
}

/// All placed meshes of a scene in file order (depth first), posed; a scene index beyond the file shows nothing.
pub fn instances(asset: &Asset, scene: usize, pose: &Pose) -> Vec<Instance> {
    let of_node = |node: usize| {
        let mesh = asset.nodes[node].mesh?;
        let skin = asset.nodes[node].skin.filter(|&skin| !asset.skins[skin].joints.is_empty());
        let placed = Instance::placed(asset, mesh, skin, Mat4::IDENTITY);
        Some(Instance { node: Some(node), ..placed })
    };
    let mut instances: Vec<Instance> = nodes_of_scene(asset, scene).into_iter().filter_map(of_node).collect();
    pose_instances(&mut instances, asset, pose);
    instances
}

/// Poses instances that nodes have placed, in the memory that they have.
pub fn pose_instances(instances: &mut [Instance], asset: &Asset, pose: &Pose) {
    for instance in instances {
        instance.pose(asset, pose);
    }
}

/// The parts of those instances that are visible, one after another, with the materials of a variant.
pub fn parts(asset: &Asset, instances: &[Instance], variant: Option<usize>) -> Vec<Part> {
    let of_instance = |(index, Instance { mesh, .. }): (usize, &Instance)| {
        let mesh = *mesh;
        asset.meshes[mesh].primitives.iter().enumerate().map(move |(primitive, data)| {
            let of_variant = data.variant_materials.iter().find(|&&(of, _)| Some(of) == variant);
            let material = of_variant.map_or(data.material, |&(_, material)| material);
            Part { instance: index, mesh, primitive, material }
        })
    };
    instances.iter().enumerate().filter(|(_, instance)| instance.is_visible).flat_map(of_instance).collect()
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

/// Nothing is left of it on any axis.
fn vanishes(matrix: Mat4) -> bool {
    (0..3).all(|axis| matrix.col(axis).truncate() == Vec3::ZERO)
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

    fn shown(asset: &Asset) -> usize {
        parts(asset, &instances(asset, 0, &pose(asset, None, 0.0)), None).len()
    }

    #[test]
    fn mirrors_multiply_down_the_tree() {
        let mirror = Vec3::new(-1.0, 1.0, 1.0);
        let asset = asset(vec![scaled(mirror, vec![1]), scaled(mirror, vec![2]), scaled(-Vec3::ONE, vec![])]);
        let mirrored: Vec<bool> =
            instances(&asset, 0, &pose(&asset, None, 0.0)).iter().map(|instance| instance.mirrored).collect();
        assert_eq!(mirrored, [true, false, true]);
    }

    #[test]
    fn nothing_is_invisible_with_its_children_and_flat_or_tiny_is_not() {
        let flat = asset(vec![scaled(Vec3::new(1.0, 0.0, 1.0), vec![1]), scaled(Vec3::ONE, vec![])]);
        assert_eq!(shown(&flat), 2);
        let nothing = asset(vec![scaled(Vec3::ZERO, vec![1]), scaled(Vec3::ONE, vec![])]);
        assert_eq!(shown(&nothing), 0);
        let tiny = asset(vec![scaled(Vec3::splat(1e-12), vec![])]);
        assert_eq!(shown(&tiny), 1);
    }

    #[test]
    fn variants_choose_materials() {
        let asset = asset(vec![scaled(Vec3::ONE, vec![])]);
        let placed = instances(&asset, 0, &pose(&asset, None, 0.0));
        let material = |variant| parts(&asset, &placed, variant)[0].material;
        assert_eq!((material(None), material(Some(0)), material(Some(1))), (1, 2, 1));
    }

    #[test]
    fn skinned_meshes_ignore_their_node_and_mirror_with_their_joints() {
        let mut asset = asset(vec![scaled(Vec3::ZERO, vec![]), scaled(Vec3::new(1.0, -2.0, 1.0), vec![])]);
        let bind = Mat4::from_translation(Vec3::X);
        asset.skins = vec![Skin { joints: vec![1], inverse_bind: vec![bind] }];
        asset.nodes[0].skin = Some(0);
        let pose = pose(&asset, None, 0.0);
        let [instance] = &instances(&asset, 0, &pose)[..] else { panic!("one instance") };
        assert_eq!((instance.world_from_object, instance.mirrored, instance.skin), (Mat4::IDENTITY, true, Some(0)));
        assert_eq!(instance.joints, joint_matrices(&asset, 0, &pose));
        assert_eq!(joint_matrices(&asset, 0, &pose), [pose.world_from_node[1] * bind]);
    }

    #[test]
    fn an_unknown_scene_shows_nothing() {
        let asset = asset(vec![scaled(Vec3::ONE, vec![])]);
        assert!(instances(&asset, 9, &pose(&asset, None, 0.0)).is_empty());
    }
}
