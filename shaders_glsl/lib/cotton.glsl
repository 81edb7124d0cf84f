// Classic cotton, defects and all: Charlie's distribution with a visibility that knows no roughness, and a base dimmed on
// the eye's side alone. What is evaluated by default is fuzz.glsl. Functions only; directions as in sheen.glsl.
//
// Sources: Estevez & Kulla 2017, "Production Friendly Microfacet Sheen BRDF"; Neubelt & Pettineo 2013, "Crafting a Next-Gen
// Material Pipeline for The Order: 1886"; KHR_materials_sheen (albedo scaling).
#ifndef VAIR_COTTON_GLSL
#define VAIR_COTTON_GLSL
#include "fuzz.glsl"

// What the base keeps of the light: 1 - max(sheen_color) E(v), E cut at 1 in the table.
float cotton_classic_scale(vec3 sheen_color, float sheen_albedo) {
    return 1.0 - max(sheen_color.r, max(sheen_color.g, sheen_color.b)) * sheen_albedo;
}

// BRDF times the cosine of l; pile and fibre are lobes of SHEEN_CLASSIC.
vec3 cotton_classic_brdf_times_cosine(vec3 base_color, vec3 sheen_color, SheenLobe pile, SheenLobe fibre, vec3 v, vec3 l) {
    if (v.z <= 0.0 || l.z <= 0.0) {
        return vec3(0.0);
    }
    float fresnel = 0.04 + 0.96 * schlick_weight(dot(v, ggx_half_vector(v, l)));
    vec3 base = base_color * 0.318309886 * l.z + fresnel * sheen_brdf_times_cosine(SHEEN_CLASSIC, pile, v, l);
    return base * cotton_classic_scale(sheen_color, fibre.albedo)
        + sheen_color * sheen_brdf_times_cosine(SHEEN_CLASSIC, fibre, v, l);
}

// Radiance under constant white radiance 1; roughness of pile and fibres, occlusion 1 = open.
vec3 cotton_classic_ambient(
    vec3 base_color, vec3 sheen_color, SheenLobe pile, SheenLobe fibre, float mu_v, vec2 roughness, float occlusion) {
    float scale = cotton_classic_scale(sheen_color, fibre.albedo);
    float pile_occlusion = fuzz_specular_occlusion(mu_v, roughness.x, occlusion);
    float fibre_occlusion = fuzz_specular_occlusion(mu_v, roughness.y, occlusion);
    return base_color * scale * occlusion
        + 0.04 * pile.albedo * fuzz_bounced_occlusion(pile_occlusion, vec3(0.04))
        + sheen_color * fibre.albedo * fuzz_bounced_occlusion(fibre_occlusion, sheen_color);
}

#endif
