//! The order of what blends: from far to near, each side of a surface by how deep it lies, whatever the order of the file.
//!
//! Objects are sorted whole; where they intersect no order of objects is right.

use crate::asset::Topology;
use crate::render::plan::{Draw, DrawKind, Faces, Staging};
use crate::scene::{Camera, Instance, Part, Scene, Side};
use glam::{Mat4, Vec3};
use std::cmp::Ordering;

/// A draw, and what it is sorted by.
#[derive(Debug, Clone, Copy)]
struct Placed {
    draw: Draw,
    depth_m: f32,
    middle_in_world: Vec3,
}

/// Draws from far to near, in memory that the next frame uses again.
#[derive(Debug, Default)]
pub struct FarToNear {
    placed: Vec<Placed>,
    draws: Vec<Draw>,
}

impl FarToNear {
    /// Sorts draws by how a camera sees them.
    pub fn sort(&mut self, draws: &[Draw], scene: &Scene, staging: &Staging, camera: &Camera) -> &[Draw] {
        self.placed.clear();
        self.placed.extend(draws.iter().map(|&draw| place(draw, scene, staging, camera)));
        self.placed.sort_unstable_by(|a, b| order(a, b, scene, staging));
        self.draws.clear();
        self.draws.extend(self.placed.iter().map(|placed| placed.draw));
        &self.draws
    }

    /// The draws as they were sorted last.
    pub fn draws(&self) -> &[Draw] {
        &self.draws
    }
}

fn place(draw: Draw, scene: &Scene, staging: &Staging, camera: &Camera) -> Placed {
    let Part { instance, mesh, primitive, .. } = staging.plan.parts[draw.part];
    let instance = &staging.instances[instance];
    let carrier = match instance.joints.is_empty() {
        // The mean of its joints, as its vertices weigh them.
        false => mean_joint(scene, instance, mesh, primitive),
        true => instance.world_from_object,
    };
    let clusters = scene.clusters(mesh, primitive);
    let middle_in_world = carrier.transform_point3(clusters.middle);
    let topology = scene.asset().meshes[mesh].primitives[primitive].topology;
    let depth_m = match draw.faces {
        Faces::One(side) if topology == Topology::Triangles => clusters.depth_m(side, carrier, camera),
        _ => (camera.eye_in_world() - middle_in_world).dot(camera.backwards_in_world()),
    };
    Placed { draw, depth_m, middle_in_world }
}

/// Farther first. Of equals, what differs whatever the order of the file: the place, the side, the material; at last the
/// order of the file.
fn order(a: &Placed, b: &Placed, scene: &Scene, staging: &Staging) -> Ordering {
    let material = |placed: &Placed| {
        let material = &scene.materials()[staging.plan.parts[placed.draw.part].material];
        // Without the name, which a file may leave to be its number.
        format!("{:?}", (&material.standard, &material.family, &material.fur))
    };
    let [here, there] = [a, b].map(|placed| placed.middle_in_world.to_array());
    let by_place = here.iter().zip(&there).map(|(a, b)| a.total_cmp(b)).find(|order| order.is_ne());
    (b.depth_m.total_cmp(&a.depth_m))
        .then(by_place.unwrap_or(Ordering::Equal))
        .then(a.draw.faces.cmp(&b.draw.faces))
        .then(inner_first(&a.draw).cmp(&inner_first(&b.draw)))
        .then_with(|| material(a).cmp(&material(b)))
        .then(a.draw.part.cmp(&b.draw.part))
}

/// Fur lies over its own skin, and behind it where both face away.
fn inner_first(draw: &Draw) -> bool {
    let is_fur = matches!(draw.kind, DrawKind::Fur { .. });
    is_fur != (draw.faces == Faces::One(Side::Back))
}

fn mean_joint(scene: &Scene, instance: &Instance, mesh: usize, primitive: usize) -> Mat4 {
    let influences = &scene.asset().meshes[mesh].primitives[primitive].vertices.joints;
    let joints = &instance.joints;
    let total: f32 = influences.iter().map(|(_, weight)| weight).sum();
    let sum = influences.iter().fold(Mat4::ZERO, |sum, &(joint, weight)| sum + joints[usize::from(joint)] * weight);
    if total > 0.0 { sum * total.recip() } else { Mat4::IDENTITY }
}
