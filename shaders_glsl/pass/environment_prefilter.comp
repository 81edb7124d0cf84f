#version 460
#extension GL_GOOGLE_include_directive : require
// One level of prefiltered radiance: the mean under the GGX lobe that is seen from the front, by facets drawn from it, each
// looking into the level of the cube whose texels are as large as its share of the lobe (filtered importance sampling).
#include "environment.glsl"
#include "environment_texels.glsl"
#include "direction.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

struct EnvironmentPrefilterDraw {
    uint face_px;    // of level 0
    uint level;      // to make
    uint last_level;
    uint samples;    // a texel
};
layout(push_constant) uniform EnvironmentPrefilterBlock { EnvironmentPrefilterDraw draw; };

layout(set = 0, binding = 0, std430) readonly buffer CubeTexels { vec4 cube[]; };
layout(set = 0, binding = 1, std430) writeonly buffer PrefilteredTexels { vec4 prefiltered[]; };

// A texel of a level of the cube; beyond the edge of its face that of the neighbouring face.
vec3 cube_texel(uint start, uint side, uint face, ivec2 texel) {
    int last = int(side) - 1;
    if (min(texel.x, texel.y) < 0 || max(texel.x, texel.y) > last) {
        vec3 place = environment_face_place(environment_face_direction(face, cube_place(texel, side)));
        face = uint(place.z);
        texel = clamp(ivec2((place.xy * 0.5 + 0.5) * float(side)), ivec2(0), ivec2(last));
    }
    return cube[start + (face * side + uint(texel.y)) * side + uint(texel.x)].rgb;
}

vec3 cube_radiance(vec3 direction, uint start, uint side) {
    vec3 place = environment_face_place(direction);
    uint face = uint(place.z);
    vec2 at = (place.xy * 0.5 + 0.5) * float(side) - 0.5;
    ivec2 texel = ivec2(floor(at));
    vec2 part = at - vec2(texel);
    return mix(mix(cube_texel(start, side, face, texel), cube_texel(start, side, face, texel + ivec2(1, 0)), part.x),
               mix(cube_texel(start, side, face, texel + ivec2(0, 1)), cube_texel(start, side, face, texel + ivec2(1, 1)), part.x),
               part.y);
}

void main() {
    uvec3 at = gl_GlobalInvocationID;
    uint side = draw.face_px >> draw.level;
    if (at.x >= side || at.y >= side) { return; }
    uint target = cube_level_start(draw.face_px, draw.level) + (at.z * side + at.y) * side + at.x;
    if (draw.level == 0u) {
        prefiltered[target] = cube[target];
        return;
    }
    float alpha = environment_alpha_of_level(float(draw.level), float(draw.last_level));
    mat3 frame = direction_frame(environment_face_direction(at.z, cube_place(ivec2(at.xy), side)));
    // Of one texel of level 0.
    float texel_solid_angle = 2.0943951 / float(draw.face_px * draw.face_px);
    float smallest = log2(float(draw.face_px));
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (uint i = 0u; i < draw.samples; ++i) {
        // In pairs from opposite sides, so that the mean of their directions is the axis.
        vec2 u = environment_hammersley(i >> 1u, (draw.samples + 1u) >> 1u);
        u.x = fract(u.x + 0.5 * float(i & 1u));
        // Denser in the long tail of the lobe, whose shares would be large and blur each other.
        float thinned = 2.0 * (1.0 - u.y);
        u.y = 1.0 - (1.0 - u.y) * (1.0 - u.y);
        vec3 facet = environment_visible_facet(u, vec3(0.0, 0.0, 1.0), alpha);
        vec3 l = vec3(2.0 * facet.z * facet.xy, 2.0 * facet.z * facet.z - 1.0);
        if (l.z <= 0.0) { continue; }
        // The density of l is a quarter of the facet's.
        float solid_angle = 4.0 * thinned / (float(draw.samples) * ggx_ndf(facet, alpha, alpha));
        // Between two levels, so that neighbouring texels do not catch and miss a small sun.
        float level = clamp(0.5 * log2(solid_angle / texel_solid_angle) + 0.5, 0.0, smallest);
        uint finer = uint(level);
        uint coarser = min(finer + 1u, uint(smallest));
        vec3 radiance = mix(cube_radiance(frame * l, cube_level_start(draw.face_px, finer), draw.face_px >> finer),
                            cube_radiance(frame * l, cube_level_start(draw.face_px, coarser), draw.face_px >> coarser),
                            fract(level));
        float weight = thinned * environment_masking(l.z, alpha);
        sum += weight * radiance;
        weights += weight;
    }
    prefiltered[target] = vec4(sum / max(weights, 1e-6), 0.0);
}
