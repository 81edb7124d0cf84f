//! Skinning and morphing on the device give the picture of the same mesh deformed by the twin on the host.

use crate::headless::headless;
use crate::scenes::three_lights;
use crate::stage::{Stage, at, options, plain};
use glam::{Mat4, Quat, Vec3, Vec4};
use vair::asset::procedural::{capsule, cube};
use vair::asset::{Material, MorphTarget, Node, Primitive, Skin, Transform};
use vair::material::{Fur, Length};
use vair::render::Picture;
use vair::scene::{Scene, deform, joint_matrices, pose};

const WEIGHTS: [f32; 2] = [0.7, -0.3];

/// A tube of three joints along Y with four influences a vertex, two morph targets and a normal map.
fn tube() -> Primitive {
    let mut tube = capsule(0.25, 0.6, 24, 40);
    let vertices = &mut tube.vertices;
    vertices.influences_per_vertex = 4;
    for position in &vertices.positions {
        // Weights fade over the middle joint; the fourth influence is unused, as files pad them.
        let along = (position.y / 1.2 + 0.5).clamp(0.0, 1.0);
        let (low, high) = ((1.0 - 2.0 * along).max(0.0), (2.0 * along - 1.0).max(0.0));
        vertices.joints.extend([(0, low), (1, 1.0 - low - high), (2, high), (0, 0.0)]);
    }
    let positions = &vertices.positions;
    tube.morph_targets = vec![
        MorphTarget {
            positions: positions.iter().map(|p| Vec3::new(p.x, 0.0, p.z) * (0.5 + 0.5 * (7.0 * p.y).sin())).collect(),
            normals: positions.iter().map(|p| Vec3::Y * 0.3 * (7.0 * p.y).cos()).collect(),
            tangents: positions.iter().map(|p| Vec3::Y * 0.2 * p.x).collect(),
        },
        // A target may leave attributes alone.
        MorphTarget { positions: vec![Vec3::new(0.2, 0.0, -0.1); positions.len()], ..MorphTarget::default() },
    ];
    tube
}

/// Joints in a chain: turned, moved and scaled unevenly, under a parent of their own.
fn add_joints(stage: &mut Stage) -> usize {
    let first = stage.asset.nodes.len();
    let trs = |y: f32, turn: f32, scale: Vec3| Transform::Trs {
        translation: Vec3::Y * y,
        rotation: Quat::from_rotation_z(turn) * Quat::from_rotation_y(2.0 * turn),
        scale,
    };
    let poses = [trs(-0.5, 0.15, Vec3::ONE), trs(0.5, -0.5, Vec3::new(1.2, 0.9, 1.1)), trs(0.5, 0.8, Vec3::ONE)];
    for (index, transform) in poses.into_iter().enumerate() {
        let children = if index < 2 { vec![first + index + 1] } else { Vec::new() };
        stage.asset.nodes.push(Node { transform, children, ..Node::default() });
    }
    let inverse_bind = [-0.6f32, 0.0, 0.6].map(|y| Mat4::from_translation(Vec3::Y * -y)).to_vec();
    stage.asset.skins.push(Skin { joints: (first..first + 3).collect(), inverse_bind });
    stage.asset.skins.len() - 1
}

fn bumpy(stage: &mut Stage) -> usize {
    let normal_texture = Some(stage.texel([160, 110, 230, 255]));
    let base_color = Vec4::new(0.7, 0.5, 0.4, 1.0);
    stage.material(Material { normal_texture, base_color, roughness: 0.6, ..plain() })
}

fn set() -> Stage {
    let mut stage = Stage::default();
    stage.parallel_camera(1.1, Vec3::new(0.3, 0.2, 1.0), Vec3::Y);
    three_lights(&mut stage);
    stage
}

/// The tube, skinned and morphed, or only morphed.
pub fn bent_tube(skinned: bool) -> Scene {
    let mut stage = set();
    let material = bumpy(&mut stage);
    let mut primitive = tube();
    let node = if skinned {
        let skin = add_joints(&mut stage);
        // A skinned mesh's own node is ignored.
        let node = stage.object(primitive, material, at(Vec3::ONE));
        stage.asset.nodes[node].skin = Some(skin);
        node
    } else {
        primitive.vertices.joints.clear();
        primitive.vertices.influences_per_vertex = 0;
        stage.object(primitive, material, at(Vec3::X * 0.1))
    };
    stage.asset.nodes[node].weights = WEIGHTS.to_vec();
    stage.scene()
}

