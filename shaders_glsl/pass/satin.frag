#version 460
#extension GL_GOOGLE_include_directive : require
// Satin: silk, charmeuse, taffeta.
#define CLOTH
#include "surface.glsl"
#include "satin_material.glsl"
#include "standard.glsl"

layout(constant_id = 20) const bool HAS_SPECULAR_NOISE_MAP = false;

layout(set = 1, binding = 20, std140) uniform SatinBlock { SatinUniforms satin; };
#ifdef MAPS
layout(set = 1, binding = 21) uniform texture2D specular_noise_map;
layout(set = 1, binding = 22) uniform sampler specular_noise_sampler;
#endif

void main() {
    vec4 color = surface_color();
    int mask = surface_mask(color.a);
    SurfaceFragment f = surface_fragment(color);
    float strength = 1.0;
#ifdef MAPS
    if (HAS_SPECULAR_NOISE_MAP) {
        vec2 uv = uv_transformed(satin.specular_noise_transform, uv_sets.xy, uv_sets.zw);
        strength = texture(sampler2D(specular_noise_map, specular_noise_sampler), uv).r;
    }
#endif
    StandardSurface surface = standard_surface(f.base_color, f.metallic, f.roughness, f.eye_in_tangent.z);
    surface.alpha_x = clamp(surface.alpha_x * (1.0 + satin.anisotropy), 1e-3, 1.0);
    vec3 sum = frame.ambient_radiance * f.occlusion * standard_ambient(surface) * strength;
    for (uint index = 0u; index < frame.light_count; ++index) {
        LightSample light = light_sample(lights[index], position_in_world);
        vec3 light_in_tangent = light.direction_in_world * f.world_from_tangent;
        sum += light.irradiance * standard_brdf_times_cosine(surface, f.eye_in_tangent, light_in_tangent);
    }
    surface_write(f, sum, surface_opacity(color.a));
    surface_cover(mask);
}
