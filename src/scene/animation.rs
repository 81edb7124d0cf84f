//! Where every node is at a time: animation sampling (glTF 2.0, appendix C) and the node forest.

use std::ops::{Add, Mul};

use glam::{Mat4, Quat};

use crate::asset::{Animation, Asset, Interpolation, Keys, Transform};

/// All nodes at one time.
#[derive(Debug, Clone, Default)]
pub struct Pose {
    /// One per node of the file, whatever the scene.
    pub world_from_node: Vec<Mat4>,
    /// Morph weights, one list per node; empty for a node without morph targets.
    pub weights: Vec<Vec<f32>>,
    /// Of each node in its parent, and the nodes still to visit: kept so that the next pose allocates nothing.
    transforms: Vec<Transform>,
    open: Vec<(usize, Mat4)>,
}

impl PartialEq for Pose {
    fn eq(&self, other: &Self) -> bool {
        self.world_from_node == other.world_from_node && self.weights == other.weights
    }
}

/// The pose at `time_s` of a clip, or the rest pose without one.
///
/// Time is held at the first and last key of each channel; a caller that loops takes `time_s` modulo the clip's
/// `duration_s`. Where two channels drive one property the later wins. Nodes given by a matrix ignore animation.
/// An index beyond the file's clips gives the rest pose.
pub fn pose(asset: &Asset, animation: Option<usize>, time_s: f32) -> Pose {
    let mut pose = Pose::default();
    pose.set(asset, animation, time_s);
    pose
}

impl Pose {
    /// Becomes [`pose`], in the memory that it has.
    pub fn set(&mut self, asset: &Asset, animation: Option<usize>, time_s: f32) {
        self.transforms.clear();
        self.transforms.extend(asset.nodes.iter().map(|node| node.transform));
        self.weights.resize_with(asset.nodes.len(), Vec::new);
        for (weights, node) in self.weights.iter_mut().zip(&asset.nodes) {
            weights.clear();
            match node.mesh {
                Some(mesh) if node.weights.is_empty() => weights.extend(&asset.meshes[mesh].weights),
                Some(_) => weights.extend(&node.weights),
                None => {}
            }
        }
        if let Some(clip) = animation.and_then(|index| asset.animations.get(index)) {
            animate(clip, time_s, &mut self.transforms, &mut self.weights);
        }
        self.walk(asset);
    }

    /// Walks the forest without recursion: a file decides how deep it is.
    fn walk(&mut self, asset: &Asset) {
        let Self { world_from_node, transforms, open, .. } = self;
        world_from_node.clear();
        // Not yet known: what is nobody's child is a root.
        world_from_node.resize(asset.nodes.len(), Mat4::NAN);
        for &child in asset.nodes.iter().flat_map(|node| &node.children) {
            world_from_node[child] = Mat4::IDENTITY;
        }
        open.clear();
        let is_root = |node: &usize| world_from_node[*node].is_nan();
        open.extend((0..asset.nodes.len()).filter(is_root).map(|root| (root, Mat4::IDENTITY)));
        while let Some((node, world_from_parent)) = open.pop() {
            let world = world_from_parent * transforms[node].matrix();
            world_from_node[node] = world;
            open.extend(asset.nodes[node].children.iter().map(|&child| (child, world)));
        }
    }
}

fn animate(clip: &Animation, time_s: f32, transforms: &mut [Transform], weights: &mut [Vec<f32>]) {
    for channel in &clip.channels {
        let span = Span::at(&channel.times_s, time_s);
        let how = channel.interpolation;
        match (&channel.values, &mut transforms[channel.node]) {
            (Keys::Translation(keys), Transform::Trs { translation, .. }) => {
                *translation = span.sample(how, |i| keys[i], |a, b, t| a.lerp(b, t));
            }
            (Keys::Scale(keys), Transform::Trs { scale, .. }) => {
                *scale = span.sample(how, |i| keys[i], |a, b, t| a.lerp(b, t));
            }
            (Keys::Rotation(keys), Transform::Trs { rotation, .. }) => {
                // glam's slerp turns along the shorter arc, as the appendix asks.
                let sampled = span.sample(how, |i| keys[i], Quat::slerp);
                *rotation = if sampled.length_squared() > 0.0 { sampled.normalize() } else { Quat::IDENTITY };
            }
            (&Keys::Weights { targets, ref values }, _) => {
                weights[channel.node].clear();
                let sample = |target| span.sample(how, |i| values[i * targets + target], |a, b, t| a + (b - a) * t);
                weights[channel.node].extend((0..targets).map(sample));
            }
            (_, Transform::Matrix(_)) => {}
        }
    }
}

