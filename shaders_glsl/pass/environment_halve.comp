#version 460
#extension GL_GOOGLE_include_directive : require
// The next smaller level of a cube: means of four texels by their solid angle.
#include "environment.glsl"
#include "environment_texels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

struct EnvironmentHalveDraw {
    uint face_px; // of level 0
    uint level;   // to make, at least 1
};
layout(push_constant) uniform EnvironmentHalveBlock { EnvironmentHalveDraw draw; };

layout(set = 0, binding = 0, std430) buffer CubeTexels { vec4 cube[]; };

void main() {
    uvec3 at = gl_GlobalInvocationID;
    uint side = draw.face_px >> draw.level;
    if (at.x >= side || at.y >= side) { return; }
    uint larger = side * 2u;
    uint from = cube_level_start(draw.face_px, draw.level - 1u) + at.z * larger * larger;
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (uint i = 0u; i < 4u; ++i) {
        uvec2 texel = at.xy * 2u + uvec2(i & 1u, i >> 1u);
        float weight = environment_face_density(cube_place(ivec2(texel), larger));
        sum += weight * cube[from + texel.y * larger + texel.x];
        weights += weight;
    }
    cube[cube_level_start(draw.face_px, draw.level) + (at.z * side + at.y) * side + at.x] = sum / weights;
}
