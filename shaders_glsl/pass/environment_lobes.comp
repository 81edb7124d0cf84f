#version 460
#extension GL_GOOGLE_include_directive : require
// The table of lobes: how each lobe, seen under each cosine and of each roughness, looks into prefiltered radiance. The
// moments that say so, its mean direction and that direction's length, are those of its density to the power of 3/2: they
// follow the core of the lobe, of which its picture is made, rather than its long tail.
#include "environment.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

struct EnvironmentLobesDraw {
    uint nodes;   // along the cosine and along the roughness
    uint samples; // of GGX, in pairs
};
layout(push_constant) uniform EnvironmentLobesBlock { EnvironmentLobesDraw draw; };

// The table of sheen: sheets of 32 x 32, each node albedo, a, b, average.
layout(set = 0, binding = 0, std430) readonly buffer SheenNodes { vec4 sheen_nodes[]; };
layout(set = 0, binding = 1, std430) writeonly buffer LobeEntries { vec4 lobe_entries[]; };

const uint SIDE = 48u; // rings and directions around, half a turn, of a lobe of sheen

// What a lobe's samples add up to.
struct Moments {
    vec3 direction; // by density^1.5
    float weight;
    float albedo;
    float fresnel;
};

// 1 - the length of the mean direction, by density^1.5, of the GGX lobe seen from the front. The tangent squared of its
// facets is alpha^2 (e^s - 1), their density in s e^-s; midpoint rule.
float front_spread(float alpha) {
    float a2 = alpha * alpha;
    float to = log(1.0 + 1.0 / a2);
    float weights = 0.0;
    float spread = 0.0;
    for (uint i = 0u; i < 64u; ++i) {
        float share = exp(-(float(i) + 0.5) * 0.015625 * to);
        float tangent = a2 * (1.0 - share) / share;
        // 1 - cos of the reflected direction, which turns by twice the facet's angle.
        float away = 2.0 * tangent / (1.0 + tangent);
        float masking = environment_masking(max(1.0 - away, 0.0), alpha);
        float weight = share * masking * share * (1.0 + tangent) * sqrt(masking);
        weights += weight;
        spread += weight * away;
    }
    return spread / weights;
}

// Perceptual roughness of the front-seen lobe that spreads so much, at most 1.
float roughness_of_spread(float spread) {
    float from = 0.0316227766;
    float to = 1.0;
    for (uint i = 0u; i < 20u; ++i) {
        float middle = 0.5 * (from + to);
        if (front_spread(middle * middle) < spread) { from = middle; } else { to = middle; }
    }
    return 0.5 * (from + to);
}

Moments ggx_moments(vec3 v, float alpha) {
    Moments moments = Moments(vec3(0.0), 0.0, 0.0, 0.0);
    float masking = environment_masking(v.z, alpha);
    for (uint i = 0u; i < draw.samples; ++i) {
        vec2 u = environment_hammersley(i >> 1u, (draw.samples + 1u) >> 1u);
        // In pairs from opposite sides: a lobe along the normal then has its mean there.
        u.x = fract(u.x + 0.5 * float(i & 1u));
        vec3 h = environment_visible_facet(u, v, alpha);
        float cosine = dot(v, h);
        vec3 l = 2.0 * cosine * h - v;
        if (l.z <= 0.0) { continue; }
        float shape = ggx_masking_shadowing_times_cosine(v, l, alpha, alpha);
        float albedo = shape * 4.0 * v.z / masking;
        float weight = albedo * sqrt(shape * ggx_ndf(h, alpha, alpha));
        moments.direction += weight * l;
        moments.weight += weight;
        moments.albedo += albedo;
        moments.fresnel += albedo * schlick_weight(cosine);
    }
    moments.fresnel /= max(moments.albedo, 1e-30);
    moments.albedo /= float(draw.samples);
    return moments;
}

