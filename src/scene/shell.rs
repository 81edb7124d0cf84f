//! Directions in which fur shells grow: smooth across hard edges, so that pushed-out faces stay joined.
//!
//! A hard-edged mesh has several vertices at one place, one per face, each with its own normal; pushed along those the
//! surface opens at every edge. Here all corners that meet at a place share the angle-weighted mean of their face
//! normals (Thürmer & Wüthrich 1998, "Computing Vertex Normals from Polygonal Facets"), which does not depend on how
//! the faces are cut into triangles.
//!
//! A thin sheet has a front and a back at the same places, whose normals would cancel. So the faces at a place are
//! first gathered into clusters: two belong together when they use the same vertex or when their normals differ by less
//! than 120 degrees, and whatever hangs together that way is one cluster with one direction. A cube's corner (90
//! degrees) is one cluster; the inside of a sheet (180 degrees) is two, each with its own side's direction; a sheet
//! with side walls is joined around its rim and closes there. Only edges sharper than 60 degrees with split vertices
//! can open.

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use crate::asset::{Mesh, Primitive, Topology};
use crate::math::Aabb;

/// Vertices closer than this share of the mesh's bounding radius are at one place.
const WELD_TOLERANCE: f64 = 1e-6;
/// Faces at one place whose normals' cosine is above this belong together: 120 degrees.
const CLUSTER_COSINE: f64 = -0.5;
/// Faces whose normals' cosine is above this (5 degrees) count as one when clusters are sought, which bounds the work
/// at a place where very many faces meet.
const SAME_FACE_COSINE: f64 = 0.996;
/// Twice the area over the squared longest edge below which a triangle has no normal worth using.
const DEGENERATE_SHARE: f64 = 1e-10;

/// Shell direction of every vertex of a primitive on its own; see [`shell_directions_of_mesh`].
pub fn shell_directions(primitive: &Primitive) -> Vec<Vec3> {
    directions(&[primitive]).pop().unwrap_or_default()
}

/// Shell direction of every vertex of every primitive: unit length, object space, rest pose; primitives agree where
/// they meet. Deform them as normals.
///
/// A vertex without a usable face keeps its own normal, as does one whose faces cancel; points and lines keep theirs
/// too (zero where they have none).
pub fn shell_directions_of_mesh(mesh: &Mesh) -> Vec<Vec<Vec3>> {
    directions(&mesh.primitives.iter().collect::<Vec<_>>())
}

/// A triangle's corner.
struct Corner {
    place: u32,
    /// Numbered through all primitives.
    vertex: u32,
    /// Unit length.
    face_normal: DVec3,
    angle: f64,
}

fn directions(primitives: &[&Primitive]) -> Vec<Vec<Vec3>> {
    let mut directions: Vec<Vec3> = primitives.iter().flat_map(|primitive| own_normals(primitive)).collect();
    let mut corners = corners(primitives);
    corners.sort_by_key(|corner| corner.place);
    for at_one_place in corners.chunk_by(|a, b| a.place == b.place) {
        for (vertex, direction) in cluster_directions(at_one_place) {
            directions[vertex as usize] = direction;
        }
    }
    let mut rest = directions.as_slice();
    primitives
        .iter()
        .map(|primitive| {
            let (own, others) = rest.split_at(primitive.vertices.positions.len());
            rest = others;
            own.to_vec()
        })
        .collect()
}

fn own_normals(primitive: &Primitive) -> impl Iterator<Item = Vec3> {
    let normals = &primitive.vertices.normals;
    (0..primitive.vertices.positions.len()).map(|vertex| normals.get(vertex).copied().unwrap_or(Vec3::ZERO))
}

/// All corners of all triangles that have an area.
fn corners(primitives: &[&Primitive]) -> Vec<Corner> {
    let places = places(primitives);
    let mut corners = Vec::new();
    let mut first_vertex = 0;
    for primitive in primitives {
        let vertices = &primitive.vertices;
        let triangles = if primitive.topology == Topology::Triangles { primitive.indices.as_slice() } else { &[] };
        for triangle in triangles.chunks_exact(3) {
            let position = [0, 1, 2].map(|i| vertices.positions[triangle[i] as usize].as_dvec3());
            let edges = [0, 1, 2].map(|i| position[(i + 1) % 3] - position[i]);
            let area_normal = edges[0].cross(-edges[2]);
            let longest_squared = edges.iter().map(|edge| edge.length_squared()).fold(0.0, f64::max);
            if area_normal.length() <= DEGENERATE_SHARE * longest_squared {
                continue;
            }
            // Fur grows to the side that is lit, also where a file winds its triangles the other way.
            let shading: DVec3 =
                triangle.iter().filter_map(|&i| vertices.normals.get(i as usize)).map(|normal| normal.as_dvec3()).sum();
            let side = if shading.dot(area_normal) < 0.0 { -1.0 } else { 1.0 };
            for i in 0..3 {
                let vertex = first_vertex + triangle[i];
                corners.push(Corner {
                    place: places[vertex as usize],
                    vertex,
                    face_normal: area_normal.normalize() * side,
                    angle: edges[i].angle_between(-edges[(i + 2) % 3]),
                });
            }
        }
        first_vertex += vertices.positions.len() as u32;
    }
    corners
}

