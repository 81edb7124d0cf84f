#version 460
#extension GL_GOOGLE_include_directive : require
// Spherical harmonics of a cube's radiance, in two runs: sums over each row of texels, then over the rows, always in the same
// order. The harmonics are integrated over a texel by four points (Gauss), the radiance is its mean.
#include "environment.glsl"
#include "environment_texels.glsl"

layout(local_size_x = 64) in;

layout(constant_id = 0) const bool SUM_ROWS = false; // the second run

struct EnvironmentIrradianceDraw {
    uint face_px; // of level 0
    uint level;   // of the cube that is summed
};
layout(push_constant) uniform EnvironmentIrradianceBlock { EnvironmentIrradianceDraw draw; };

layout(set = 0, binding = 0, std430) readonly buffer CubeTexels { vec4 cube[]; };
// [coefficient][row of the six faces]: sum of radiance in rgb, of solid angle in a.
layout(set = 0, binding = 1, std430) buffer RowSums { vec4 row_sums[]; };
layout(set = 0, binding = 2, std430) buffer HarmonicSums { vec4 harmonics[]; };

void main() {
    uint side = draw.face_px >> draw.level;
    uint rows = 6u * side;
    bool sum_rows = SUM_ROWS;
    uint row = gl_GlobalInvocationID.x;
    uint index = gl_GlobalInvocationID.y;
    vec4 sum = vec4(0.0);
    if (sum_rows) {
        if (row > 0u) { return; }
        for (uint i = 0u; i < rows; ++i) { sum += row_sums[index * rows + i]; }
        // The whole sphere, whatever the quadrature makes of it.
        harmonics[index] = vec4(sum.rgb * (12.5663706 / sum.a), 0.0);
        return;
    }
    if (row >= rows) { return; }
    uint start = cube_level_start(draw.face_px, draw.level) + row * side;
    for (uint x = 0u; x < side; ++x) {
        vec2 middle = cube_place(ivec2(x, row % side), side);
        float solid_angle = 0.0;
        float weight = 0.0;
        for (uint i = 0u; i < 4u; ++i) {
            vec2 place = middle + (vec2(i & 1u, i >> 1u) * 2.0 - 1.0) * (0.577350269 / float(side));
            float share = environment_face_density(place) / float(side * side);
            solid_angle += share;
            weight += share * environment_sh(index, environment_face_direction(row / side, place));
        }
        sum += vec4(cube[start + x].rgb * weight, solid_angle);
    }
    row_sums[index * rows + row] = sum;
}
