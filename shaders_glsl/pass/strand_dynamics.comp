#version 460
#extension GL_GOOGLE_include_directive : require
// How far strands lag behind their moving roots, once a frame and furred part.
#include "strand_dynamics.glsl"

layout(local_size_x = 64) in;

struct StrandDynamicsDraw {
    mat4 world_from_object;  // identity where the positions are in world space
    uint vertex_count;
    uint reset;              // 1: come to rest
    float step_s;            // seconds since the last step; 0: none, the strands hold still
    float stiffness;         // 1/s^2
    float damping;           // ratio; 1 is critical
    float force_per_m;       // bending force a metre of lag, >= 0
};
layout(push_constant) uniform StrandDynamicsBlock { StrandDynamicsDraw draw; };

struct StrandVertex {
    vec3 root_in_world;      // metres, at the last step
    vec3 lag;                // metres, world space
    vec3 velocity;           // of the tip, metres a second, world space
};
layout(set = 0, binding = 0, std430) readonly buffer PositionStream { float position[]; };
layout(set = 0, binding = 1, std430) buffer StrandVertexList { StrandVertex vertices[]; };
layout(set = 0, binding = 2, std430) writeonly buffer StrandStream { float sway[]; };

void main() {
    uint vertex = gl_GlobalInvocationID.x;
    if (vertex >= draw.vertex_count) { return; }
    uint first = vertex * 3u;
    vec3 root = (draw.world_from_object * vec4(position[first], position[first + 1u], position[first + 2u], 1.0)).xyz;

    StrandState state = STRAND_AT_REST;
    if (draw.reset == 0u) {
        state = StrandState(vertices[vertex].lag, vertices[vertex].velocity);
        if (draw.step_s > 0.0) {
            vec3 moved = root - vertices[vertex].root_in_world;
            state = sway_step(state, moved, draw.step_s, draw.stiffness, draw.damping);
            // Farther than this nothing more is to be seen, and a thrown object would flutter for long.
            if (draw.force_per_m > 0.0) { state = sway_limited(state, moved / draw.step_s, 1.0 / draw.force_per_m); }
        }
    }
    if (draw.reset != 0u || draw.step_s > 0.0) {
        vertices[vertex].root_in_world = root;
        vertices[vertex].lag = state.lag;
        vertices[vertex].velocity = state.velocity;
    }
    vec3 force = draw.force_per_m * state.lag;
    sway[first] = force.x;
    sway[first + 1u] = force.y;
    sway[first + 2u] = force.z;
}
