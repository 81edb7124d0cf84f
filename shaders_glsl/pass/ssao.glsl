// What the passes of screen-space occlusion share: the G-buffer, and what stands at a pixel.
#ifndef VAIR_SSAO_GLSL
#define VAIR_SSAO_GLSL
#include "octahedral.glsl"

struct SsaoDraw {
    mat3 camera_from_world;    // rotation
    vec2 focal;                // clip x and y of a view position at distance 1 (perspective) or at any (parallel)
    vec2 depth;                // clip z = depth.x * view z + depth.y
    float orthographic;        // 1 for a parallel camera, 0 for perspective
    float radius_m;            // of what occludes
    uint slices;
    uint steps;                // a side of a slice
};
layout(push_constant) uniform SsaoBlock { SsaoDraw draw; };

layout(set = 0, binding = 0) uniform texture2D gbuffer;
layout(set = 0, binding = 1) uniform texture2D gbuffer_depth;

// What stands at a pixel, in view space: x to the right, y up, z backwards.
struct Standing {
    vec3 position;             // metres
    bool is_there;
};

Standing standing_at(ivec2 pixel) {
    float depth = texelFetch(gbuffer_depth, pixel, 0).r;
    vec2 size = vec2(textureSize(gbuffer_depth, 0));
    vec2 in_clip = (vec2(pixel) + 0.5) / size * vec2(2.0, -2.0) + vec2(-1.0, 1.0);
    bool is_parallel = draw.orthographic > 0.5;
    // A parallel camera divides by 1, another by the distance.
    float z = is_parallel ? (depth - draw.depth.y) / draw.depth.x : -draw.depth.y / (depth + draw.depth.x);
    vec2 across = in_clip / draw.focal * (is_parallel ? 1.0 : -z);
    return Standing(vec3(across, z), depth > 0.0);
}

vec3 normal_at(ivec2 pixel) {
    return draw.camera_from_world * octahedral_direction(texelFetch(gbuffer, pixel, 0).rg);
}

#endif