/// Two neighbouring keys of a channel and the place between them.
struct Span {
    key: usize,
    next: usize,
    /// 0 at `key`, 1 at `next`.
    fraction: f32,
    duration_s: f32,
}

impl Span {
    /// `times_s` is not empty and increases; a time that is not a number counts as the first key's.
    fn at(times_s: &[f32], time_s: f32) -> Self {
        let after = times_s.partition_point(|&key_s| key_s <= time_s);
        let key = after.saturating_sub(1);
        let next = after.min(times_s.len() - 1);
        let duration_s = times_s[next] - times_s[key];
        let fraction = if duration_s > 0.0 { (time_s - times_s[key]) / duration_s } else { 0.0 };
        Self { key, next, fraction, duration_s }
    }

    /// Appendix C; `value` gives stored values: one per key, or in-tangent, value, out-tangent for cubic splines.
    fn sample<T>(&self, how: Interpolation, value: impl Fn(usize) -> T, between: impl Fn(T, T, f32) -> T) -> T
    where
        T: Add<Output = T> + Mul<f32, Output = T>,
    {
        match how {
            Interpolation::Step => value(self.key),
            Interpolation::Linear if self.key == self.next => value(self.key),
            Interpolation::Linear => between(value(self.key), value(self.next), self.fraction),
            Interpolation::CubicSpline => {
                let (t, t2, t3) = (self.fraction, self.fraction.powi(2), self.fraction.powi(3));
                value(3 * self.key + 1) * (2.0 * t3 - 3.0 * t2 + 1.0)
                    + value(3 * self.key + 2) * (self.duration_s * (t3 - 2.0 * t2 + t))
                    + value(3 * self.next + 1) * (3.0 * t2 - 2.0 * t3)
                    + value(3 * self.next) * (self.duration_s * (t3 - t2))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::{Channel, Mesh, Node};
    use glam::Vec3;
    use std::f32::consts::{FRAC_PI_2, PI};

    fn asset_with(interpolation: Interpolation, times_s: &[f32], values: Keys) -> Asset {
        let channel = Channel { node: 0, times_s: times_s.to_vec(), interpolation, values };
        Asset {
            nodes: vec![Node { mesh: Some(0), ..Node::default() }],
            meshes: vec![Mesh { weights: vec![0.25, 0.5], ..Mesh::default() }],
            animations: vec![Animation { name: None, duration_s: 3.0, channels: vec![channel] }],
            ..Asset::default()
        }
    }

    fn x_at(asset: &Asset, time_s: f32) -> f32 {
        pose(asset, Some(0), time_s).world_from_node[0].w_axis.x
    }

    fn along_x(values: &[f32]) -> Keys {
        Keys::Translation(values.iter().map(|&x| Vec3::X * x).collect())
    }

    #[test]
    fn linear_and_step_hit_their_keys_and_hold_outside() {
        let linear = asset_with(Interpolation::Linear, &[1.0, 2.0, 3.0], along_x(&[10.0, 20.0, 0.0]));
        let step = asset_with(Interpolation::Step, &[1.0, 2.0, 3.0], along_x(&[10.0, 20.0, 0.0]));
        for (time_s, on_line, on_step) in [
            (-5.0, 10.0, 10.0),
            (1.0, 10.0, 10.0),
            (1.25, 12.5, 10.0),
            (2.0, 20.0, 20.0),
            (2.5, 10.0, 20.0),
            (9.0, 0.0, 0.0),
        ] {
            assert_eq!(x_at(&linear, time_s), on_line, "linear at {time_s}");
            assert_eq!(x_at(&step, time_s), on_step, "step at {time_s}");
        }
        assert_eq!(x_at(&linear, f32::NAN), 10.0);
        assert_eq!(x_at(&linear, f32::INFINITY), 0.0);
    }

    #[test]
    fn cubic_splines_reproduce_a_cubic() {
        // x(t) = t^3 between t = 1 and 3: Hermite data determine a cubic exactly.
        let keys = along_x(&[0.0, 1.0, 3.0, 27.0, 27.0, 0.0]);
        let cubic = asset_with(Interpolation::CubicSpline, &[1.0, 3.0], keys);
        for time_s in [1.0, 1.5, 2.0, 2.75, 3.0] {
            assert!((x_at(&cubic, time_s) - time_s.powi(3)).abs() < 1e-4, "at {time_s}");
        }
    }

    #[test]
    fn rotations_turn_the_short_way_round() {
        let quarter = Quat::from_rotation_z(FRAC_PI_2);
        for end in [quarter, -quarter] {
            let turn = asset_with(Interpolation::Linear, &[0.0, 1.0], Keys::Rotation(vec![Quat::IDENTITY, end]));
            let x_axis = pose(&turn, Some(0), 0.5).world_from_node[0].x_axis.truncate();
            let expected = Vec3::new((PI / 4.0).cos(), (PI / 4.0).sin(), 0.0);
            assert!((x_axis - expected).length() < 1e-6, "{x_axis}");
        }
    }

    #[test]
    fn cubic_rotations_are_normalised_and_survive_zero() {
        let keys = Keys::Rotation(vec![Quat::from_xyzw(0.0, 0.0, 0.0, 0.0); 6]);
        let zero = asset_with(Interpolation::CubicSpline, &[0.0, 1.0], keys);
        assert_eq!(pose(&zero, Some(0), 0.5).world_from_node[0], Mat4::IDENTITY);
    }

    #[test]
    fn weights_come_from_the_clip_then_the_node_then_the_mesh() {
        let keys = Keys::Weights { targets: 2, values: vec![0.0, 1.0, 1.0, 0.0] };
        let mut asset = asset_with(Interpolation::Linear, &[0.0, 1.0], keys);
        assert_eq!(pose(&asset, None, 0.0).weights, [vec![0.25, 0.5]]);
        assert_eq!(pose(&asset, Some(0), 0.25).weights, [vec![0.25, 0.75]]);
        asset.nodes[0].weights = vec![1.0, 1.0];
        assert_eq!(pose(&asset, None, 0.0).weights, [vec![1.0, 1.0]]);
    }

    #[test]
    fn matrix_nodes_ignore_animation_and_unknown_clips_rest() {
        let mut asset = asset_with(Interpolation::Step, &[0.0], along_x(&[5.0]));
        assert_eq!(x_at(&asset, 0.0), 5.0);
        assert_eq!(pose(&asset, Some(7), 0.0), pose(&asset, None, 0.0));
        asset.nodes[0].transform = Transform::Matrix(Mat4::from_translation(Vec3::X));
        assert_eq!(x_at(&asset, 0.0), 1.0);
    }

    #[test]
    fn a_deep_chain_neither_recurses_nor_loses_a_step() {
        let depth = 100_000;
        let step = Transform::Trs { translation: Vec3::X, rotation: Quat::IDENTITY, scale: Vec3::ONE };
        let nodes = (0..depth)
            .map(|i| Node {
                children: if i + 1 < depth { vec![i + 1] } else { vec![] },
                transform: step,
                ..Node::default()
            })
            .collect();
        let asset = Asset { nodes, ..Asset::default() };
        assert_eq!(pose(&asset, None, 0.0).world_from_node[depth - 1].w_axis.x, depth as f32);
    }
}
