//! Tangents: checked where the file has them, generated where a normal map needs them.

use super::normal::{reorder, unit, vertex_bytes};
use super::{Primitive, Topology};
use bevy_mikktspace::{Geometry, TangentSpace};
use glam::{Vec2, Vec3, Vec4};
use std::collections::HashMap;

/// Most triangles around one corner. MikkTSpace recurses from each triangle to the next around it and compares each
/// with each, so more would cost stack and time without end; a sphere of as many segments stays below.
pub const MAX_TRIANGLES_AROUND_CORNER: usize = 4096;

/// What MikkTSpace keeps of an index while it works: triangles, groups and tangent spaces.
const SCRATCH_BYTES_PER_INDEX: u64 = 128;

/// Why a primitive gets no tangents; it is shown without what needs them.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NoTangents {
    /// Tangents follow the directions of a picture on triangles.
    #[error("has no triangles, no normals or no TEXCOORD_{uv_set} for its normal map, so no tangents")]
    Missing {
        /// The UV set that was asked for.
        uv_set: usize,
    },
    /// Over [`MAX_TRIANGLES_AROUND_CORNER`].
    #[error(
        "has {triangles} triangles around one corner, over {MAX_TRIANGLES_AROUND_CORNER}, so no tangents; split them, or export tangents"
    )]
    Crowded {
        /// The most around any corner.
        triangles: usize,
    },
}

/// Some unit vector perpendicular to the unit `normal`.
fn perpendicular(normal: Vec3) -> Vec3 {
    normal.any_orthonormal_vector()
}

/// Makes tangents unit length with w = +-1; zero ones become any that is perpendicular to the
/// normal. Returns how many were zero.
pub(super) fn normalize(tangents: &mut [Vec4], normals: &[Vec3]) -> usize {
    let mut zero = 0;
    for (tangent, normal) in tangents.iter_mut().zip(normals) {
        let direction = unit(tangent.truncate().as_dvec3()).unwrap_or_else(|| {
            zero += 1;
            perpendicular(*normal)
        });
        *tangent = direction.extend(if tangent.w < 0.0 { -1.0 } else { 1.0 });
    }
    zero
}

/// What MikkTSpace sees. It is fed positions and UVs scaled to [-1, 1]: tangents do not depend on
/// a uniform scale, and its 32-bit products then neither overflow nor vanish.
struct Corners<'a> {
    primitive: &'a Primitive,
    uvs: &'a [Vec2],
    position_scale: f32,
    uv_scale: f32,
    /// One per index.
    tangents: Vec<Vec4>,
}

impl Corners<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.primitive.indices[face * 3 + corner] as usize
    }
}

impl Geometry for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.primitive.indices.len() / 3
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        (self.primitive.vertices.positions[self.vertex(face, corner)] * self.position_scale).to_array()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.primitive.vertices.normals[self.vertex(face, corner)].to_array()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        (self.uvs[self.vertex(face, corner)] * self.uv_scale).to_array()
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        let normal = self.primitive.vertices.normals[self.vertex(face, corner)];
        let fallback = || perpendicular(normal).extend(1.0);
        self.tangents[face * 3 + corner] = space.map_or_else(fallback, |space| {
            let [x, y, z, sign] = space.tangent_encoded();
            // glTF's V runs down the picture and MikkTSpace's up: the bitangent turns around.
            unit(Vec3::new(x, y, z).as_dvec3()).map_or_else(fallback, |tangent| tangent.extend(-sign))
        });
    }
}

/// The factor that brings the largest of `numbers` to 1.
fn scale_to_unit(numbers: impl Iterator<Item = f32>) -> f32 {
    let largest = numbers.fold(0.0f32, |largest, number| largest.max(number.abs()));
    let scale = largest.recip();
    if scale.is_finite() && scale > 0.0 { scale } else { 1.0 }
}

