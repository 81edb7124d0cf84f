// Satin: how its parameters become the two anisotropic lobes of anisotropy.glsl. Functions only.
//
// A mixture, not a sum: the lobes share the surface in proportion to their strength, so that their albedos, each at most
// 1, never add up to more. Source of the limits: classic satin, with what its strength promised read as reflectance.
#ifndef VAIR_SATIN_GLSL
#define VAIR_SATIN_GLSL
#include "ggx.glsl"

float satin_largest(vec3 color) {
    return max(color.x, max(color.y, color.z));
}

// Reflectance that a lobe asks for, may exceed 1: strength in [0, 30] times that of a dielectric. light_tint in [0, 1] is
// how much of the light's own colour stays: the lobe's colour fades to its brightest channel's grey.
vec3 satin_reflectance(vec3 color, float strength, float light_tint) {
    return 0.04 * strength * mix(color, vec3(satin_largest(color)), light_tint);
}

// Share of the surface that a lobe has beside the other, by their reflectances; nothing asks for nothing.
float satin_share(vec3 reflectance, vec3 other) {
    float own = satin_largest(reflectance);
    return own / max(own + satin_largest(other), 1e-30);
}

// Reflectance at normal incidence on that share.
vec3 satin_f0(vec3 reflectance, float share) {
    return min(reflectance / max(share, 1e-6), 1.0);
}

// What a lobe takes of a metal's own reflectance: all of it from the reflectance of plain plastic on, none where it is black.
vec3 satin_metal(vec3 reflectance) {
    return min(reflectance * 25.0, 1.0);
}

// Reflectance at grazing incidence: a black lobe has none.
float satin_f90(vec3 f0) {
    return min(50.0 * satin_largest(f0), 1.0);
}

// Local strength of the highlight, which never goes dark.
float satin_noise(float texel) {
    return 0.5 + 0.5 * texel;
}

// Classic widths: an axis is 0 at full anisotropy; held where single precision can still divide by it.
vec2 satin_classic_alpha(float roughness, float anisotropy) {
    float alpha = roughness * roughness;
    return max(vec2(alpha * (1.0 + anisotropy), alpha * (1.0 - anisotropy)), 1e-3);
}

// Classic lobe times the cosine of l, before strength and colour: GGX without its 1 / (ax ay); v and l above the horizon.
vec3 satin_classic_times_cosine(vec3 f0, vec2 alpha, vec3 v, vec3 l) {
    vec3 h = ggx_half_vector(v, l);
    float lobe = ggx_ndf(h, alpha.x, alpha.y) * ggx_masking_shadowing_times_cosine(v, l, alpha.x, alpha.y);
    return schlick(f0, dot(v, h)) * (lobe * alpha.x * alpha.y);
}

// Classic colour of the highlight under that light: not a reflectance, blue light comes back red.
vec3 satin_classic_light(vec3 tint, vec3 light, float light_tint) {
    return mix(tint * dot(light, vec3(0.2125, 0.7154, 0.0721)), light, light_tint);
}

#endif
