// The table of sheen, for fragment shaders whose lobes ask for it: see tools/fit_sheen.rs.
#ifndef VAIR_SHEEN_TABLE_GLSL
#define VAIR_SHEEN_TABLE_GLSL
#include "sheen.glsl"

layout(set = 1, binding = 60) uniform texture2D sheen_table;
layout(set = 1, binding = 61) uniform sampler sheen_table_sampler;

// (albedo, a, b, average of the albedo) at a cosine and a perceptual roughness.
vec4 sheen_table_texel(uint sheen, float mu, float roughness) {
    return textureLod(sampler2D(sheen_table, sheen_table_sampler), sheen_table_uv(sheen, mu, roughness), 0.0);
}

// The lobe with its entry: one roughness for both.
SheenLobe sheen_table_lobe(uint sheen, vec3 v, float roughness) {
    return sheen_lobe(sheen, roughness, v, sheen_table_texel(sheen, v.z, roughness));
}

#endif