/// Replaces the tangents of a triangle list by those of `uv_set` (Mikkelsen 2008, "Simulation of
/// Wrinkled Surfaces Revisited"; MikkTSpace, as glTF 2.0 section 3.7.2.1 asks). A vertex is split
/// only where its triangles disagree, so the index list stays useful.
///
/// # Errors
/// [`NoTangents`]; the primitive is unchanged.
pub fn generate_tangents(primitive: &mut Primitive, uv_set: usize) -> Result<(), NoTangents> {
    let missing = NoTangents::Missing { uv_set };
    let vertices = &primitive.vertices;
    let count = vertices.positions.len();
    let Some(uvs) = vertices.uv_sets.get(uv_set).filter(|uvs| uvs.len() == count) else { return Err(missing) };
    let in_range = primitive.indices.iter().all(|&i| (i as usize) < count);
    if primitive.topology != Topology::Triangles || vertices.normals.len() != count || !in_range {
        return Err(missing);
    }
    let mut corners = Corners {
        primitive,
        uvs,
        position_scale: scale_to_unit(vertices.positions.iter().flat_map(|p| p.to_array())),
        uv_scale: scale_to_unit(uvs.iter().flat_map(|uv| uv.to_array())),
        tangents: vec![Vec4::new(1.0, 0.0, 0.0, 1.0); primitive.indices.len()],
    };
    let triangles = most_triangles_around_corner(&corners);
    if triangles > MAX_TRIANGLES_AROUND_CORNER {
        return Err(NoTangents::Crowded { triangles });
    }
    if bevy_mikktspace::generate_tangents(&mut corners).is_err() {
        return Err(missing);
    }
    let of_corner = corners.tangents;

    let mut order = Vec::new();
    let mut tangents = Vec::new();
    let mut indices = Vec::with_capacity(of_corner.len());
    let mut known = HashMap::new();
    for (&vertex, tangent) in primitive.indices.iter().zip(of_corner) {
        let index = *known.entry((vertex, tangent.to_array().map(f32::to_bits))).or_insert_with(|| {
            order.push(vertex);
            tangents.push(tangent);
            order.len() as u32 - 1
        });
        indices.push(index);
    }
    reorder(primitive, &order);
    primitive.indices = indices;
    primitive.vertices.tangents = tangents;
    Ok(())
}

/// Replaces the tangents by those around the vertical of the rest pose, for threads on meshes without texture coordinates.
/// Does nothing without normals.
pub fn generate_tangents_around_vertical(primitive: &mut Primitive) {
    let around = |normal: &Vec3| unit(Vec3::Y.cross(*normal).as_dvec3()).unwrap_or_else(|| perpendicular(*normal));
    primitive.vertices.tangents = primitive.vertices.normals.iter().map(|normal| around(normal).extend(1.0)).collect();
}

/// Bytes that [`generate_tangents`] adds to a primitive at most, and those that it works in besides.
pub fn tangent_bytes(primitive: &Primitive) -> (u64, u64) {
    let indices = primitive.indices.len() as u64;
    let kept = (vertex_bytes(primitive) + size_of::<Vec4>() as u64).saturating_mul(indices);
    (kept, SCRATCH_BYTES_PER_INDEX.saturating_mul(indices))
}

