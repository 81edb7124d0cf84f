// What glTF's material extensions put on the standard surface: a dielectric of any index, strength and colour, a highlight
// of two widths, a film on it, light that goes through, varnish over it. Functions only; directions are unit vectors in
// the tangent frame (x = direction of anisotropy, z = normal) and point away from the surface.
//
// From the top: varnish, sheen, base (KHR_materials_sheen: "clearcoat is layered on top of sheen"). A layer dims what is
// under it by its directional albedo towards the eye or the light, whichever takes more (KHR_materials_sheen,
// "Albedo-scaling technique"): reciprocal, and safe over any base, since no light gives more than the eye's side leaves.
//
// Sources: Khronos, KHR_materials_{specular, ior, anisotropy, clearcoat, sheen, diffuse_transmission, transmission}; for
// the lobe see anisotropy.glsl, for a film on it film.glsl (film_f0 makes it a lobe like any other), for the coupling
// standard.glsl.
#ifndef VAIR_LAYERED_GLSL
#define VAIR_LAYERED_GLSL
#include "anisotropy.glsl"
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

// What the compensated lobe leaves, 1 - E, as a sum of what is not negative: the difference would lose its digits where a
// lobe takes almost all. Terms as for compensated_albedo.
vec3 layered_left(vec3 f0, float f90, vec2 terms) {
    vec3 not_reflected = (1.0 - f90) * terms.y + (1.0 - f0) * (1.0 - terms.y);
    return not_reflected + (f0 + (f90 - f0) * terms.y) * ((1.0 - f0) * (1.0 - terms.x));
}

// Its cosine-weighted average; terms as for average_compensated_albedo.
vec3 layered_average_left(vec3 f0, float f90, vec3 terms) {
    vec3 shadowed = f0 * (1.0 - terms.y) + (f90 - f0) * (terms.z - terms.x);
    return (1.0 - f90) * terms.z + (1.0 - f0) * ((1.0 - terms.z) + shadowed);
}

// The base seen from one direction.
struct LayeredBase {
    AnisotropicLobe lobe;
    vec3 albedo;               // E(v) of the lobe
    vec3 reflected;            // albedo of what is scattered to this side, before the coupling, linear
    vec3 transmitted;          // and to the other side
    vec3 coupled_reflection;   // `reflected` times (1 - E(v)) / (pi (1 - E_average))
    vec3 coupled_transmission; // `transmitted` times the same
};

// `terms` are the lobe's towards v, `average_terms` its averages (see albedo.glsl or anisotropy.glsl); `reflected` and
// `transmitted` are albedos of the diffuse lobes, together at most 1.
LayeredBase layered_base(vec3 f0, float f90, vec2 widths, vec2 terms, vec3 average_terms, vec3 reflected, vec3 transmitted) {
    LayeredBase s;
    s.lobe.f0 = f0;
    s.lobe.f90 = f90;
    s.lobe.compensation = standard_specular_compensation(f0, terms.x);
    s.lobe.alpha_x = widths.x;
    s.lobe.alpha_y = widths.y;
    vec3 left = layered_left(f0, f90, terms);
    s.albedo = 1.0 - left;
    s.reflected = reflected;
    s.transmitted = transmitted;
    vec3 coupling = 0.318309886 * left / max(layered_average_left(f0, f90, average_terms), 1e-4);
    s.coupled_reflection = reflected * coupling;
    s.coupled_transmission = transmitted * coupling;
    return s;
}

// BSDF times the cosine of l, per channel, for light from either side; `terms` are the lobe's towards l, turned to the
// eye's side. 0 where the eye is at or below the horizon.
vec3 layered_base_times_cosine(LayeredBase s, vec3 v, vec3 l, vec2 terms) {
    if (v.z <= 0.0) {
        return vec3(0.0);
    }
    vec3 coupled = l.z < 0.0 ? s.coupled_transmission : s.coupled_reflection;
    vec3 scattered = coupled * layered_left(s.lobe.f0, s.lobe.f90, terms) * abs(l.z);
    return anisotropic_lobe_times_cosine(s.lobe, v, l) + scattered;
}

// Radiance that the base sends to v: mirrored = mean radiance that the lobe sees, before and behind = that of either side.
vec3 layered_base_ambient(LayeredBase s, vec3 mirrored, vec3 before, vec3 behind) {
    return s.albedo * mirrored + (s.reflected * before + s.transmitted * behind) * (1.0 - s.albedo);
}

// Albedo of a whole coat of varnish (index 1.5) at a cosine.
float layered_coat_albedo(float mu, float roughness) {
    return compensated_albedo(vec3(0.04), 1.0, ggx_albedo_terms(mu, roughness)).x;
}

// Factor on its single-scattering lobe, seen at that cosine.
float layered_coat_compensation(float mu_v, float roughness) {
    return standard_specular_compensation(vec3(0.04), ggx_albedo_terms(mu_v, roughness).x).x;
}

// GGX of a whole coat times the cosine of l, without the compensation, in the coat's own tangent frame. 0 where a direction
// is at or below its horizon.
float layered_coat_times_cosine(float roughness, vec3 v, vec3 l) {
    if (v.z <= 0.0 || l.z <= 0.0) {
        return 0.0;
    }
    vec3 h = ggx_half_vector(v, l);
    float alpha = ggx_alpha(roughness);
    float lobe = ggx_ndf(h, alpha, alpha) * ggx_masking_shadowing_times_cosine(v, l, alpha, alpha);
    return schlick(vec3(0.04), dot(v, h)).x * lobe;
}

// Albedo of fuzz that dims what is under it, from that of its table: between the table's nodes, which a straight line
// connects, the lobe returns up to 1.8 % more.
float layered_sheen_albedo(float table_albedo) {
    return min(1.018 * table_albedo, 1.0);
}

// What a layer of that strength leaves of the light under it; its albedos towards the eye and the light.
float layered_under(float strength, float albedo_to_eye, float albedo_to_light) {
    return 1.0 - clamp(strength * max(albedo_to_eye, albedo_to_light), 0.0, 1.0);
}

// Share of the light from straight behind that comes through the base (KHR_materials_transmission, without refraction).
vec3 layered_through(float transmission, float metallic, vec3 base_color, vec3 albedo) {
    return transmission * (1.0 - metallic) * base_color * (1.0 - albedo);
}

#endif
