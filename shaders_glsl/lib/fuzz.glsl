// Cloth with fuzz: a Lambert base under two lobes of sheen, one of the pile that lies on it, one of the fibres that stand
// up. Never more light leaves than came in, and a white base returns all of it. Functions only; directions as in sheen.glsl.
//
// Sources: Kelemen & Szirmay-Kalos 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model" (the coupling of the base);
// Lagarde & de Rousiers 2014, "Moving Frostbite to Physically Based Rendering" (specular occlusion); Jimenez et al. 2016,
// "Practical Real-Time Strategies for Accurate Indirect Occlusion" (light that bounces within a crevice).
#ifndef VAIR_FUZZ_GLSL
#define VAIR_FUZZ_GLSL
#include "sheen.glsl"

// A surface seen from one direction: what does not depend on the light is evaluated once per fragment.
struct FuzzSurface {
    vec3 diffuse;          // albedo of the base before the coupling, linear
    vec3 coupled_diffuse;  // diffuse (1 - S(v)) / (pi (1 - S_average)), S the albedo of both lobes
    vec3 pile_color;       // weight of the pile's lobe
    vec3 fibre_color;      // weight of the standing fibres' lobe
    SheenLobe pile;
    SheenLobe fibre;
};

// Colours linear in [0, 1]. What the standing fibres cover is lost to the pile, so that both together return at most what
// one of them can: its albedo.
FuzzSurface fuzz_surface(vec3 diffuse, vec3 pile_color, vec3 fibre_color, SheenLobe pile, SheenLobe fibre) {
    vec3 seen = pile_color * (1.0 - fibre_color);
    vec3 albedo = seen * pile.albedo + fibre_color * fibre.albedo;
    vec3 average = seen * pile.average + fibre_color * fibre.average;
    vec3 coupled = diffuse * 0.318309886 * sheen_base_scale(albedo, average);
    return FuzzSurface(diffuse, coupled, seen, fibre_color, pile, fibre);
}

// BRDF times the cosine of l, per channel; 0 where either direction is at or below the horizon. albedo_l = E(l) of pile and
// fibres; has_fibre is false where fibre_color is black.
vec3 fuzz_brdf_times_cosine(uint sheen, bool has_fibre, FuzzSurface s, vec3 v, vec3 l, vec2 albedo_l) {
    if (v.z <= 0.0 || l.z <= 0.0) {
        return vec3(0.0);
    }
    vec3 sum = s.pile_color * sheen_brdf_times_cosine(sheen, s.pile, v, l);
    vec3 left = 1.0 - s.pile_color * albedo_l.x;
    if (has_fibre) {
        sum += s.fibre_color * sheen_brdf_times_cosine(sheen, s.fibre, v, l);
        left -= s.fibre_color * albedo_l.y;
    }
    return sum + s.coupled_diffuse * left * l.z;
}

// Share of the surroundings that a lobe sees through a crevice; roughness perceptual, ambient occlusion 1 = open.
float fuzz_specular_occlusion(float mu_v, float roughness, float occlusion) {
    float sum = mu_v + occlusion;
    float raised = sum <= 0.0 ? 0.0 : pow(sum, roughness * roughness);
    return clamp(raised - 1.0 + occlusion, 0.0, 1.0);
}

// Occlusion of a crevice whose walls reflect that colour.
vec3 fuzz_bounced_occlusion(float occlusion, vec3 color) {
    vec3 a = 2.0404 * color - 0.3324;
    vec3 b = -4.7951 * color + 0.6417;
    vec3 c = 2.7552 * color + 0.6903;
    float x = occlusion;
    return clamp(max(vec3(x), ((x * a + b) * x + c) * x), 0.0, 1.0);
}

// Radiance under constant white radiance 1; roughness of pile and fibres, perceptual; occlusion 1 = open.
vec3 fuzz_ambient(FuzzSurface s, float mu_v, vec2 roughness, float occlusion) {
    vec3 pile = s.pile_color * s.pile.albedo;
    vec3 fibre = s.fibre_color * s.fibre.albedo;
    vec3 base = s.diffuse * (1.0 - pile - fibre);
    // Without a map this is known when the pipeline is made, and all that follows is gone.
    if (occlusion >= 1.0) {
        return pile + fibre + base;
    }
    float pile_occlusion = fuzz_specular_occlusion(mu_v, roughness.x, occlusion);
    float fibre_occlusion = fuzz_specular_occlusion(mu_v, roughness.y, occlusion);
    return pile * fuzz_bounced_occlusion(pile_occlusion, s.pile_color)
        + fibre * fuzz_bounced_occlusion(fibre_occlusion, s.fibre_color)
        + base * fuzz_bounced_occlusion(occlusion, s.diffuse);
}

#endif
