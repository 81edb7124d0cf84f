// Lobes of fuzz, and what they leave to the cloth below. Functions only; directions are unit vectors in the tangent frame
// (z = normal) that point away from the surface. Albedos come from the table that tools/fit_sheen.rs makes: a pass fetches
// it at sheen_table_uv with linear filtering and clamped edges, and hands in what it finds.
//
// Sources: Zeltner, Burley & Chiang 2022, "Practical Multiple-Scattering Sheen Using Linearly Transformed Cosines"; Estevez
// & Kulla 2017, "Production Friendly Microfacet Sheen BRDF" (Charlie; shadowing as in KHR_materials_sheen); Ashikhmin,
// Premoze & Shirley 2000, "A Microfacet-Based BRDF Generator", and Neubelt & Pettineo 2013, "Crafting a Next-Gen Material
// Pipeline for The Order: 1886" (velvet, and the visibility of cloth).
#ifndef VAIR_SHEEN_GLSL
#define VAIR_SHEEN_GLSL
#include "ggx.glsl"

// Models of fuzz, and the sheets of the table in this order.
const uint SHEEN_VOLUME = 0u;
const uint SHEEN_CHARLIE = 1u;
const uint SHEEN_INVERTED = 2u;
const uint SHEEN_CLASSIC = 3u;

// Where the table holds a cosine and a perceptual roughness, both in [0, 1].
vec2 sheen_table_uv(uint sheen, float mu, float roughness) {
    vec2 place = clamp(vec2(sqrt(max(mu, 0.0)), roughness), 0.0, 1.0) * 31.0 + 0.5;
    return vec2(place.x / 32.0, (place.y + 32.0 * float(sheen)) / 128.0);
}

// Charlie's distribution of normals; alpha in (0, 1]. 0 for the zero h of opposed directions.
float sheen_charlie_ndf(vec3 h_in_tangent, float alpha) {
    float sine_squared = dot(h_in_tangent.xy, h_in_tangent.xy);
    if (sine_squared <= 0.0) {
        return 0.0;
    }
    // log(1 - c^2), from whichever of sine and cosine is small: nothing cancels, and where GLSL's log errs most, a series
    // stands in.
    float x = h_in_tangent.z * h_in_tangent.z;
    float log_sine_squared = x < 0.0625 ? -x * (1.0 + x * (0.5 + x * (0.333333333 + x * (0.25 + x * 0.2))))
                                        : log(sine_squared);
    return (2.0 + 1.0 / alpha) * exp(log_sine_squared / (2.0 * alpha)) * 0.159154943;
}

float sheen_charlie_log_lambda(float x, float alpha) {
    float share = (1.0 - alpha) * (1.0 - alpha);
    float a = 21.5473 + 3.7772 * share;
    float b = 3.82987 - 0.50552 * share;
    float c = 0.19823 - 0.03022 * share;
    float d = -1.9776 + 0.70367 * share;
    float e = -4.32054 - 0.53913 * share;
    return a / (1.0 + b * pow(x, c)) + d * x + e;
}

// Smith's Lambda of Charlie; mu in [0, 1].
float sheen_charlie_lambda(float mu, float alpha) {
    if (mu < 0.5) {
        return exp(sheen_charlie_log_lambda(mu, alpha));
    }
    return exp(2.0 * sheen_charlie_log_lambda(0.5, alpha) - sheen_charlie_log_lambda(1.0 - mu, alpha));
}

// The inverted Gaussian of velvet; alpha in [1e-3, 1]. 0 for the zero h of opposed directions.
float sheen_inverted_ndf(vec3 h_in_tangent, float alpha) {
    float sine_squared = dot(h_in_tangent.xy, h_in_tangent.xy);
    float cosine = h_in_tangent.z / alpha;
    if (sine_squared + h_in_tangent.z <= 0.0) {
        return 0.0;
    }
    // Near the normal the exponent ends what the division begins: e^-80 is already nothing.
    float exponent = cosine * cosine / max(sine_squared, 1e-12);
    float rim = exponent < 80.0 ? exp(-exponent) / (sine_squared * sine_squared) : 0.0;
    return (1.0 + 4.0 * rim) * 0.318309886 / (1.0 + 4.0 * alpha * alpha);
}

