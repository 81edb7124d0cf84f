#version 460
#extension GL_GOOGLE_include_directive : require
// Velvet: a dense pile that is dark where it faces the eye and bright at its folds; there is no mirror in it.
#define CLOTH
#include "surface.glsl"
#include "velvet_material.glsl"
#include "fuzz_light.glsl"
#include "velvet.glsl"

layout(constant_id = 20) const uint SHEEN = 0; // SHEEN_*
layout(constant_id = 21) const bool CLASSIC = false;
layout(constant_id = 22) const bool HAS_FIBRE = false;

layout(set = 1, binding = 20, std140) uniform VelvetBlock { VelvetUniforms velvet; };

// Older engines: no indirect highlight, and a rim that asks no light for leave.
vec3 classic_radiance(SurfaceFragment f, vec3 diffuse, vec3 f0) {
    vec3 v = f.eye_in_tangent;
    vec3 sum = diffuse_light(f, diffuse) * diffuse;
    for (uint index = 0u; index < light_count(); ++index) {
        LightSample light = light_at(index, position_in_world);
        vec3 l = light.direction_in_world * f.world_from_tangent;
        vec3 lobe = velvet_classic_highlight_times_cosine(f0, f.roughness, v, l);
        sum += light.irradiance * (lobe + diffuse * 0.318309886 * max(l.z, 0.0));
        sum += velvet_classic_scatter(velvet.scatter_color, velvet.scatter_scale, v.z, l.z);
    }
    return sum;
}

void main() {
    vec4 color = surface_color();
    int mask = surface_mask(color.a);
    SurfaceFragment f = surface_fragment(color);
    vec3 diffuse = f.base_color * (1.0 - f.metallic);
    vec3 f0 = 0.04 + (f.base_color - 0.04) * f.metallic;
    vec3 reflected;
    if (CLASSIC) {
        reflected = classic_radiance(f, diffuse, f0);
    } else {
        reflected = fuzz_radiance(f, SHEEN, HAS_FIBRE, diffuse, f0, velvet.scatter_color, velvet.scatter_roughness);
    }
    surface_write(f, reflected, surface_opacity(color.a));
    surface_cover(mask);
}
