//! Vertex streams, index lists and deform sources as bytes for the device.

use super::stream::Stream;
use crate::asset::{Mesh, Primitive};
use crate::scene::shell_directions_of_mesh;
use glam::Vec3;

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
        Stream::ShellDirection => bytemuck::cast_slice(&shell_directions_of_mesh(mesh)[primitive]).to_vec(),
        Stream::ShellSide => {
            let directions = &shell_directions_of_mesh(mesh)[primitive];
            // Straight up and down there is no "around the vertical"; X is as good as any.
            let side = |direction: &Vec3| Vec3::Y.cross(*direction).normalize_or(Vec3::X);
            directions.iter().flat_map(|direction| bytemuck::cast::<_, [u8; 12]>(side(direction).to_array())).collect()
        }
    }
}

/// Morph offsets of a stream, `[target][vertex]` of three floats; zeros where a target leaves it alone.
pub fn morph_delta_bytes(mesh: &Mesh, primitive: usize, stream: Stream) -> Vec<u8> {
    let source = &mesh.primitives[primitive];
    let count = source.vertices.positions.len();
    let mut deltas: Vec<Vec3> = Vec::with_capacity(count * source.morph_targets.len());
    for target in 0..source.morph_targets.len() {
        let offsets = match stream {
            Stream::Position => source.morph_targets[target].positions.clone(),
            Stream::Normal => source.morph_targets[target].normals.clone(),
            Stream::Tangent => source.morph_targets[target].tangents.clone(),
            Stream::ShellDirection => shell_direction_deltas(mesh, primitive, target),
            // A morph turns the side little, and the shader keeps it across the morphed direction.
            Stream::ShellSide | Stream::Uv0 | Stream::Uv1 | Stream::Color => Vec::new(),
        };
        deltas.extend((0..count).map(|vertex| offsets.get(vertex).copied().unwrap_or(Vec3::ZERO)));
    }
    bytemuck::cast_slice(&deltas).to_vec()
}

/// Shell directions follow the fully morphed shape: files carry normals, not these.
fn shell_direction_deltas(mesh: &Mesh, primitive: usize, target: usize) -> Vec<Vec3> {
    let mut morphed = mesh.clone();
    for primitive in &mut morphed.primitives {
        move_to_target(primitive, target);
    }
    let (from, to) = (shell_directions_of_mesh(mesh), shell_directions_of_mesh(&morphed));
    from[primitive].iter().zip(&to[primitive]).map(|(from, to)| *to - *from).collect()
}

fn move_to_target(primitive: &mut Primitive, target: usize) {
    let Some(offsets) = primitive.morph_targets.get(target) else { return };
    for (position, offset) in primitive.vertices.positions.iter_mut().zip(&offsets.positions) {
        *position += *offset;
    }
}