// G / (4 mu_v mu_l) of cloth, times mu_l; mu_v > 0.
float sheen_cloth_visibility_times_cosine(float mu_v, float mu_l) {
    return 0.25 * mu_l / max(mu_l + mu_v - mu_l * mu_v, 1e-30);
}

// The transformed cosine times the cosine of l, which integrates to 1; ltc = (a, b) of the table, view_axis = the unit
// projection of the view. 0 where a is none.
float sheen_ltc_times_cosine(vec2 ltc, vec2 view_axis, vec3 l) {
    if (ltc.x < 1e-5) {
        return 0.0;
    }
    float along = ltc.x * dot(view_axis, l.xy) + ltc.y * l.z;
    float across = ltc.x * (view_axis.x * l.y - view_axis.y * l.x);
    // a^2 z / (pi |w|^4); divided by a first, as the square of a small a would leave single precision.
    float squared = along * along + across * across + l.z * l.z;
    float shrunk = ltc.x / max(squared, 1e-12);
    return shrunk * shrunk * l.z * 0.318309886;
}

// A white lobe seen from one direction: what does not depend on the light is evaluated once per fragment.
struct SheenLobe {
    float albedo;     // E(v), in [0, 1]
    float average;    // cosine-weighted average of E
    vec2 ltc;         // a and b of SHEEN_VOLUME
    vec2 view_axis;   // unit projection of the view, of SHEEN_VOLUME
    float alpha;      // width, of the others
    float lambda;     // Lambda(v), of SHEEN_CHARLIE
};

// roughness perceptual in [0, 1], the same that the table was asked for; table = its texel (albedo, a, b, average).
SheenLobe sheen_lobe(uint sheen, float roughness, vec3 v, vec4 table) {
    SheenLobe lobe = SheenLobe(table.x, table.w, table.yz, vec2(1.0, 0.0), roughness, 0.0);
    if (sheen == SHEEN_VOLUME) {
        float squared = dot(v.xy, v.xy);
        if (squared > 1e-14) {
            lobe.view_axis = v.xy * inversesqrt(squared);
        }
    } else if (sheen == SHEEN_CHARLIE) {
        // Narrower, its shadowing would return more than it gets.
        lobe.alpha = max(roughness * roughness, 0.07);
        lobe.lambda = sheen_charlie_lambda(clamp(v.z, 0.0, 1.0), lobe.alpha);
    } else if (sheen == SHEEN_INVERTED) {
        lobe.alpha = ggx_alpha(roughness);
    } else {
        lobe.alpha = max(roughness, 0.005);
    }
    return lobe;
}

// BRDF of the white lobe times the cosine of l; 0 where either direction is at or below the horizon.
float sheen_brdf_times_cosine(uint sheen, SheenLobe lobe, vec3 v, vec3 l) {
    if (v.z <= 0.0 || l.z <= 0.0) {
        return 0.0;
    }
    if (sheen == SHEEN_VOLUME) {
        return lobe.albedo * sheen_ltc_times_cosine(lobe.ltc, lobe.view_axis, l);
    }
    vec3 h = ggx_half_vector(v, l);
    if (sheen == SHEEN_CHARLIE) {
        float lambda = lobe.lambda + sheen_charlie_lambda(min(l.z, 1.0), lobe.alpha);
        return sheen_charlie_ndf(h, lobe.alpha) * 0.25 / ((1.0 + lambda) * max(v.z, 1e-3));
    }
    float ndf = sheen == SHEEN_INVERTED ? sheen_inverted_ndf(h, lobe.alpha) : sheen_charlie_ndf(h, lobe.alpha);
    return ndf * sheen_cloth_visibility_times_cosine(v.z, l.z);
}

// What fuzz of the albedo E(v) and the average E leaves of a Lambert base, before the light's side of it: times
// 1 - E(l) the whole is reciprocal, and a white base returns all the light (Kelemen & Szirmay-Kalos 2001).
vec3 sheen_base_scale(vec3 albedo, vec3 average) {
    return (1.0 - albedo) / max(1.0 - average, 1e-4);
}

#endif