/// Number of the place of every vertex: a vertex joins the first place within the tolerance, sought in the grid cells
/// that its ball of tolerance touches. Cells are wider than the ball, so that it mostly touches one.
fn places(primitives: &[&Primitive]) -> Vec<u32> {
    const CELL_TOLERANCES: f64 = 8.0;
    let positions = || primitives.iter().flat_map(|primitive| primitive.vertices.positions.iter().copied());
    let bounds = Aabb::around(positions());
    let tolerance = (f64::from(bounds.sphere().radius) * WELD_TOLERANCE).max(f64::from(f32::MIN_POSITIVE));
    let cell_of = |point: DVec3| (point / (tolerance * CELL_TOLERANCES)).floor().as_i64vec3().to_array();
    let mut in_cell: HashMap<[i64; 3], Vec<(DVec3, u32)>> = HashMap::new();
    let mut count = 0;
    positions()
        .map(|position| {
            let point = position.as_dvec3() - bounds.min.as_dvec3();
            let (low, high) = (cell_of(point - tolerance), cell_of(point + tolerance));
            for x in low[0]..=high[0] {
                for y in low[1]..=high[1] {
                    for z in low[2]..=high[2] {
                        let near = in_cell.get(&[x, y, z]).into_iter().flatten();
                        if let Some(&(_, place)) = near.clone().find(|&&(other, _)| other.distance(point) <= tolerance)
                        {
                            return place;
                        }
                    }
                }
            }
            in_cell.entry(cell_of(point)).or_default().push((point, count));
            count += 1;
            count - 1
        })
        .collect()
}

/// Direction of every vertex of one place; vertices whose cluster cancels are left out.
fn cluster_directions(corners: &[Corner]) -> Vec<(u32, Vec3)> {
    // Faces that look alike share a representative, representatives are joined into clusters.
    let mut representatives: Vec<DVec3> = Vec::new();
    let mut clusters = Clusters::default();
    let mut representative_of_vertex: HashMap<u32, usize> = HashMap::new();
    let mut of_corner = Vec::with_capacity(corners.len());
    for corner in corners {
        let alike = representatives.iter().position(|&other| other.dot(corner.face_normal) > SAME_FACE_COSINE);
        let representative = alike.unwrap_or_else(|| {
            let new = clusters.add();
            for (other, &normal) in representatives.iter().enumerate() {
                if normal.dot(corner.face_normal) > CLUSTER_COSINE {
                    clusters.join(new, other);
                }
            }
            representatives.push(corner.face_normal);
            new
        });
        clusters.join(representative, *representative_of_vertex.entry(corner.vertex).or_insert(representative));
        of_corner.push(representative);
    }
    let mut sums = vec![(DVec3::ZERO, 0.0); representatives.len()];
    for (corner, &representative) in corners.iter().zip(&of_corner) {
        let (sum, angles) = &mut sums[clusters.root(representative)];
        *sum += corner.face_normal * corner.angle;
        *angles += corner.angle;
    }
    representative_of_vertex
        .into_iter()
        .filter_map(|(vertex, representative)| {
            let (sum, angles) = sums[clusters.root(representative)];
            // What is left of cancelling faces is rounding, not a direction.
            (sum.length() > 1e-6 * angles).then(|| (vertex, sum.normalize().as_vec3()))
        })
        .collect()
}

/// Disjoint sets with path halving (Tarjan & van Leeuwen 1984).
#[derive(Default)]
struct Clusters {
    parent: Vec<usize>,
}

impl Clusters {
    fn add(&mut self) -> usize {
        self.parent.push(self.parent.len());
        self.parent.len() - 1
    }

