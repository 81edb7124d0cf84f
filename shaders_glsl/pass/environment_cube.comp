#version 460
#extension GL_GOOGLE_include_directive : require
// From an equirectangular picture to the faces of a cube: each texel the mean over a grid of directions, each of those a
// box about it that is as wide as high on the sphere, so that rows near the poles are not undersampled.
#include "environment.glsl"
#include "environment_texels.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

struct EnvironmentCubeDraw {
    uint columns;           // of the picture
    uint rows;
    uint face_px;
    uint directions_a_side; // of the grid in a texel
};
layout(push_constant) uniform EnvironmentCubeBlock { EnvironmentCubeDraw draw; };

layout(set = 0, binding = 0, std430) readonly buffer EquirectTexels { float equirect[]; };
layout(set = 0, binding = 1, std430) writeonly buffer CubeTexels { vec4 cube[]; };

vec3 row_mean(int row, float u) {
    uint y = uint(clamp(row, 0, int(draw.rows) - 1));
    float sine = sin((float(y) + 0.5) * 3.14159265 / float(draw.rows));
    float columns = float(draw.columns);
    // Columns that are as wide as the row is high.
    float width = clamp(0.5 * columns / (float(draw.rows) * max(sine, 1e-6)), 1.0, columns);
    float from = u * columns - 0.5 * width;
    float to = from + width;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int column = int(floor(from)); column <= int(floor(to)); ++column) {
        float weight = min(to, float(column) + 1.0) - max(from, float(column));
        // GLSL's remainder of negative numbers is undefined.
        uint x = uint(column + int(draw.columns)) % draw.columns;
        uint texel = (y * draw.columns + x) * 3u;
        sum += weight * vec3(equirect[texel], equirect[texel + 1u], equirect[texel + 2u]);
        weights += weight;
    }
    return sum / max(weights, 1e-6);
}

void main() {
    uvec3 at = gl_GlobalInvocationID;
    uint face_px = draw.face_px;
    if (at.x >= face_px || at.y >= face_px) { return; }
    uint side = face_px * draw.directions_a_side;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (uint i = 0u; i < draw.directions_a_side * draw.directions_a_side; ++i) {
        uvec2 part = at.xy * draw.directions_a_side + uvec2(i % draw.directions_a_side, i / draw.directions_a_side);
        vec2 place = cube_place(ivec2(part), side);
        vec2 uv = environment_uv(environment_face_direction(at.z, place));
        float row = uv.y * float(draw.rows) - 0.5;
        float weight = environment_face_density(place);
        sum += weight * mix(row_mean(int(floor(row)), uv.x), row_mean(int(floor(row)) + 1, uv.x), fract(row));
        weights += weight;
    }
    cube[(at.z * face_px + at.y) * face_px + at.x] = vec4(sum / weights, 0.0);
}