/// The most triangles that share a corner: its position, normal and UV, which MikkTSpace welds by. Triangles with two
/// corners in one place belong to no group.
fn most_triangles_around_corner(corners: &Corners) -> usize {
    // Zero has two signs.
    let bits = |numbers: [f32; 3]| numbers.map(|number| (number + 0.0).to_bits());
    /// Bits of a position, a normal and a texture coordinate.
    type Corner = ([u32; 3], [u32; 3], [u32; 2]);
    let mut around: HashMap<Corner, usize> = HashMap::new();
    for face in 0..corners.num_faces() {
        let places = [0, 1, 2].map(|corner| bits(corners.position(face, corner)));
        if places[0] == places[1] || places[1] == places[2] || places[2] == places[0] {
            continue;
        }
        for (corner, place) in places.into_iter().enumerate() {
            let uv = corners.tex_coord(face, corner).map(|number| (number + 0.0).to_bits());
            *around.entry((place, bits(corners.normal(face, corner)), uv)).or_default() += 1;
        }
    }
    around.into_values().max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::Vertices;
    use proptest::prelude::*;

    fn primitive(positions: Vec<Vec3>, normals: Vec<Vec3>, uvs: Vec<Vec2>, indices: Vec<u32>) -> Primitive {
        let vertices = Vertices { positions, normals, uv_sets: vec![uvs], ..Vertices::default() };
        Primitive { indices, vertices, ..Primitive::default() }
    }

    #[test]
    fn tangent_follows_u_and_bitangent_goes_against_v() {
        // The picture upright on the XY plane: u right, v down.
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
        let uvs = vec![Vec2::new(0.0, 1.0), Vec2::ONE, Vec2::new(1.0, 0.0), Vec2::ZERO];
        let mut quad = primitive(positions, vec![Vec3::Z; 4], uvs, vec![0, 1, 2, 0, 2, 3]);
        assert_eq!(generate_tangents(&mut quad, 0), Ok(()));
        assert_eq!(quad.vertices.tangents, vec![Vec4::new(1.0, 0.0, 0.0, 1.0); 4]);
        assert_eq!((quad.indices.as_slice(), quad.vertices.positions.len()), (&[0, 1, 2, 0, 2, 3][..], 4));
        assert_eq!(generate_tangents(&mut quad, 1), Err(NoTangents::Missing { uv_set: 1 }));
    }

    /// Recursion runs around a corner: the most that is let through must fit a thread's stack, and more must not try.
    #[test]
    fn a_crowded_corner_gets_no_tangents() {
        let disc = |rim: usize| {
            let angle = |k: usize| k as f32 / rim as f32 * std::f32::consts::TAU;
            let on_rim = |k: usize| Vec2::from_angle(angle(k));
            let flat: Vec<Vec2> = std::iter::once(Vec2::ZERO).chain((0..rim).map(on_rim)).collect();
            let indices = (0..rim).flat_map(|k| [0, 1 + k as u32, 1 + ((k + 1) % rim) as u32]).collect();
            let positions = flat.iter().map(|p| p.extend(0.0)).collect();
            primitive(
                positions,
                vec![Vec3::Z; rim + 1],
                flat.iter().map(|p| *p * Vec2::new(0.5, -0.5)).collect(),
                indices,
            )
        };
        let mut largest = disc(MAX_TRIANGLES_AROUND_CORNER);
        assert_eq!(generate_tangents(&mut largest, 0), Ok(()));
        assert!((largest.vertices.tangents[0] - Vec4::new(1.0, 0.0, 0.0, 1.0)).length() < 1e-3);
        let mut crowded = disc(300_000);
        assert_eq!(generate_tangents(&mut crowded, 0), Err(NoTangents::Crowded { triangles: 300_000 }));
        assert!(crowded.vertices.tangents.is_empty());
    }

    #[test]
    fn a_mirrored_seam_splits_its_vertices() {
        let positions = vec![Vec3::NEG_X, Vec3::ZERO, Vec3::Y, Vec3::X];
        let uvs = vec![Vec2::new(1.0, 1.0), Vec2::new(0.0, 1.0), Vec2::ZERO, Vec2::new(1.0, 1.0)];
        let mut pair = primitive(positions, vec![Vec3::Z; 4], uvs, vec![0, 1, 2, 1, 3, 2]);
        assert_eq!(generate_tangents(&mut pair, 0), Ok(()));
        assert_eq!(pair.vertices.positions.len(), 6);
        assert_eq!(pair.vertices.tangents[pair.indices[0] as usize], Vec4::new(-1.0, 0.0, 0.0, -1.0));
        assert_eq!(pair.vertices.tangents[pair.indices[3] as usize], Vec4::new(1.0, 0.0, 0.0, 1.0));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(256))]
        /// Degenerate, folded, huge and tiny triangles: always unit tangents, never a panic.
        #[test]
        fn any_triangles_get_unit_tangents(
            grid in prop::collection::vec((-2i8..3, -2i8..3, -2i8..3, 0i8..3, 0i8..3), 3..12),
            indices in prop::collection::vec(0usize..12, 3..60),
            exponent in -38i32..38,
        ) {
            let scale = 10f32.powi(exponent);
            let position = |&(x, y, z, ..): &(i8, i8, i8, i8, i8)| Vec3::new(x.into(), y.into(), z.into()) * scale;
            let positions: Vec<_> = grid.iter().map(position).collect();
            let uvs = grid.iter().map(|&(.., u, v)| Vec2::new(u.into(), v.into()) * scale).collect();
            let normals = grid.iter().map(|&(x, y, ..)| Vec3::new(x.into(), y.into(), 0.5).normalize()).collect();
            let count = indices.len() / 3 * 3;
            let indices: Vec<u32> = indices[..count].iter().map(|i| (i % grid.len()) as u32).collect();
            let mut made = primitive(positions, normals, uvs, indices);
            prop_assert_eq!(generate_tangents(&mut made, 0), Ok(()));
            for tangent in &made.vertices.tangents {
                prop_assert!((tangent.truncate().length() - 1.0).abs() < 1e-5, "{}", tangent);
                prop_assert!(tangent.w.abs() == 1.0);
            }
        }
    }
}
