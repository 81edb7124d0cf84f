// Classic cotton, defects and all: Charlie's distribution with a visibility that knows no roughness, and a base dimmed on
// the eye's side alone. What is evaluated by default is fuzz.glsl. Functions only; directions as in sheen.glsl.
//
// Sources: Estevez & Kulla 2017, "Production Friendly Microfacet Sheen BRDF"; Neubelt & Pettineo 2013, "Crafting a Next-Gen
// Material Pipeline for The Order: 1886"; KHR_materials_sheen (albedo scaling); Lagarde & de Rousiers 2014, "Moving Frostbite
// to Physically Based Rendering" (specular occlusion).
#ifndef VAIR_COTTON_GLSL
#define VAIR_COTTON_GLSL
#include "fuzz.glsl"
#include "occlusion.glsl"

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

// Share of the environment that a lobe sees through a crevice; roughness perceptual, ambient occlusion 1 = open.
float cotton_classic_occlusion(float mu_v, float roughness, float occlusion) {
    float sum = mu_v + occlusion;
    float raised = sum <= 0.0 ? 0.0 : pow(sum, roughness * roughness);
    return clamp(raised - 1.0 + occlusion, 0.0, 1.0);
}

// What a lobe of that colour and albedo reflects of the radiance that it sees.
vec3 cotton_classic_lobe_ambient(vec3 color, float albedo, float mu_v, float roughness, float occlusion, vec3 light) {
    float seen = cotton_classic_occlusion(mu_v, roughness, occlusion);
    return color * albedo * occlusion_bounced(seen, color) * light;
}

#endif
