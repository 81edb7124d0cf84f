// Velvet: how wide its fibres scatter, and the classic form, defects and all. What is evaluated by default is fuzz.glsl.
// Functions only; directions as in sheen.glsl.
//
// Source of the classic form: the fabric shading of older engines (reference/classic/velvet.rs states it); visibility
// by height-correlated Smith (Heitz 2014), as they leave it open.
#ifndef VAIR_VELVET_GLSL
#define VAIR_VELVET_GLSL
#include "fuzz.glsl"

// Distribution of normals, which knows no roughness and integrates to 0.68.
float velvet_classic_ndf(vec3 h_in_tangent) {
    float sunk = 1.0 - h_in_tangent.z;
    return 0.96 * sunk * sunk + 0.057;
}

// Highlight times the cosine of l, Fresnel to the fourth power; 0 where either direction is at or below the horizon.
vec3 velvet_classic_highlight_times_cosine(vec3 f0, float roughness, vec3 v, vec3 l) {
    if (v.z <= 0.0 || l.z <= 0.0) {
        return vec3(0.0);
    }
    vec3 h = ggx_half_vector(v, l);
    float f = 1.0 - clamp(dot(v, h), 0.0, 1.0);
    float alpha = ggx_alpha(roughness);
    vec3 fresnel = f0 + (1.0 - f0) * (f * f) * (f * f);
    return fresnel * (velvet_classic_ndf(h) * ggx_masking_shadowing_times_cosine(v, l, alpha, alpha));
}

// Radiance that a light adds whatever its strength; cosines, mu_l at or below 0 where the light is behind.
vec3 velvet_classic_scatter(vec3 scatter_color, float scatter_scale, float mu_v, float mu_l) {
    float turned = clamp(1.0 - mu_v, 0.0, 1.0);
    float steep = (turned * turned) * (turned * turned);
    float flat_rim = 0.4 * turned;
    return scatter_color * (0.5 * max(mu_l, 0.0) + 0.5) * (steep + (flat_rim - steep) * scatter_scale);
}

#endif