// Node of the sheen table between nodes; sheet below 3.
vec4 sheen_node(uint sheet, float mu, float roughness) {
    vec2 at = vec2(sqrt(mu), roughness) * 31.0;
    uvec2 node = min(uvec2(at), uvec2(30u));
    vec2 part = at - vec2(node);
    uint start = (sheet * 32u + node.y) * 32u + node.x;
    return mix(mix(sheen_nodes[start], sheen_nodes[start + 1u], part.x),
               mix(sheen_nodes[start + 32u], sheen_nodes[start + 33u], part.x), part.y);
}

// Directions l = reflections of v at facets: those cluster at the horizon, about as wide as alpha. The transformed cosine
// of the volume by directions of the cosine that it transforms.
Moments sheen_moments(uint sheet, vec3 v, float roughness) {
    Moments moments = Moments(vec3(0.0), 0.0, 0.0, 0.0);
    SheenLobe lobe = sheen_lobe(sheet, roughness, v, sheen_node(sheet, v.z, roughness));
    float reach = sheet == SHEEN_VOLUME ? 1.0 : log(1.0 / lobe.alpha + sqrt(1.0 / (lobe.alpha * lobe.alpha) + 1.0));
    for (uint i = 0u; i < SIDE * SIDE; ++i) {
        vec2 u = (vec2(i % SIDE, i / SIDE) + 0.5) / float(SIDE);
        float around = 3.14159265 * u.y;
        vec2 azimuth = vec2(cos(around), sin(around));
        vec3 l;
        float albedo;
        if (sheet == SHEEN_VOLUME) {
            if (lobe.ltc.x < 1e-5) { break; }
            vec3 w = vec3(sqrt(u.x) * azimuth, sqrt(1.0 - u.x));
            l = normalize(vec3((w.x - lobe.ltc.y * w.z) / lobe.ltc.x, w.y / lobe.ltc.x, w.z));
            albedo = lobe.albedo;
        } else {
            // The cosine of the facet is alpha sinh(reach u).
            float grown = exp(reach * u.x);
            float z = 0.5 * lobe.alpha * (grown - 1.0 / grown);
            float step = 0.5 * lobe.alpha * (grown + 1.0 / grown) * reach;
            vec3 h = vec3(sqrt(max(1.0 - z * z, 0.0)) * azimuth, min(z, 1.0));
            float cosine = dot(v, h);
            l = 2.0 * cosine * h - v;
            if (cosine <= 0.0 || l.z <= 0.0) { continue; }
            // Reflection spreads solid angle by 4 v.h.
            albedo = sheen_brdf_times_cosine(sheet, lobe, v, l) * 4.0 * cosine * step * 6.28318531;
        }
        float weight = albedo * sqrt(sheen_brdf_times_cosine(sheet, lobe, v, l));
        // The other half of the turn mirrors this one.
        moments.direction += weight * vec3(l.x, 0.0, l.z);
        moments.weight += weight;
        moments.albedo += albedo;
    }
    moments.albedo /= float(SIDE * SIDE);
    return moments;
}

void main() {
    uvec3 at = gl_GlobalInvocationID;
    if (at.x >= draw.nodes || at.y >= draw.nodes) { return; }
    vec2 place = vec2(at.xy) / float(draw.nodes - 1u);
    float roughness = place.y;
    // The ratio of sines has a limit at the normal, and the lobes one at the horizon.
    float mu = clamp(place.x * place.x, 1e-3, 0.998);
    vec3 v = vec3(sqrt(1.0 - mu * mu), 0.0, mu);
    bool is_ggx = at.z == ENVIRONMENT_GGX;
    Moments moments = is_ggx ? ggx_moments(v, ggx_alpha(roughness)) : sheen_moments(at.z - 1u, v, roughness);
    float size = length(moments.direction);
    vec4 entry = vec4(0.0, 1.0, moments.albedo, moments.fresnel);
    if (size > 0.0) {
        entry.x = clamp(-moments.direction.x / (size * v.x), -1.0, 1.0);
        entry.y = roughness_of_spread(1.0 - size / moments.weight);
    }
    // A mirror stays one.
    if (is_ggx && roughness <= 0.0) { entry.xy = vec2(1.0, 0.0); }
    lobe_entries[(at.z * draw.nodes + at.y) * draw.nodes + at.x] = entry;
}