/// The same, deformed by the twin beforehand.
fn deformed_tube(skinned: bool) -> Scene {
    let of = bent_tube(skinned);
    let pose = pose(of.asset(), None, 0.0);
    let joints = if skinned { joint_matrices(of.asset(), 0, &pose) } else { Vec::new() };
    let source = &of.asset().meshes[0].primitives[0];
    let mut vertices = deform(source, &joints, &WEIGHTS);
    vertices.joints.clear();
    vertices.influences_per_vertex = 0;
    let mut stage = set();
    let material = bumpy(&mut stage);
    let primitive = Primitive { indices: source.indices.clone(), vertices, ..Primitive::default() };
    stage.object(primitive, material, at(if skinned { Vec3::ZERO } else { Vec3::X * 0.1 }));
    stage.scene()
}

/// Four influences of matrices that f32 multiplies err by some 1e-6 of a position, a ten-thousandth of a pixel here, and
/// by as much in a unit normal: half floats show the rest. Only a pixel whose middle an edge just misses may change.
fn same_picture(what: &str, found: &Picture, expected: &Picture) {
    let covered = expected.radiance.iter().filter(|radiance| radiance.w > 0.0).count();
    let differ = |(a, b): &(&Vec4, &Vec4)| (**a - **b).abs().max_element() > 2e-3 * b.max_element() + 1e-5;
    let differing = found.radiance.iter().zip(&expected.radiance).filter(differ).count();
    assert!(covered > 1000, "{what}: only {covered} pixels are covered");
    assert!(differing * 500 <= covered, "{what}: {differing} of {covered} pixels differ");
}

#[test]
fn a_deformed_mesh_looks_as_its_twin() {
    headless(|device| {
        let frame = options([128, 128], 1);
        let rest = {
            let mut asset = bent_tube(false).asset().clone();
            asset.nodes.iter_mut().for_each(|node| node.weights.fill(0.0));
            device.picture(&Scene::from_asset(asset).unwrap(), &frame)
        };
        for skinned in [true, false] {
            let found = device.picture(&bent_tube(skinned), &frame);
            let expected = device.picture(&deformed_tube(skinned), &frame);
            same_picture(if skinned { "skinned and morphed" } else { "morphed" }, &found, &expected);
            let moved = found.radiance.iter().zip(&rest.radiance).filter(|(a, b)| a.w != b.w).count();
            assert!(moved > 200, "only {moved} pixels tell the pose from the rest");
        }
    });
}

#[test]
fn fur_on_a_joint_looks_as_fur_on_a_node() {
    let placed = Transform::Trs {
        translation: Vec3::new(0.1, -0.1, 0.2),
        rotation: Quat::from_rotation_y(0.7) * Quat::from_rotation_x(0.3),
        scale: Vec3::ONE,
    };
    let scene = |on_joint: bool| {
        let mut stage = set();
        let material = stage.material(Material { base_color: Vec4::new(0.5, 0.3, 0.2, 1.0), ..plain() });
        let mut primitive = cube(0.4);
        if on_joint {
            primitive.vertices.influences_per_vertex = 4;
            let alone = [(0, 1.0), (0, 0.0), (0, 0.0), (0, 0.0)];
            primitive.vertices.joints = alone.repeat(primitive.vertices.positions.len());
            stage.asset.nodes.push(Node { transform: placed, ..Node::default() });
            let joints = vec![stage.asset.nodes.len() - 1];
            stage.asset.skins.push(Skin { joints, inverse_bind: vec![Mat4::IDENTITY] });
            let node = stage.object(primitive, material, at(Vec3::ONE));
            stage.asset.nodes[node].skin = Some(0);
        } else {
            stage.object(primitive, material, placed);
        }
        let mut scene = stage.scene();
        // Shares of the rest pose, which both have in common.
        let (length, strand_spacing) = (Length::Metres(0.1), Length::Relative(0.07));
        scene.materials_mut()[material].fur = Some(Fur { length, strand_spacing, layers: 12, ..Fur::default() });
        scene
    };
    headless(|device| {
        let frame = options([128, 128], 1);
        let [found, expected] = [true, false].map(|on_joint| device.picture(&scene(on_joint), &frame));
        let covered = expected.radiance.iter().filter(|radiance| radiance.w > 0.0).count();
        let differ = |(a, b): &(&Vec4, &Vec4)| (**a - **b).abs().max_element() > 0.02 * b.max_element() + 1e-4;
        let differing = found.radiance.iter().zip(&expected.radiance).filter(differ).count();
        // Strands have many edges: a ten-thousandth of a pixel decides more often than on a smooth surface.
        assert!(covered > 3000 && differing * 100 <= covered, "{differing} of {covered} pixels differ");
    });
}
