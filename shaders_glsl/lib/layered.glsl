// What glTF's material extensions put on the standard surface: a dielectric of any index, strength and colour, two widths
// of its highlight, light that goes through, sheen, varnish. Functions only; directions are unit vectors in the tangent
// frame (z = normal) and point away from the surface.
//
// From the top: varnish, sheen, base (KHR_materials_sheen: "clearcoat is layered on top of sheen"). A layer dims what is
// under it by its directional albedo towards the eye or the light, whichever takes more (KHR_materials_sheen,
// "Albedo-scaling technique"): reciprocal, and safe over any base, since no light gives more than the eye's side leaves.
//
// Sources: Khronos, KHR_materials_{specular, ior, anisotropy, clearcoat, sheen, diffuse_transmission, transmission}; for
// compensation and coupling see standard.glsl.
#ifndef VAIR_LAYERED_GLSL
#define VAIR_LAYERED_GLSL
#include "ggx.glsl"
#include "albedo.glsl"
#include "color.glsl"

// Reflectance at normal incidence of a dielectric in air; index 0 reflects everything (KHR_materials_ior).
float layered_f0_of_ior(float ior) {
    float ratio = (ior - 1.0) / (ior + 1.0);
    return ratio * ratio;
}

// GGX widths along and across the direction of anisotropy (KHR_materials_anisotropy).
vec2 layered_widths(float roughness, float anisotropy) {
    float alpha = ggx_alpha(roughness);
    return vec2(alpha + (1.0 - alpha) * anisotropy * anisotropy, alpha);
}

// Fresnel reflectance between f0 and f90 (Schlick 1994).
vec3 layered_fresnel(vec3 f0, vec3 f90, float v_dot_h) {
    return f0 + (f90 - f0) * schlick_weight(v_dot_h);
}

// Albedo of the compensated lobe, in [0, 1]; terms from ggx_albedo_terms. With f90 = 1 that of albedo.glsl.
vec3 layered_albedo(vec3 f0, vec3 f90, vec2 terms) {
    return (f0 + (f90 - f0) * terms.y) * (terms.x + f0 * (1.0 - terms.x));
}

// Its cosine-weighted average; terms from ggx_average_terms.
vec3 layered_average_albedo(vec3 f0, vec3 f90, vec3 terms) {
    return f0 * (terms.y + f0 * (1.0 - terms.y)) + (f90 - f0) * (terms.x + f0 * (terms.z - terms.x));
}

// The base seen from one direction.
struct LayeredBase {
    vec3 f0;                    // reflectance at normal incidence, linear
    float roughness;            // of the isotropic lobe that couples: perceptual, [0, 1]
    vec3 f90;                   // reflectance at grazing incidence, linear
    float alpha_x;              // GGX widths along tangent and bitangent, [1e-3, 1]
    vec3 diffuse;               // albedo of what is scattered to both sides, before the coupling, linear
    float alpha_y;
    vec3 coupled_reflection;    // of it to this side, times (1 - E(v)) / (pi (1 - E_average))
    vec3 coupled_transmission;  // and to the other side
    vec3 specular_compensation; // factor on the single-scattering lobe
    vec3 specular_albedo;       // E(v) of the compensated lobe
};

// `reflected` and `transmitted` are albedos of the diffuse lobes, together at most 1; mu_v = cosine of the view angle.
LayeredBase layered_base(vec3 f0, vec3 f90, vec3 reflected, vec3 transmitted, float roughness, vec2 widths, float mu_v) {
    LayeredBase s;
    s.f0 = f0;
    s.f90 = f90;
    s.roughness = roughness;
    s.alpha_x = widths.x;
    s.alpha_y = widths.y;
    s.diffuse = reflected + transmitted;
    vec2 terms = ggx_albedo_terms(mu_v, roughness);
    s.specular_albedo = layered_albedo(f0, f90, terms);
    s.specular_compensation = standard_specular_compensation(f0, terms.x);
    vec3 average = layered_average_albedo(f0, f90, ggx_average_terms(roughness));
    vec3 coupling = 0.318309886 * (1.0 - s.specular_albedo) / max(1.0 - average, 1e-4);
    s.coupled_reflection = reflected * coupling;
    s.coupled_transmission = transmitted * coupling;
    return s;
}

// BSDF times the cosine of l, per channel, from both sides of the surface; 0 where the eye is at or below the horizon.
vec3 layered_base_times_cosine(LayeredBase s, vec3 v, vec3 l) {
    if (v.z <= 0.0 || l.z == 0.0) {
        return vec3(0.0);
    }
    float mu_l = abs(l.z);
    vec3 left = 1.0 - layered_albedo(s.f0, s.f90, ggx_albedo_terms(mu_l, s.roughness));
    if (l.z < 0.0) {
        return s.coupled_transmission * left * mu_l;
    }
    vec3 h = ggx_half_vector(v, l);
    float lobe = ggx_ndf(h, s.alpha_x, s.alpha_y) * ggx_masking_shadowing_times_cosine(v, l, s.alpha_x, s.alpha_y);
    vec3 specular = layered_fresnel(s.f0, s.f90, dot(v, h)) * s.specular_compensation * lobe;
    return specular + s.coupled_reflection * left * mu_l;
}

// Radiance that the base sends to v under constant white radiance 1 from both sides.
vec3 layered_base_ambient(LayeredBase s) {
    return s.specular_albedo + s.diffuse * (1.0 - s.specular_albedo);
}

// Albedo of a whole coat of varnish (index 1.5) at a cosine.
float layered_coat_albedo(float mu, float roughness) {
    return layered_albedo(vec3(0.04), vec3(1.0), ggx_albedo_terms(mu, roughness)).x;
}

// GGX of a whole coat times the cosine of l, in the coat's own tangent frame. 0 where a direction is at or below its
// horizon.
float layered_coat_times_cosine(float roughness, vec3 v, vec3 l) {
    if (v.z <= 0.0 || l.z <= 0.0) {
        return 0.0;
    }
    vec3 h = ggx_half_vector(v, l);
    float alpha = ggx_alpha(roughness);
    float white = ggx_albedo_terms(v.z, roughness).x;
    float compensation = standard_specular_compensation(vec3(0.04), white).x;
    float fresnel = schlick(vec3(0.04), dot(v, h)).x;
    return fresnel * compensation * ggx_ndf(h, alpha, alpha) * ggx_masking_shadowing_times_cosine(v, l, alpha, alpha);
}

// What a layer of that strength leaves of the light under it; its albedos towards the eye and the light.
float layered_under(float strength, float albedo_to_eye, float albedo_to_light) {
    return 1.0 - clamp(strength * max(albedo_to_eye, albedo_to_light), 0.0, 1.0);
}

// Share of the light from behind that a surface lets through as it is; of a colour, its luminance, as one number must do.
float layered_through(float transmission, float metallic, vec3 base_color, vec3 specular_albedo) {
    return transmission * (1.0 - metallic) * luminance(base_color * (1.0 - specular_albedo));
}

#endif
