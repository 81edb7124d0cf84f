//! Scenes in the making.

use crate::asset::{
    Asset, AssetScene, Camera, Light, LightKind, Material, Mesh, Node, Primitive, Projection, Transform,
};
use glam::{Mat3, Quat, Vec3};

/// A scene in the making: every object is a root node.
#[derive(Default)]
pub(super) struct Set(Asset);

impl Set {
    pub(super) fn material(&mut self, material: Material) -> usize {
        self.0.materials.push(material);
        self.0.materials.len() - 1
    }

    pub(super) fn object(
        &mut self,
        name: &str,
        primitive: Primitive,
        material: usize,
        translation: Vec3,
        rotation: Quat,
    ) {
        let primitives = vec![Primitive { material, ..primitive }];
        self.0.meshes.push(Mesh { name: Some(name.to_owned()), primitives, weights: Vec::new() });
        let transform = Transform::Trs { translation, rotation, scale: Vec3::ONE };
        let mesh = Some(self.0.meshes.len() - 1);
        self.0.nodes.push(Node { name: Some(name.to_owned()), mesh, transform, ..Node::default() });
    }

    pub(super) fn light(&mut self, name: &str, kind: LightKind, color: [f32; 3], intensity: f32, from: Vec3, to: Vec3) {
        self.0.lights.push(Light { name: Some(name.to_owned()), color: Vec3::from(color), intensity, kind });
        let light = Some(self.0.lights.len() - 1);
        let transform = looking(from, to);
        self.0.nodes.push(Node { name: Some(name.to_owned()), light, transform, ..Node::default() });
    }

    pub(super) fn camera(&mut self, name: &str, projection: Projection, from: Vec3, to: Vec3) {
        self.0.cameras.push(Camera { name: Some(name.to_owned()), projection });
        let camera = Some(self.0.cameras.len() - 1);
        let transform = looking(from, to);
        self.0.nodes.push(Node { name: Some(name.to_owned()), camera, transform, ..Node::default() });
    }

    pub(super) fn asset(mut self, name: &str) -> Asset {
        let roots = (0..self.0.nodes.len()).collect();
        self.0.scenes.push(AssetScene { name: Some(name.to_owned()), roots });
        self.0
    }
}

/// A node whose -Z points from one place to another; the two differ, and not along Y alone.
fn looking(from: Vec3, to: Vec3) -> Transform {
    let backwards = (from - to).normalize();
    let right = Vec3::Y.cross(backwards).normalize();
    let rotation = Quat::from_mat3(&Mat3::from_cols(right, backwards.cross(right), backwards));
    Transform::Trs { translation: from, rotation, scale: Vec3::ONE }
}
