//! The order of what blends: from far to near, each side of a surface by how deep it lies, whatever the order of the file.
//!
//! Objects are sorted whole; where they intersect no order of objects is right.

use super::Frame;
use crate::asset::Topology;
use crate::render::plan::{Draw, DrawKind, Faces};
use crate::scene::{Instance, Side, joint_matrices};
use glam::{Mat4, Vec3};
use std::cmp::Ordering;

/// A draw, and what it is sorted by.
struct Placed {
    draw: Draw,
    depth_m: f32,
    middle_in_world: Vec3,
}

/// Draws from far to near.
pub fn far_to_near(draws: &[Draw], frame: &Frame) -> Vec<Draw> {
    let mut placed: Vec<_> = draws.iter().map(|&draw| place(draw, frame)).collect();
    placed.sort_by(|a, b| order(a, b, frame));
    placed.into_iter().map(|placed| placed.draw).collect()
}

fn place(draw: Draw, frame: &Frame) -> Placed {
    let camera = &frame.shot.camera;
    let instance = &frame.shot.plan.instances[draw.instance];
    let carrier = match instance.skin {
        // The mean of its joints, as its vertices weigh them.
        Some(skin) => mean_joint(frame, instance, skin),
        None => instance.world_from_object,
    };
    let patches = frame.scene.patches(instance);
    let middle_in_world = carrier.transform_point3(patches.middle);
    let primitive = &frame.scene.asset().meshes[instance.mesh].primitives[instance.primitive];
    let depth_m = match draw.faces {
        Faces::One(side) if primitive.topology == Topology::Triangles => patches.depth_m(side, carrier, camera),
        _ => (camera.eye_in_world() - middle_in_world).dot(camera.backwards_in_world()),
    };
    Placed { draw, depth_m, middle_in_world }
}

/// Farther first. Of equals, what differs whatever the order of the file: the place, the side, the material.
fn order(a: &Placed, b: &Placed, frame: &Frame) -> Ordering {
    let material = |placed: &Placed| {
        let instance = &frame.shot.plan.instances[placed.draw.instance];
        let material = &frame.scene.materials()[instance.material];
        // Without the name, which a file may leave to be its number.
        format!("{:?}", (&material.standard, &material.cloth, &material.fur))
    };
    let [here, there] = [a, b].map(|placed| placed.middle_in_world.to_array());
    let by_place = here.iter().zip(&there).map(|(a, b)| a.total_cmp(b)).find(|order| order.is_ne());
    (b.depth_m.total_cmp(&a.depth_m))
        .then(by_place.unwrap_or(Ordering::Equal))
        .then(a.draw.faces.cmp(&b.draw.faces))
        .then(inner_first(&a.draw).cmp(&inner_first(&b.draw)))
        .then_with(|| material(a).cmp(&material(b)))
}

/// A coat lies over its own skin, and behind it where both face away.
fn inner_first(draw: &Draw) -> bool {
    let is_coat = matches!(draw.kind, DrawKind::Fur { .. });
    is_coat != (draw.faces == Faces::One(Side::Back))
}

fn mean_joint(frame: &Frame, instance: &Instance, skin: usize) -> Mat4 {
    let joints = joint_matrices(frame.scene.asset(), skin, &frame.shot.pose);
    let primitive = &frame.scene.asset().meshes[instance.mesh].primitives[instance.primitive];
    let influences = &primitive.vertices.joints;
    let total: f32 = influences.iter().map(|(_, weight)| weight).sum();
    let sum = influences.iter().fold(Mat4::ZERO, |sum, &(joint, weight)| sum + joints[usize::from(joint)] * weight);
    if total > 0.0 { sum * total.recip() } else { Mat4::IDENTITY }
}
