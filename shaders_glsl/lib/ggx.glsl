// The anisotropic GGX microfacet model. Functions only; all vectors are unit length in the tangent frame (z = normal).
//
// Sources: Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces" (distribution); Heitz 2014,
// "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs" (height-correlated Smith); Schlick 1994,
// "An Inexpensive BRDF Model for Physically-based Rendering". No 1 - n.h^2 appears anywhere: it cancels in single
// precision where the lobe is narrow.
#ifndef VAIR_GGX_GLSL
#define VAIR_GGX_GLSL

// alpha = roughness^2, at least what single precision resolves.
float ggx_alpha(float roughness) {
    return clamp(roughness * roughness, 1e-3, 1.0);
}

// Widths along tangent and bitangent, anisotropy in [-1, 1], positive: stretched along the tangent. The axis ratio is
// (1 + a) : (1 - a), the product roughness^4 until a width reaches its limit.
vec2 ggx_anisotropic_alpha(float roughness, float anisotropy) {
    float a = clamp(anisotropy, -0.98, 0.98);
    float stretch = sqrt((1.0 + a) / (1.0 - a));
    float alpha = roughness * roughness;
    return clamp(vec2(alpha * stretch, alpha / stretch), 1e-3, 1.0);
}

// Distribution of normals per steradian; ax, ay in (0, 1]. A unit h gives s >= 1; the zero h of opposed directions 0.
float ggx_ndf(vec3 h_in_tangent, float ax, float ay) {
    float x = h_in_tangent.x / ax;
    float y = h_in_tangent.y / ay;
    float s = x * x + y * y + h_in_tangent.z * h_in_tangent.z;
    if (s < 0.5) {
        return 0.0;
    }
    float q = 1.0 / (s * sqrt(ax * ay));
    return q * q * 0.318309886;
}

// G2 / (4 mu_v mu_l) * mu_l: all of the BRDF times cosine but D and F; v.z > 0, l.z >= 0. At most 0.5 / |(ax vx, ay vy, vz)|.
float ggx_masking_shadowing_times_cosine(vec3 v, vec3 l, float ax, float ay) {
    float length_v = length(vec3(ax * v.x, ay * v.y, v.z));
    float length_l = length(vec3(ax * l.x, ay * l.y, l.z));
    return 0.5 * l.z / max(l.z * length_v + v.z * length_l, 1e-30);
}

// Half vector; zero where v and l are opposed (|v + l| < 1e-6), as there is none.
vec3 ggx_half_vector(vec3 v, vec3 l) {
    vec3 h = v + l;
    float squared = dot(h, h);
    return squared < 1e-12 ? vec3(0.0) : h * inversesqrt(squared);
}

// (1 - v.h)^5 by multiplication.
float schlick_weight(float v_dot_h) {
    float f = 1.0 - clamp(v_dot_h, 0.0, 1.0);
    float f2 = f * f;
    return f2 * f2 * f;
}

// Fresnel reflectance, F90 = 1.
vec3 schlick(vec3 f0, float v_dot_h) {
    return f0 + (1.0 - f0) * schlick_weight(v_dot_h);
}

#endif
