#version 460
#extension GL_GOOGLE_include_directive : require
// The standard material: metallic-roughness, lit by punctual lights and a constant ambient.
#include "surface.glsl"
#include "standard.glsl"
#ifndef UNLIT
#include "standard_environment.glsl"
#endif

void main() {
    vec4 color = surface_color();
    int mask = surface_mask(color.a);
    float opacity = surface_opacity(color.a);
#ifdef COUNT
    uint mode = ALPHA_MODE;
    uint samples = SAMPLE_COUNT;
    count_fragment(uint(mask), samples, mode != 2u);
    radiance = vec4(1.0);
#elif defined UNLIT
    surface_output(color.rgb * opacity, vec3(1.0 - opacity));
#else
    SurfaceFragment f = surface_fragment(color);
    StandardSurface surface = standard_surface(f.base_color, f.metallic, f.roughness, f.eye_in_tangent.z);
    vec3 sum = standard_environment(f, surface);
    for (uint index = 0u; index < light_count(); ++index) {
        LightSample light = light_at(index, position_in_world);
        vec3 light_in_tangent = light.direction_in_world * f.world_from_tangent;
        sum += light.irradiance * standard_brdf_times_cosine(surface, f.eye_in_tangent, light_in_tangent);
    }
    surface_write(f, sum, opacity);
#endif
    surface_cover(mask);
}
