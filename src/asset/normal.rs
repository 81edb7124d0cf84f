//! Normals: made unit, made flat where the file has none.

use super::morph::DELTA_BYTES;
use super::{MorphTarget, Primitive, Vertices};
use glam::{DVec3, Vec3};

/// Unit vector along `v`; `None` for zero. In 64 bits, since squares of small or large 32-bit
/// lengths under- and overflow.
pub(super) fn unit(v: DVec3) -> Option<Vec3> {
    let length = v.length();
    (length > 0.0).then(|| (v / length).as_vec3())
}

/// Twice the area times the normal of triangle `[a, b, c]`, counter-clockwise front.
fn area_normal(positions: &[Vec3], [a, b, c]: [u32; 3]) -> DVec3 {
    let [a, b, c] = [a, b, c].map(|i| positions[i as usize].as_dvec3());
    (b - a).cross(c - a)
}

/// Index triples of a triangle list.
fn triangles(indices: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]])
}

/// Makes normals unit length; zero ones become the mean of their triangles (up without any).
/// Returns how many were zero.
pub(super) fn normalize(normals: &mut [Vec3], positions: &[Vec3], indices: &[u32]) -> usize {
    let mut zero = Vec::new();
    for (i, normal) in normals.iter_mut().enumerate() {
        match unit(normal.as_dvec3()) {
            Some(unit) => *normal = unit,
            None => zero.push(i),
        }
    }
    if !zero.is_empty() {
        let mut sums = vec![DVec3::ZERO; positions.len()];
        for triangle in triangles(indices) {
            let normal = area_normal(positions, triangle);
            triangle.iter().for_each(|&i| sums[i as usize] += normal);
        }
        for &i in &zero {
            normals[i] = unit(sums[i]).unwrap_or(Vec3::Y);
        }
    }
    zero.len()
}

/// Gives a triangle list flat normals: every corner gets its own vertex (glTF 2.0, section
/// 3.7.2.1). Tangents are dropped, as that section asks. Returns how many triangles have no area;
/// theirs point up.
pub(super) fn flatten(primitive: &mut Primitive) -> usize {
    primitive.vertices.tangents.clear();
    for target in &mut primitive.morph_targets {
        target.normals.clear();
        target.tangents.clear();
    }
    let indices = std::mem::take(&mut primitive.indices);
    reorder(primitive, &indices);
    primitive.indices = (0..indices.len() as u32).collect();
    let positions = &primitive.vertices.positions;
    let mut without_area = 0;
    let normal = |triangle| match unit(area_normal(positions, triangle)) {
        Some(normal) => [normal; 3],
        None => {
            without_area += 1;
            [Vec3::Y; 3]
        }
    };
    primitive.vertices.normals = triangles(&primitive.indices).flat_map(normal).collect();
    without_area
}

/// New vertex i = old vertex `order[i]`, in every list.
pub(super) fn reorder(primitive: &mut Primitive, order: &[u32]) {
    fn pick<T: Copy>(list: &mut Vec<T>, order: &[u32], per_vertex: usize) {
        if !list.is_empty() {
            let from = |&i: &u32| list[i as usize * per_vertex..][..per_vertex].iter().copied();
            *list = order.iter().flat_map(from).collect();
        }
    }
    let Vertices { positions, normals, tangents, uv_sets, colors, joints, influences_per_vertex } =
        &mut primitive.vertices;
    pick(positions, order, 1);
    pick(normals, order, 1);
    pick(tangents, order, 1);
    uv_sets.iter_mut().for_each(|set| pick(set, order, 1));
    pick(colors, order, 1);
    pick(joints, order, *influences_per_vertex);
    for MorphTarget { positions, normals, tangents } in &mut primitive.morph_targets {
        pick(positions, order, 1);
        pick(normals, order, 1);
        pick(tangents, order, 1);
    }
}

/// Bytes of one vertex, morph targets included: what unsharing multiplies.
pub(super) fn vertex_bytes(primitive: &Primitive) -> u64 {
    let Vertices { positions, normals, tangents, uv_sets, colors, joints, .. } = &primitive.vertices;
    let mut bytes = size_of_val(&positions[..]) + size_of_val(&normals[..]) + size_of_val(&tangents[..]);
    bytes += uv_sets.iter().map(|set| size_of_val(&set[..])).sum::<usize>();
    bytes += size_of_val(&colors[..]) + size_of_val(&joints[..]);
    for target in &primitive.morph_targets {
        bytes += size_of_val(&target.positions[..]) + size_of_val(&target.normals[..]);
        bytes += size_of_val(&target.tangents[..]);
    }
    bytes.div_ceil(positions.len().max(1)) as u64 + DELTA_BYTES * primitive.morph_targets.len() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_normals_take_the_mean_of_their_triangles() {
        let positions = [Vec3::ZERO, Vec3::X * 1e-20, Vec3::Y * 1e-20, Vec3::ONE];
        let mut normals = [Vec3::ZERO, Vec3::X * 1e-30, Vec3::splat(1e30), Vec3::ZERO];
        assert_eq!(normalize(&mut normals, &positions, &[0, 1, 2]), 2);
        assert_eq!(normals[..2], [Vec3::Z, Vec3::X]);
        assert!((normals[2].length() - 1.0).abs() < 1e-6);
        assert_eq!(normals[3], Vec3::Y);
    }
}