    fn root(&mut self, mut member: usize) -> usize {
        while self.parent[member] != member {
            self.parent[member] = self.parent[self.parent[member]];
            member = self.parent[member];
        }
        member
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a] = b;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::{Vertices, procedural};

    fn triangles(positions: Vec<Vec3>, normals: Vec<Vec3>, indices: Vec<u32>) -> Primitive {
        Primitive { indices, vertices: Vertices { positions, normals, ..Vertices::default() }, ..Primitive::default() }
    }

    #[test]
    fn a_cubes_corner_grows_along_its_diagonal() {
        for scale in [1e-4, 1.0, 1e4] {
            let mut cube = procedural::cube(0.5);
            for position in &mut cube.vertices.positions {
                *position = *position * scale + Vec3::splat(scale);
            }
            for (direction, position) in shell_directions(&cube).iter().zip(&cube.vertices.positions) {
                let expected = (*position - Vec3::splat(scale)).normalize();
                assert!((direction - expected).length() < 1e-6, "{direction} at {position}");
            }
        }
    }

    #[test]
    fn each_side_of_a_thin_sheet_keeps_its_own_direction() {
        let square = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
        let positions: Vec<Vec3> = square.iter().chain(&square).copied().collect();
        let normals: Vec<Vec3> = (0..8).map(|i| if i < 4 { Vec3::Z } else { Vec3::NEG_Z }).collect();
        let sheet = triangles(positions, normals.clone(), vec![0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6]);
        assert_eq!(shell_directions(&sheet), normals);
    }

    #[test]
    fn a_slab_with_side_walls_has_one_direction_per_place() {
        let mut slab = procedural::cube(0.5);
        for position in &mut slab.vertices.positions {
            position.y *= 1e-3;
        }
        let directions = shell_directions(&slab);
        for (i, a) in slab.vertices.positions.iter().enumerate() {
            for (j, b) in slab.vertices.positions.iter().enumerate() {
                assert!(a != b || directions[i] == directions[j]);
            }
        }
    }

    #[test]
    fn winding_against_the_normals_does_not_turn_fur_inwards() {
        let mut cube = procedural::cube(0.5);
        let outward = shell_directions(&cube);
        cube.indices.chunks_exact_mut(3).for_each(|triangle| triangle.swap(0, 1));
        for (a, b) in shell_directions(&cube).iter().zip(&outward) {
            assert!((a - b).length() < 1e-6);
        }
    }

    #[test]
    fn primitives_of_a_mesh_agree_where_they_meet() {
        let cube = procedural::cube(0.5);
        let face = |range: std::ops::Range<usize>| Primitive {
            indices: cube.indices[range].to_vec(),
            vertices: cube.vertices.clone(),
            ..Primitive::default()
        };
        let mesh = Mesh { primitives: vec![face(0..18), face(18..36)], ..Mesh::default() };
        let together = shell_directions_of_mesh(&mesh);
        let whole = shell_directions(&cube);
        for (primitive, directions) in mesh.primitives.iter().zip(&together) {
            for &index in &primitive.indices {
                let (direction, expected) = (directions[index as usize], whole[index as usize]);
                assert!((direction - expected).length() < 1e-6);
            }
        }
    }

    #[test]
    fn degenerate_faces_and_lonely_vertices_keep_their_normals() {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::X * 2.0, Vec3::Y];
        let primitive = triangles(positions, vec![Vec3::Y; 4], vec![0, 1, 2, 0, 0, 1]);
        assert_eq!(shell_directions(&primitive), vec![Vec3::Y; 4]);
        let point = Primitive { topology: Topology::Points, ..triangles(vec![Vec3::ONE], vec![], vec![0]) };
        assert_eq!(shell_directions(&point), vec![Vec3::ZERO]);
        assert!(shell_directions(&Primitive::default()).is_empty());
    }

    #[test]
    fn a_pole_of_very_many_faces_takes_no_time() {
        let rim = 60_000;
        let angle = |i: usize| (i as f32 / rim as f32) * std::f32::consts::TAU;
        let positions: Vec<Vec3> = (0..rim)
            .flat_map(|i| {
                [
                    Vec3::Y,
                    Vec3::new(angle(i + 1).sin(), 0.0, angle(i + 1).cos()),
                    Vec3::new(angle(i).sin(), 0.0, angle(i).cos()),
                ]
            })
            .collect();
        let cone = triangles(positions, vec![], (0..3 * rim as u32).collect());
        let directions = shell_directions(&cone);
        assert!(directions.iter().step_by(3).all(|apex| apex.y.abs() > 0.999), "{}", directions[0]);
    }
}
