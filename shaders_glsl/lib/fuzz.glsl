// Cloth with fuzz: a Lambert base under two lobes of sheen, one of the pile that lies on it, one of the fibres that stand
// up. Never more light leaves than came in, and a white base returns all of it. Functions only; directions as in sheen.glsl.
//
// Source: Kelemen & Szirmay-Kalos 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model" (the coupling of the base).
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

// Radiance to v: what pile, fibres and base see, mean radiances.
vec3 fuzz_ambient(FuzzSurface s, vec3 pile_light, vec3 fibre_light, vec3 base_light) {
    vec3 pile = s.pile_color * s.pile.albedo;
    vec3 fibre = s.fibre_color * s.fibre.albedo;
    return pile * pile_light + fibre * fibre_light + s.diffuse * (1.0 - pile - fibre) * base_light;
}

#endif
