#version 460
#extension GL_GOOGLE_include_directive : require
// Cotton: jersey, denim, flannel, felt. A Lambert cloth under its pile and the fibres that stand up from it.
#define CLOTH
#include "surface.glsl"
#include "cotton_material.glsl"
#include "fuzz_light.glsl"
#include "cotton.glsl"

layout(constant_id = 20) const uint SHEEN = 0; // SHEEN_*
layout(constant_id = 21) const bool CLASSIC = false;
layout(constant_id = 22) const bool HAS_FIBRE = false;
layout(constant_id = 23) const bool HAS_SHEEN_COLOR_MAP = false;
layout(constant_id = 24) const bool HAS_SHEEN_MAP = false;
layout(constant_id = 25) const bool HAS_SHEEN_ROUGHNESS_MAP = false;

layout(set = 1, binding = 20, std140) uniform CottonBlock { CottonUniforms cotton; };
#ifdef MAPS
layout(set = 1, binding = 21) uniform texture2D sheen_color_map;
layout(set = 1, binding = 22) uniform sampler sheen_color_sampler;
layout(set = 1, binding = 23) uniform texture2D sheen_map;
layout(set = 1, binding = 24) uniform sampler sheen_sampler;
layout(set = 1, binding = 25) uniform texture2D sheen_roughness_map;
layout(set = 1, binding = 26) uniform sampler sheen_roughness_sampler;
#endif

// Older engines: their table is the sheet SHEEN_CLASSIC.
vec3 classic_radiance(SurfaceFragment f, vec3 sheen_color, float sheen_roughness) {
    vec3 v = f.eye_in_tangent;
    SheenLobe pile = sheen_table_lobe(SHEEN_CLASSIC, v, f.roughness);
    SheenLobe fibre = sheen_table_lobe(SHEEN_CLASSIC, v, sheen_roughness);
    vec3 mirror = f.world_from_tangent * vec3(-v.xy, v.z);
    vec3 pile_light = environment_radiance(mirror, f.roughness);
    vec3 fibre_light = environment_radiance(mirror, sheen_roughness);
    vec3 base = f.base_color * cotton_classic_scale(sheen_color, fibre.albedo);
    vec3 sum = base * f.occlusion * environment_irradiance(f.world_from_tangent[2]);
    sum += cotton_classic_lobe_ambient(vec3(0.04), pile.albedo, v.z, f.roughness, f.occlusion, pile_light);
    sum += cotton_classic_lobe_ambient(sheen_color, fibre.albedo, v.z, sheen_roughness, f.occlusion, fibre_light);
    for (uint index = 0u; index < light_count(); ++index) {
        LightSample light = light_at(index, position_in_world);
        vec3 l = light.direction_in_world * f.world_from_tangent;
        sum += light.irradiance * cotton_classic_brdf_times_cosine(f.base_color, sheen_color, pile, fibre, v, l);
    }
    return sum;
}

void main() {
    vec4 color = surface_color();
    int mask = surface_mask(color.a);
    SurfaceFragment f = surface_fragment(color);
    own_environment_turn = cotton.environment_turn;
    vec3 sheen_color = cotton.sheen_color;
    float sheen_roughness = cotton.sheen_roughness;
#ifdef MAPS
    if (HAS_SHEEN_COLOR_MAP) {
        vec2 uv = uv_transformed(cotton.sheen_color_transform, uv_sets.xy, uv_sets.zw);
        sheen_color *= texture(sampler2D(sheen_color_map, sheen_color_sampler), uv).rgb;
    }
    if (HAS_SHEEN_MAP) {
        vec2 uv = uv_transformed(cotton.sheen_transform, uv_sets.xy, uv_sets.zw);
        sheen_color *= texture(sampler2D(sheen_map, sheen_sampler), uv).r;
    }
    if (HAS_SHEEN_ROUGHNESS_MAP) {
        vec2 uv = uv_transformed(cotton.sheen_roughness_transform, uv_sets.xy, uv_sets.zw);
        sheen_roughness *= texture(sampler2D(sheen_roughness_map, sheen_roughness_sampler), uv).r;
    }
#endif
    vec3 reflected;
    if (CLASSIC) {
        reflected = classic_radiance(f, sheen_color, sheen_roughness);
    } else {
        vec3 diffuse = f.base_color * (1.0 - f.metallic);
        vec3 f0 = 0.04 + (f.base_color - 0.04) * f.metallic;
        reflected = fuzz_radiance(f, SHEEN, HAS_FIBRE, diffuse, f0, sheen_color, sheen_roughness);
    }
    surface_write(f, reflected, surface_opacity(color.a));
    surface_cover(mask);
}
