//! Vertex streams, index lists and deform sources as bytes for the device.

use super::stream::Stream;
use crate::asset::{Mesh, Primitive, Vertices};
use crate::scene::shell_directions_of_mesh;
use glam::Vec3;
use std::borrow::Cow;

/// The bytes of a stream of one primitive of `mesh`, tightly packed, in vertex order.
pub fn stream_bytes(mesh: &Mesh, primitive: usize, stream: Stream) -> Vec<u8> {
    let vertices = &mesh.primitives[primitive].vertices;
    match stream {
        Stream::Position => bytemuck::cast_slice(&vertices.positions).to_vec(),
        Stream::Normal => bytemuck::cast_slice(&vertices.normals).to_vec(),
        Stream::Tangent => {
            vertices.tangents.iter().flat_map(|tangent| bytemuck::cast::<_, [u8; 16]>(tangent.to_array())).collect()
        }
        Stream::Uv0 => bytemuck::cast_slice(&vertices.uv_sets[0]).to_vec(),
        Stream::Uv1 => bytemuck::cast_slice(&vertices.uv_sets[1]).to_vec(),
        Stream::Color => {
            vertices.colors.iter().flat_map(|color| bytemuck::cast::<_, [u8; 16]>(color.to_array())).collect()
        }
        // Never in a file: the sway pass makes it.
        Stream::Sway => Vec::new(),
        Stream::ShellDirection => bytemuck::cast_slice(&shell_directions_of_mesh(mesh)[primitive]).to_vec(),
        Stream::ShellSide => {
            let directions = &shell_directions_of_mesh(mesh)[primitive];
            // Straight up and down there is no "around the vertical"; X is as good as any.
            let side = |direction: &Vec3| Vec3::Y.cross(*direction).normalize_or(Vec3::X);
            directions.iter().flat_map(|direction| bytemuck::cast::<_, [u8; 12]>(side(direction).to_array())).collect()
        }
    }
}

/// The indices of one copy of a primitive's vertices among several, as bytes.
pub fn index_bytes(primitive: &Primitive, copy: u32) -> Cow<'_, [u8]> {
    if copy == 0 {
        return Cow::Borrowed(bytemuck::cast_slice(&primitive.indices));
    }
    let first = copy * primitive.vertices.positions.len() as u32;
    Cow::Owned(primitive.indices.iter().flat_map(|index| (first + index).to_ne_bytes()).collect())
}

/// Morph offsets of a stream, `[target][vertex]` of three floats; zeros where a target leaves it alone.
pub fn morph_delta_bytes(mesh: &Mesh, primitive: usize, stream: Stream) -> Vec<u8> {
    let source = &mesh.primitives[primitive];
    let count = source.vertices.positions.len();
    let mut deltas = vec![0; count * source.morph_targets.len() * size_of::<Vec3>()];
    if deltas.is_empty() {
        return deltas;
    }
    let directions = (stream == Stream::ShellDirection).then(|| ShellDirections::new(mesh, primitive));
    for ((index, target), into) in
        source.morph_targets.iter().enumerate().zip(deltas.chunks_exact_mut(count * size_of::<Vec3>()))
    {
        let offsets = match (stream, &directions) {
            (Stream::Position, _) => Cow::Borrowed(&target.positions[..]),
            (Stream::Normal, _) => Cow::Borrowed(&target.normals[..]),
            (Stream::Tangent, _) => Cow::Borrowed(&target.tangents[..]),
            (_, Some(directions)) => Cow::Owned(directions.deltas(index)),
            // A morph turns the comb's axis little, and the shader keeps it across the morphed direction.
            _ => Cow::Borrowed(&[][..]),
        };
        if !offsets.is_empty() {
            into.copy_from_slice(bytemuck::cast_slice(&offsets));
        }
    }
    deltas
}

/// Shell directions follow the fully morphed shape: files carry normals, not these.
struct ShellDirections<'a> {
    mesh: &'a Mesh,
    primitive: usize,
    at_rest: Vec<Vec3>,
}

impl<'a> ShellDirections<'a> {
    fn new(mesh: &'a Mesh, primitive: usize) -> Self {
        Self { mesh, primitive, at_rest: shell_directions_of_mesh(mesh).swap_remove(primitive) }
    }

    /// What a target adds to them; empty where it moves no position of the mesh.
    fn deltas(&self, target: usize) -> Vec<Vec3> {
        let moves =
            |primitive: &Primitive| primitive.morph_targets.get(target).is_some_and(|t| !t.positions.is_empty());
        if !self.mesh.primitives.iter().any(moves) {
            return Vec::new();
        }
        let primitives = self.mesh.primitives.iter().map(|primitive| moved_to_target(primitive, target)).collect();
        let morphed = shell_directions_of_mesh(&Mesh { primitives, ..Mesh::default() }).swap_remove(self.primitive);
        morphed.iter().zip(&self.at_rest).map(|(to, from)| *to - *from).collect()
    }
}

/// What shell directions see of a primitive, at a target.
fn moved_to_target(primitive: &Primitive, target: usize) -> Primitive {
    let Vertices { positions, normals, .. } = &primitive.vertices;
    let mut positions = positions.clone();
    if let Some(offsets) = primitive.morph_targets.get(target) {
        positions.iter_mut().zip(&offsets.positions).for_each(|(position, offset)| *position += *offset);
    }
    let vertices = Vertices { positions, normals: normals.clone(), ..Vertices::default() };
    Primitive { topology: primitive.topology, indices: primitive.indices.clone(), vertices, ..Primitive::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::{MorphTarget, procedural};

    #[test]
    fn targets_that_move_nothing_are_zeros_in_their_place() {
        let mut cube = procedural::cube(1.0);
        let count = cube.vertices.positions.len();
        let mut offsets = vec![Vec3::ZERO; count];
        offsets[0] = Vec3::new(0.5, 0.25, 0.0);
        let moving = MorphTarget { positions: offsets.clone(), ..MorphTarget::default() };
        cube.morph_targets = vec![MorphTarget::default(), moving, MorphTarget::default()];
        let mesh = Mesh { primitives: vec![cube], ..Mesh::default() };
        let deltas = |stream| bytemuck::pod_collect_to_vec::<u8, Vec3>(&morph_delta_bytes(&mesh, 0, stream));
        let zeros = vec![Vec3::ZERO; count];
        assert_eq!(deltas(Stream::Position), [zeros.clone(), offsets, zeros.clone()].concat());
        assert_eq!(deltas(Stream::Normal), zeros.repeat(3));
        let directions = deltas(Stream::ShellDirection);
        assert_eq!((&directions[..count], &directions[2 * count..]), (&zeros[..], &zeros[..]));
        assert!(directions[count..2 * count].iter().any(|delta| delta.length() > 0.01));
    }
}
