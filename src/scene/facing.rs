//! How deep a side of a surface lies: what blended surfaces are sorted by.

use crate::asset::Primitive;
use crate::math::Aabb;
use glam::{Mat4, Vec3};
use std::collections::BTreeMap;

use super::Camera;

/// Groups of normals along an axis of each face of a cube.
const GROUPS: f32 = 4.0;

/// A side of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Side {
    /// Away from the normals.
    Back,
    /// Where the normals point.
    Front,
}

/// Depth-sorting clusters: the triangles of a primitive, those of like normals taken together: as many as there are directions to face, however
/// many triangles there are. In object space and rest pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Clusters {
    clusters: Vec<Cluster>,
    /// Middle of the box around all positions, whether triangles join them or not.
    pub middle: Vec3,
}

/// Triangles of like normals.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Cluster {
    /// Sum of the normals, as long as the areas.
    normal: Vec3,
    /// Mean place, weighted by area.
    middle: Vec3,
    area: f32,
}

impl Clusters {
    /// Those of a list of triangles.
    pub fn of(primitive: &Primitive) -> Self {
        let positions = &primitive.vertices.positions;
        let mut groups: BTreeMap<[i32; 4], Cluster> = BTreeMap::new();
        for triangle in primitive.indices.chunks_exact(3) {
            let [a, b, c] = [triangle[0], triangle[1], triangle[2]].map(|index| positions[index as usize]);
            let normal = 0.5 * (b - a).cross(c - a);
            let area = normal.length();
            if area > 0.0 && area.is_finite() {
                let empty = Cluster { normal: Vec3::ZERO, middle: Vec3::ZERO, area: 0.0 };
                let cluster = groups.entry(group(normal)).or_insert(empty);
                cluster.normal += normal;
                cluster.middle += area * (a + b + c) / 3.0;
                cluster.area += area;
            }
        }
        let mean = |cluster: Cluster| Cluster { middle: cluster.middle / cluster.area, ..cluster };
        let middle = Aabb::around(positions.iter().copied()).center();
        Self { clusters: groups.into_values().map(mean).collect(), middle }
    }

    /// Mean depth before the camera of what shows that side, weighted by how much of the picture it takes; of everything
    /// where nothing shows it. 0 for no triangles.
    pub fn depth_m(&self, side: Side, world_from_object: Mat4, camera: &Camera) -> f32 {
        let backwards = camera.backwards_in_world();
        let (mut shown, mut all) = (Mean::default(), Mean::default());
        // Which side is seen, and how much of it, is asked in object space: what is flattened there shows neither.
        let is_flat = world_from_object.determinant() == 0.0;
        let object_from_world = world_from_object.inverse();
        let eye = object_from_world.transform_point3(camera.eye_in_world());
        let towards = object_from_world.transform_vector3(backwards);
        for cluster in &self.clusters {
            let depth = -(world_from_object.transform_point3(cluster.middle) - camera.eye_in_world()).dot(backwards);
            all.add(depth, cluster.area);
            let to_eye = if camera.is_orthographic { towards } else { eye - cluster.middle };
            // The volume under the eye over the cube of the depth is the area in the picture.
            let scale = if camera.is_orthographic { 1.0 } else { depth.max(0.0).powi(3) };
            let facing = cluster.normal.dot(to_eye);
            let seen = if side == Side::Front { facing } else { -facing };
            if seen > 0.0 && scale > 0.0 && !is_flat {
                shown.add(depth, seen / scale);
            }
        }
        shown.value().or(all.value()).unwrap_or(0.0)
    }
}

/// The face of a cube that a direction points through, and the cell of it.
fn group(direction: Vec3) -> [i32; 4] {
    let axis = direction.abs().max_position();
    let largest = direction[axis];
    let cell = |value: f32| ((value / largest.abs() + 1.0) * 0.5 * GROUPS).min(GROUPS - 1.0) as i32;
    [axis as i32, largest.signum() as i32, cell(direction[(axis + 1) % 3]), cell(direction[(axis + 2) % 3])]
}

/// A weighted mean, none of nothing.
#[derive(Default)]
struct Mean {
    sum: f32,
    weight: f32,
}

impl Mean {
    fn add(&mut self, value: f32, weight: f32) {
        self.sum += value * weight;
        self.weight += weight;
    }

    fn value(&self) -> Option<f32> {
        Some(self.sum / self.weight).filter(|mean| mean.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::procedural::sphere;
    use crate::asset::{Asset, AssetScene};
    use crate::scene::{CameraChoice, camera, pose};
    use glam::Quat;

    /// From five metres, along -Z.
    fn from_the_front() -> Camera {
        let asset = Asset { scenes: vec![AssetScene::default()], ..Asset::default() };
        let (radius_m, target) = (Some(5.0), Some(Vec3::ZERO));
        let orbit = CameraChoice::Orbit { theta_deg: 0.0, phi_deg: 90.0, radius_m, target, fov_deg: 40.0 };
        camera(&asset, 0, &pose(&asset, None, 0.0), &orbit, 1.0, &Default::default()).unwrap()
    }

    #[test]
    fn the_sides_of_a_ball_lie_before_and_behind_its_middle() {
        let clusters = Clusters::of(&sphere(1.0, 24));
        assert!(clusters.clusters.len() <= 6 * 4 * 4, "{}", clusters.clusters.len());
        let camera = from_the_front();
        let turned = Mat4::from_rotation_translation(Quat::from_rotation_x(1.0), Vec3::Z);
        for (matrix, middle_m) in
            [(Mat4::IDENTITY, 5.0), (turned, 4.0), (Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0)), 5.0)]
        {
            let depth = |side| clusters.depth_m(side, matrix, &camera);
            // Two thirds of a radius from far away; nearer, as less of the ball and more of what is near is seen.
            let (front, back) = (depth(Side::Front) - middle_m, depth(Side::Back) - middle_m);
            assert!((-0.8..-0.6).contains(&front) && (0.4..0.7).contains(&back), "{front} {back}");
        }
    }

    #[test]
    fn what_shows_nothing_lies_where_it_is() {
        let clusters = Clusters::of(&sphere(1.0, 8));
        let flat = Mat4::from_scale(Vec3::new(1.0, 1.0, 0.0));
        assert!((clusters.depth_m(Side::Front, flat, &from_the_front()) - 5.0).abs() < 1e-5);
        let none = Clusters { clusters: Vec::new(), middle: Vec3::ZERO };
        assert_eq!(none.depth_m(Side::Back, Mat4::IDENTITY, &from_the_front()), 0.0);
    }
}
