// An anisotropic GGX lobe that returns what scatters more than once, and its directional albedo, by which other lobes are
// coupled as albedo.glsl does. Functions only; directions are unit vectors in the tangent frame (x = tangent, z = normal).
//
// Sources: as ggx.glsl; Turquin 2019 (compensation). The albedo is our own mapping onto the isotropic fits. What Smith's
// masking asks of a direction is its slope in units of the widths: that is kept, on a lobe of the width that loses as
// much seen from the front. Against quadrature over widths 1e-3..1, mu 1e-3..1 and all azimuths: never more than 0.1 %
// below the truth, as that would gain energy; at most 0.21 above it, where widths ten times apart and more are seen
// grazing and across.
#ifndef VAIR_ANISOTROPY_GLSL
#define VAIR_ANISOTROPY_GLSL
#include "ggx.glsl"
#include "albedo.glsl"

// A lobe seen from one direction: what does not depend on the light is evaluated once per fragment.
struct AnisotropicLobe {
    vec3 f0;           // reflectance at normal incidence, linear
    float f90;         // reflectance at grazing incidence, [0, 1], not below f0
    vec3 compensation; // factor on the single-scattering lobe
    float alpha_x;     // width along the tangent, [1e-3, 1]
    float alpha_y;     // width along the bitangent
};

// (width, share): the isotropic width that loses as much seen from the front, and how anisotropic it is, in [0, 1].
vec2 anisotropic_mean(vec2 alpha) {
    vec2 squared = alpha * alpha;
    float sum = squared.x + squared.y;
    float share = abs(squared.x - squared.y) / sum;
    float mean = sqrt(0.5 * sum);
    return vec2(mean * (1.0 + share * share * (0.08 - 0.16 * mean)), share);
}

// (E1, Q) towards w, as ggx_albedo_terms has them of isotropic lobes; w.z in [0, 1].
vec2 anisotropic_albedo_terms(vec3 w, vec2 alpha) {
    vec2 mean = anisotropic_mean(alpha);
    vec2 along = alpha * w.xy;
    vec2 across = alpha.yx * w.xy;
    float slope_squared = dot(along, along);
    // The cosine at which a lobe of the mean width has the same slope in units of its width.
    float mu = w.z / max(sqrt(w.z * w.z + 2.0 * slope_squared / dot(alpha, alpha)), 1e-15);
    float white = ggx_albedo_terms(mu, sqrt(mean.x)).x * (1.0 + 0.04 * mean.y);
    // Fresnel follows the width along the view; normals that lean across it are met at a more grazing angle.
    // Straight from the front there is no along: both are the mean.
    float sine_squared = dot(w.xy, w.xy) + 1e-12;
    float front = 0.5e-12 * dot(alpha, alpha);
    float along_squared = (slope_squared + front) / sine_squared;
    float across_squared = (dot(across, across) + front) / sine_squared;
    float lean = max(across_squared - along_squared, 0.0) * inversesqrt(across_squared);
    float roughness = sqrt(sqrt(along_squared / (1.0 + 3.6 * lean)));
    float fresnel = ggx_albedo_terms(w.z * inversesqrt(1.0 + 0.15 * lean), roughness).y;
    // Widths more than ten times apart send more to a grazing eye across the long one than any isotropic width does.
    float flatness = max(1.0 - 10.0 * min(alpha.x, alpha.y) / max(alpha.x, alpha.y), 0.0);
    float leaning = lean * inversesqrt(across_squared) * 0.03 / (0.03 + w.z);
    fresnel += (1.0 - fresnel) * 0.27 * flatness * leaning;
    return vec2(min(white, 1.0), fresnel);
}

// Cosine-weighted averages of (E1 Q, E1, Q); the albedo that follows is never too large, and at most 0.016 too small.
vec3 anisotropic_average_terms(vec2 alpha) {
    return ggx_average_terms(sqrt(anisotropic_mean(alpha).x));
}

// Seen from v.
AnisotropicLobe anisotropic_lobe(vec3 v, vec2 alpha, vec3 f0, float f90) {
    AnisotropicLobe lobe;
    lobe.f0 = f0;
    lobe.f90 = f90;
    lobe.compensation = standard_specular_compensation(f0, anisotropic_albedo_terms(v, alpha).x);
    lobe.alpha_x = alpha.x;
    lobe.alpha_y = alpha.y;
    return lobe;
}

// BRDF times the cosine of l, per channel; 0 where either direction is at or below the horizon.
vec3 anisotropic_lobe_times_cosine(AnisotropicLobe lobe, vec3 v, vec3 l) {
    if (v.z <= 0.0 || l.z <= 0.0) {
        return vec3(0.0);
    }
    vec3 h = ggx_half_vector(v, l);
    float normals = ggx_ndf(h, lobe.alpha_x, lobe.alpha_y);
    float seen = ggx_masking_shadowing_times_cosine(v, l, lobe.alpha_x, lobe.alpha_y);
    vec3 fresnel = lobe.f0 + (lobe.f90 - lobe.f0) * schlick_weight(dot(v, h));
    return fresnel * lobe.compensation * (normals * seen);
}

// Albedo towards w, in [0, 1]: share of light from everywhere that the lobe sends there, and of light from there that it
// takes from what lies below.
vec3 anisotropic_lobe_albedo(AnisotropicLobe lobe, vec3 w) {
    return compensated_albedo(lobe.f0, lobe.f90, anisotropic_albedo_terms(w, vec2(lobe.alpha_x, lobe.alpha_y)));
}

// Its cosine-weighted average.
vec3 anisotropic_lobe_average_albedo(AnisotropicLobe lobe) {
    vec3 terms = anisotropic_average_terms(vec2(lobe.alpha_x, lobe.alpha_y));
    return average_compensated_albedo(lobe.f0, lobe.f90, terms);
}

#endif
