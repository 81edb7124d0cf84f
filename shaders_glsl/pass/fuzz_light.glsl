// All lights and the environment on a cloth with fuzz: what cotton and velvet share. After surface.glsl.
#ifndef VAIR_FUZZ_LIGHT_GLSL
#define VAIR_FUZZ_LIGHT_GLSL
#include "fuzz.glsl"
#include "sheen_table.glsl"
#include "environment_light.glsl"

// Colours linear in [0, 1]; the pile is as rough as the surface. has_fibre is false where fibre_color is black everywhere.
vec3 fuzz_radiance(
    SurfaceFragment f, uint sheen, bool has_fibre, vec3 diffuse, vec3 pile_color, vec3 fibre_color, float fibre_roughness) {
    vec3 v = f.eye_in_tangent;
    SheenLobe pile = sheen_table_lobe(sheen, v, f.roughness);
    SheenLobe fibre = pile;
    if (has_fibre) {
        fibre = sheen_table_lobe(sheen, v, fibre_roughness);
    }
    FuzzSurface surface = fuzz_surface(diffuse, pile_color, has_fibre ? fibre_color : vec3(0.0), pile, fibre);
    vec3 pile_light = fuzz_light(f, f.world_from_tangent, v, sheen, f.roughness, surface.pile_color);
    vec3 fibre_light = pile_light;
    if (has_fibre) {
        fibre_light = fuzz_light(f, f.world_from_tangent, v, sheen, fibre_roughness, surface.fibre_color);
    }
    vec3 sum = fuzz_ambient(surface, pile_light, fibre_light, diffuse_light(f, diffuse));
    for (uint index = 0u; index < light_count(); ++index) {
        LightSample light = light_at(index, position_in_world);
        vec3 l = light.direction_in_world * f.world_from_tangent;
        if (l.z <= 0.0) { continue; }
        vec2 albedo_l = vec2(sheen_table_texel(sheen, l.z, f.roughness).x, 0.0);
        if (has_fibre) {
            albedo_l.y = sheen_table_texel(sheen, l.z, fibre_roughness).x;
        }
        sum += light.irradiance * fuzz_brdf_times_cosine(sheen, has_fibre, surface, v, l, albedo_l);
    }
    return sum;
}

#endif
