// What lights a surface: punctual lights, and the environment. For every fragment shader that is lit.
#ifndef VAIR_LIGHTING_GLSL
#define VAIR_LIGHTING_GLSL
#include "frame.glsl"
#include "object.glsl"
#include "environment.glsl"
#include "light.glsl"

layout(constant_id = 90) const bool HAS_SHADOWS = false;
layout(constant_id = 91) const bool HAS_SCREEN_OCCLUSION = false;

layout(set = 0, binding = 0, std140) uniform FrameBlock { FrameUniforms frame; };
layout(set = 0, binding = 1, std430) readonly buffer LightList { LightSource lights[]; };
layout(set = 0, binding = 2) uniform textureCube environment_map;
layout(set = 0, binding = 3) uniform sampler environment_sampler;
layout(set = 0, binding = 4) uniform texture2D lobe_table;
layout(set = 0, binding = 5) uniform sampler lobe_table_sampler;
layout(push_constant) uniform DrawBlock { ObjectDraw draw; };
#ifdef OCCLUDED
#include "shadow_light.glsl"
#extension GL_EXT_samplerless_texture_functions : require
layout(set = 0, binding = 12) uniform texture2D screen_occlusion_map;
#endif

// Lights that reach this object.
uint light_count() {
    return draw.light_count;
}

// One of them, as it arrives past what casts a shadow.
LightSample light_at(uint index, vec3 position_in_world) {
    LightSource source = lights[draw.first_light + index];
    LightSample light = light_sample(source, position_in_world);
#ifdef OCCLUDED
    if (HAS_SHADOWS && any(greaterThan(light.irradiance, vec3(0.0)))) {
        light.irradiance *= shadow_transmittance(source, light.direction_in_world, position_in_world);
    }
#endif
    return light;
}

// Share of the ambient light that what stands around lets through, as the screen shows it.
float screen_occlusion() {
#ifdef OCCLUDED
    if (HAS_SCREEN_OCCLUSION) { return texelFetch(screen_occlusion_map, ivec2(gl_FragCoord.xy), 0).r; }
#endif
    return 1.0;
}

// By which a material turns the environment that it sees, beside the frame's turn: cosine and sine.
vec2 own_environment_turn = vec2(1.0, 0.0);

// From the world's axes to the environment's.
vec3 environment_direction(vec3 w) {
    return environment_from_world(environment_from_world(w, own_environment_turn), frame.environment_turn);
}

vec3 harmonic(uint index, vec3 w) {
    return frame.environment_harmonics[index].rgb * environment_sh(index, w);
}

// Mean radiance by the bands of harmonics 0 to 2, as a kernel of unit integral weights them that has these bands 1 and 2.
// Not yet cut off at 0; w in the environment's axes.
vec3 environment_mean(vec3 w, float band_1, float band_2) {
    vec3 mean = harmonic(0u, w) + band_1 * (harmonic(1u, w) + harmonic(2u, w) + harmonic(3u, w));
    return mean + band_2 * (harmonic(4u, w) + harmonic(5u, w) + harmonic(6u, w) + harmonic(7u, w) + harmonic(8u, w));
}

// Mean radiance around a direction, weighted by the cosine: what a white Lambert surface that faces it shows. Source:
// Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps"; band 4 is kept.
vec3 environment_irradiance(vec3 direction_in_world) {
    vec3 w = environment_direction(direction_in_world);
    vec3 band = harmonic(16u, w) + harmonic(17u, w) + harmonic(18u, w) + harmonic(19u, w) + harmonic(20u, w)
        + harmonic(21u, w) + harmonic(22u, w) + harmonic(23u, w) + harmonic(24u, w);
    vec3 mean = environment_mean(w, environment_cosine_band(1u), environment_cosine_band(2u));
    return max(mean + environment_cosine_band(4u) * band, vec3(0.0));
}

// Radiance around a direction, spread as a GGX lobe of that perceptual roughness spreads it that is seen from the front.
vec3 environment_radiance(vec3 direction_in_world, float roughness) {
    float level = environment_level(roughness, frame.environment_levels);
    vec3 w = environment_direction(direction_in_world);
    return frame.environment_scale * textureLod(samplerCube(environment_map, environment_sampler), w, level).rgb;
}

// How a lobe looks into that radiance: (mirror, roughness, albedo, Fresnel's share), see environment_lobe_axis. sheet
// ENVIRONMENT_GGX, or 1 + SHEEN_*.
vec4 lobe_entry(uint sheet, float mu, float roughness) {
    float nodes = float(textureSize(sampler2D(lobe_table, lobe_table_sampler), 0).x);
    return textureLod(sampler2D(lobe_table, lobe_table_sampler), environment_table_uv(sheet, mu, roughness, nodes), 0.0);
}

#endif
