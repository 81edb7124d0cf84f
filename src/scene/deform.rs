//! Morphing and skinning on the CPU: the twin of the compute pass, and the source of posed bounds.
//!
//! Morph first, then skin (glTF 2.0, 3.7.2.2 and 3.7.3.3). Linear blend skinning: `sum(weight * joint)` as one matrix;
//! normals by its inverse transpose, tangents by the matrix itself, both normalised again; where it mirrors, the
//! bitangent changes sides.

use glam::{Mat4, Vec3};

use crate::asset::{Primitive, Vertices};
use crate::math::normal_matrix;

/// The primitive's vertices in a pose.
///
/// `joints` are [`joint_matrices`](super::joint_matrices) (empty = not skinned), `weights` one per morph target
/// (missing ones count as 0). Attributes that do not deform are copied. With joints the result is in world space,
/// without in object space. A normal or tangent that vanishes keeps its rest value.
pub fn deform(primitive: &Primitive, joints: &[Mat4], weights: &[f32]) -> Vertices {
    let mut vertices = primitive.vertices.clone();
    let mut tangents: Vec<Vec3> = vertices.tangents.iter().map(|tangent| tangent.truncate()).collect();
    for (target, &weight) in primitive.morph_targets.iter().zip(weights).filter(|&(_, &weight)| weight != 0.0) {
        add(&mut vertices.positions, &target.positions, weight);
        add(&mut vertices.normals, &target.normals, weight);
        add(&mut tangents, &target.tangents, weight);
    }
    for (vertex, position) in vertices.positions.iter_mut().enumerate() {
        let skin = blended_joint(&primitive.vertices, vertex, joints);
        *position = skin.transform_point3(*position);
        if let Some(normal) = vertices.normals.get_mut(vertex) {
            *normal = (normal_matrix(skin) * *normal).normalize_or(primitive.vertices.normals[vertex]);
        }
        if let Some(tangent) = vertices.tangents.get_mut(vertex) {
            let rest = tangent.truncate();
            let handedness = if skin.determinant() < 0.0 { -tangent.w } else { tangent.w };
            *tangent = skin.transform_vector3(tangents[vertex]).normalize_or(rest).extend(handedness);
        }
    }
    vertices
}

/// Positions alone, for bounds: as [`deform`].
pub(super) fn deformed_positions(primitive: &Primitive, joints: &[Mat4], weights: &[f32]) -> Vec<Vec3> {
    let mut positions = morphed_positions(primitive, weights);
    if !joints.is_empty() {
        for (vertex, position) in positions.iter_mut().enumerate() {
            *position = blended_joint(&primitive.vertices, vertex, joints).transform_point3(*position);
        }
    }
    positions
}

/// Positions after morphing, before skinning.
pub(super) fn morphed_positions(primitive: &Primitive, weights: &[f32]) -> Vec<Vec3> {
    let mut positions = primitive.vertices.positions.clone();
    for (target, &weight) in primitive.morph_targets.iter().zip(weights).filter(|&(_, &weight)| weight != 0.0) {
        add(&mut positions, &target.positions, weight);
    }
    positions
}

/// (joint, weight) pairs of a vertex; none without a skin.
pub(super) fn influences(vertices: &Vertices, vertex: usize) -> &[(u16, f32)] {
    let count = vertices.influences_per_vertex;
    vertices.joints.get(vertex * count..(vertex + 1) * count).unwrap_or_default()
}

fn add(values: &mut [Vec3], offsets: &[Vec3], weight: f32) {
    for (value, &offset) in values.iter_mut().zip(offsets) {
        *value += weight * offset;
    }
}

/// Identity where nothing influences the vertex.
fn blended_joint(vertices: &Vertices, vertex: usize, joints: &[Mat4]) -> Mat4 {
    let influences = influences(vertices, vertex);
    if influences.is_empty() || joints.is_empty() {
        return Mat4::IDENTITY;
    }
    influences
        .iter()
        .filter(|&&(_, weight)| weight != 0.0)
        .fold(Mat4::ZERO, |sum, &(joint, weight)| sum + joints[usize::from(joint)] * weight)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::MorphTarget;
    use glam::Vec4;

    fn vertex(influences: &[(u16, f32)]) -> Primitive {
        let vertices = Vertices {
            positions: vec![Vec3::new(1.0, 2.0, 3.0)],
            normals: vec![Vec3::new(1.0, 1.0, 0.0).normalize()],
            tangents: vec![Vec4::new(0.0, 0.0, 1.0, -1.0)],
            joints: influences.to_vec(),
            influences_per_vertex: influences.len(),
            ..Vertices::default()
        };
        let target = MorphTarget {
            positions: vec![Vec3::X],
            normals: vec![Vec3::Y * -2f32.sqrt()],
            tangents: vec![Vec3::new(1.0, 0.0, -1.0)],
        };
        Primitive { indices: vec![0], vertices, morph_targets: vec![target], ..Primitive::default() }
    }

    #[test]
    fn nothing_in_nothing_out() {
        let primitive = vertex(&[]);
        let deformed = deform(&primitive, &[], &[]);
        assert_eq!(deformed.positions, primitive.vertices.positions);
        assert!((deformed.normals[0] - primitive.vertices.normals[0]).length() < 1e-6);
        assert_eq!(deformed.tangents, primitive.vertices.tangents);
    }

    #[test]
    fn morphs_add_and_normalise() {
        let deformed = deform(&vertex(&[]), &[], &[1.0]);
        assert_eq!(deformed.positions[0], Vec3::new(2.0, 2.0, 3.0));
        assert!((deformed.normals[0] - Vec3::new(1.0, -1.0, 0.0).normalize()).length() < 1e-6);
        assert_eq!(deformed.tangents[0], Vec4::new(1.0, 0.0, 0.0, -1.0));
    }

    #[test]
    fn morph_comes_before_skin_and_joints_blend() {
        let joints = [Mat4::from_scale(Vec3::new(2.0, 1.0, 1.0)), Mat4::from_translation(Vec3::new(0.0, 10.0, 0.0))];
        let primitive = vertex(&[(0, 0.25), (1, 0.75)]);
        let deformed = deform(&primitive, &joints, &[1.0]);
        // Position (2, 2, 3) after the morph: a quarter of (4, 2, 3) and three quarters of (2, 12, 3).
        assert!((deformed.positions[0] - Vec3::new(2.5, 9.5, 3.0)).length() < 1e-6);
        assert_eq!(deformed_positions(&primitive, &joints, &[1.0]), deformed.positions);
        // The blended 3x3 is diag(1.25, 1, 1); a normal is divided by it.
        let expected = Vec3::new(1.0 / 1.25, -1.0, 0.0).normalize();
        assert!((deformed.normals[0] - expected).length() < 1e-6);
        assert_eq!(deformed.tangents[0].w, -1.0);
    }

    #[test]
    fn mirrored_joints_keep_normals_outward_and_flat_ones_stay_finite() {
        let primitive = vertex(&[(0, 1.0)]);
        let mirrored = deform(&primitive, &[Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0))], &[]);
        assert!((mirrored.normals[0] - Vec3::new(-1.0, 1.0, 0.0).normalize()).length() < 1e-6);
        let collapsed = deform(&primitive, &[Mat4::from_scale(Vec3::ZERO)], &[]);
        assert_eq!(collapsed.normals, primitive.vertices.normals);
        assert_eq!(collapsed.tangents, primitive.vertices.tangents);
    }
}
