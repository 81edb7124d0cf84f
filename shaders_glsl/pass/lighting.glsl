// What lights a surface: punctual lights, and the surroundings. For every fragment shader that is lit.
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
#endif

#ifdef OCCLUDED
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
    if (HAS_SHADOWS && any(greaterThan(light.irradiance, vec3(0.0)))) { light.irradiance *= shadow_transmittance(source, light.direction_in_world, position_in_world); }
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

// Mean radiance around a direction, weighted by the cosine: what a white Lambert surface that faces it shows. Source:
// Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps"; band 4 is kept.
vec3 environment_irradiance(vec3 direction_in_world) {
    vec3 w = environment_direction(direction_in_world);
    float x = w.x;
    float y = w.y;
    float z = w.z;
    float xx = x * x;
    float yy = y * y;
    float zz = z * z;
    vec3 sum = frame.environment_harmonics[0].rgb * 0.282094792;
    // Kernel over pi: 1, 2/3, 1/4, 0, -1/24.
    sum += (2.0 / 3.0) * 0.488602512 * (frame.environment_harmonics[1].rgb * y + frame.environment_harmonics[2].rgb * z
        + frame.environment_harmonics[3].rgb * x);
    sum += 0.25 * (1.092548431 * (frame.environment_harmonics[4].rgb * (x * y) + frame.environment_harmonics[5].rgb * (y * z)
            + frame.environment_harmonics[7].rgb * (x * z))
        + frame.environment_harmonics[6].rgb * (0.315391565 * (3.0 * zz - 1.0))
        + frame.environment_harmonics[8].rgb * (0.546274215 * (xx - yy)));
    vec3 band = frame.environment_harmonics[16].rgb * (2.503342942 * x * y * (xx - yy))
        + frame.environment_harmonics[17].rgb * (1.770130769 * y * z * (3.0 * xx - yy))
        + frame.environment_harmonics[18].rgb * (0.946174696 * x * y * (7.0 * zz - 1.0))
        + frame.environment_harmonics[19].rgb * (0.669046544 * y * z * (7.0 * zz - 3.0))
        + frame.environment_harmonics[20].rgb * (0.105785547 * (35.0 * zz * zz - 30.0 * zz + 3.0))
        + frame.environment_harmonics[21].rgb * (0.669046544 * x * z * (7.0 * zz - 3.0))
        + frame.environment_harmonics[22].rgb * (0.473087348 * (xx - yy) * (7.0 * zz - 1.0))
        + frame.environment_harmonics[23].rgb * (1.770130769 * x * z * (xx - 3.0 * yy))
        + frame.environment_harmonics[24].rgb * (0.625835735 * (xx * (xx - 3.0 * yy) - yy * (3.0 * xx - yy)));
    return max(sum - band / 24.0, vec3(0.0));
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
