// What casters write into the shadow atlas: depth alone or, where they let light through, with LAYERS how much of it.
#ifndef VAIR_SHADOW_OUTPUT_GLSL
#define VAIR_SHADOW_OUTPUT_GLSL
#include "shadow.glsl"

#ifdef LAYERS
layout(set = 0, binding = 8) uniform texture2D shadow_front_map;
layout(set = 0, binding = 9) uniform texture2D shadow_back_map;
layout(location = 0) out vec4 layer_depths; // optical depth up to the knots, summed over all casters
layout(location = 1) out vec4 total_depth;  // optical depth by channel, and the mean
#endif

// A caster that lets this share of light through, by channel.
void shadow_write(vec3 transmittance) {
    vec3 depth = shadow_optical_depth(transmittance);
    float mean = (depth.r + depth.g + depth.b) * (1.0 / 3.0);
    if (mean <= 0.0) { discard; }
#ifdef LAYERS
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float front = texelFetch(shadow_front_map, texel, 0).r;
    float back = texelFetch(shadow_back_map, texel, 0).r;
    layer_depths = shadow_layers(mean, shadow_place(gl_FragCoord.z, front, back));
    total_depth = vec4(depth, mean);
#endif
}

#endif
