// The engine's own box.

struct Frame {
    clip_from_world: mat4x4f,
    direction_to_light_in_world: vec3f,
}

@group(0) @binding(0) var<uniform> frame: Frame;

struct Vertex {
    @builtin(position) position_in_clip: vec4f,
    @location(0) normal_in_world: vec3f,
}

const HALF_SIZE_M = 0.12;
// Two triangles of a face, counter-clockwise from outside.
const CORNERS = array(vec2f(-1, -1), vec2f(1, -1), vec2f(1, 1), vec2f(-1, -1), vec2f(1, 1), vec2f(-1, 1));

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Vertex {
    let face = index / 6;
    var corners = CORNERS;
    let corner = corners[index % 6];
    let side = select(-1.0, 1.0, face % 2 == 0);
    // The two axes across the face; mirrored with the side, so that the winding stays.
    let local = vec3f(corner.x * side, corner.y, 1.0 * side);
    let axis = face / 2;
    var position = local;
    var normal = vec3f(0, 0, side);
    if axis == 1 {
        position = local.zxy;
        normal = normal.zxy;
    } else if axis == 2 {
        position = local.yzx;
        normal = normal.yzx;
    }
    return Vertex(frame.clip_from_world * vec4f(position * HALF_SIZE_M, 1), normal);
}

@fragment
fn fragment(in: Vertex) -> @location(0) vec4f {
    let sun = saturate(dot(in.normal_in_world, frame.direction_to_light_in_world));
    return vec4f(vec3f(0.03, 0.12, 0.9) * (0.4 + 0.6 * sun), 1);
}
