// The standard surface: Lambert under GGX, coupled by directional albedo so that never more leaves than came in.
// Functions only; directions are unit vectors in the tangent frame (z = normal) and point away from the surface.
//
// Sources: Burley 2012, "Physically-Based Shading at Disney" (metallic-roughness); Turquin 2019 (specular
// compensation) and Kelemen & Szirmay-Kalos 2001 (reciprocal diffuse coupling), see albedo.glsl.
#ifndef VAIR_STANDARD_GLSL
#define VAIR_STANDARD_GLSL
#include "ggx.glsl"
#include "albedo.glsl"

// A surface seen from one direction: what does not depend on the light is evaluated once per fragment.
struct StandardSurface {
    vec3 f0;                    // reflectance at normal incidence, linear
    float roughness;            // perceptual, [0, 1]
    vec3 diffuse;               // diffuse albedo before the coupling, linear
    float alpha_x;              // GGX widths along tangent and bitangent, [1e-3, 1]
    vec3 coupled_diffuse;       // diffuse (1 - E(v)) / (pi (1 - E_average))
    float alpha_y;
    vec3 specular_compensation; // factor on the single-scattering lobe
    vec3 specular_albedo;       // E(v) of the compensated lobe
};

// f0 and diffuse linear in [0, 1]; roughness in [0, 1]; mu_v = cosine of the view angle, [0, 1].
StandardSurface standard_coupled(vec3 f0, vec3 diffuse, float roughness, float mu_v) {
    StandardSurface s;
    s.roughness = roughness;
    s.alpha_x = ggx_alpha(roughness);
    s.alpha_y = s.alpha_x;
    s.f0 = f0;
    s.diffuse = diffuse;
    vec2 terms = ggx_albedo_terms(mu_v, roughness);
    s.specular_albedo = compensated_albedo(s.f0, 1.0, terms);
    s.specular_compensation = standard_specular_compensation(s.f0, terms.x);
    vec3 average = average_compensated_albedo(s.f0, 1.0, ggx_average_terms(roughness));
    s.coupled_diffuse = s.diffuse * 0.318309886 * (1.0 - s.specular_albedo) / max(1.0 - average, 1e-4);
    return s;
}

// base_color linear in [0, 1]; metallic in [0, 1].
StandardSurface standard_surface(vec3 base_color, float metallic, float roughness, float mu_v) {
    return standard_coupled(0.04 + (base_color - 0.04) * metallic, base_color * (1.0 - metallic), roughness, mu_v);
}

// BRDF times the cosine of l, per channel; 0 where either direction is at or below the horizon.
vec3 standard_brdf_times_cosine(StandardSurface s, vec3 v, vec3 l) {
    if (v.z <= 0.0 || l.z <= 0.0) {
        return vec3(0.0);
    }
    vec3 h = ggx_half_vector(v, l);
    float lobe = ggx_ndf(h, s.alpha_x, s.alpha_y) * ggx_masking_shadowing_times_cosine(v, l, s.alpha_x, s.alpha_y);
    vec3 specular = schlick(s.f0, dot(v, h)) * s.specular_compensation * lobe;
    vec3 left = 1.0 - compensated_albedo(s.f0, 1.0, ggx_albedo_terms(l.z, s.roughness));
    return specular + s.coupled_diffuse * left * l.z;
}

// Radiance that the surface sends to v: mirrored and scattered = mean radiance that the highlight and the diffuse lobe see.
vec3 standard_ambient(StandardSurface s, vec3 mirrored, vec3 scattered) {
    return s.specular_albedo * mirrored + s.diffuse * (1.0 - s.specular_albedo) * scattered;
}

#endif
