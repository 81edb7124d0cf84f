#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
// Composes each pixel's list of what blends over the opaque picture, sample by sample, and averages the samples.
#include "frame.glsl"
#include "oit_list.glsl"
#include "transparency.glsl"
#include "sample_places.glsl"

layout(constant_id = 0) const bool WEIGHTED = false; // by weights that fall with the distance, in whatever order

#ifdef MULTISAMPLE
const uint SAMPLES = 4u;
layout(set = 0, binding = 0) uniform texture2DMS opaque;
layout(set = 0, binding = 1) uniform texture2DMS opaque_depth;
#else
const uint SAMPLES = 1u;
layout(set = 0, binding = 0) uniform texture2D opaque;
#endif
layout(location = 0) out vec4 radiance;

// Entries that are sorted at a time: longer lists are gone through once more for every so many.
const uint BATCH = 8u;

// In the place of a sample: the middle of the pixel, for what is alike at all samples.
const uint MIDDLE = 4u;

// Reversed depth of an entry at a sample.
float depth_at(uint entry, uint index) {
    float depth = entries[entry - 1u].depth;
#ifdef MULTISAMPLE
    if (index == MIDDLE) { return depth; }
    vec2 slope = unpackHalf2x16(entries[entry - 1u].slope);
    return max(depth + depth * dot(slope, SAMPLE_PLACES[index]), 0.0);
#else
    return depth;
#endif
}

// Whether an entry has that sample, and nothing opaque lies before it there.
bool is_seen(uint entry, float depth, uint index, float opaque_at) {
#ifdef MULTISAMPLE
    if (index == MIDDLE) { return true; }
    if ((entries[entry - 1u].red >> index & 1u) == 0u) { return false; }
    // The depth test found at least one sample to be seen, but not which. Half floats keep a slope within 2^-10 (some
    // devices cut), and of a single plane the differences that it was made of are within a few units of depth.
    vec2 slope = abs(unpackHalf2x16(entries[entry - 1u].slope));
    float rounding = depth * (0.00048828125 * (slope.x + slope.y) + 4.8e-7);
    return depth + rounding >= opaque_at;
#else
    return true;
#endif
}

// Whether a is over b: a strict order, so that the same entries give the same bytes in whatever order they came.
bool is_over(uint a, float depth_a, uint b, float depth_b) {
    if (depth_a != depth_b) { return depth_a > depth_b; }
    uint blue_a = entries[a - 1u].blue;
    uint blue_b = entries[b - 1u].blue;
    uint green_a = entries[a - 1u].green;
    uint green_b = entries[b - 1u].green;
    uint rank_a = (blue_a & 31u) << 5u | (green_a & 31u);
    uint rank_b = (blue_b & 31u) << 5u | (green_b & 31u);
    if (rank_a != rank_b) { return rank_a > rank_b; }
    if (blue_a != blue_b) { return blue_a > blue_b; }
    if (green_a != green_b) { return green_a > green_b; }
    uint red_a = entries[a - 1u].red;
    uint red_b = entries[b - 1u].red;
    return red_a != red_b ? red_a > red_b : a > b;
}

vec3 radiance_of(uint entry) {
    return vec3(transparency_radiance(entries[entry - 1u].red), transparency_radiance(entries[entry - 1u].green),
                transparency_radiance(entries[entry - 1u].blue));
}

vec3 transmittance_of(uint entry) {
    return vec3(transparency_transmittance(entries[entry - 1u].red), transparency_transmittance(entries[entry - 1u].green),
                transparency_transmittance(entries[entry - 1u].blue));
}

// Light and opacity behind a layer, seen through it. A picture has one opacity: the channels' mean.
vec4 through(vec4 behind, vec3 transmittance) {
    float mean = (transmittance.r + transmittance.g + transmittance.b) / 3.0;
    return vec4(behind.rgb * transmittance, 1.0 - (1.0 - behind.a) * mean);
}

// How far an entry's depth goes within its pixel: samples lie up to 3/8 from the middle.
vec2 depth_range(uint entry, float depth) {
    vec2 slope = abs(unpackHalf2x16(entries[entry - 1u].slope));
    float spread = depth * (0.376 * (slope.x + slope.y) + 4.8e-7);
    return vec2(depth - spread, depth + spread);
}

// `is_same` becomes false where samples may see layers that others do not, or in another order.
vec4 sorted(uint head, uint index, vec4 behind, float opaque_at, out bool is_same) {
    is_same = true;
    float nearest = opaque_at;
    vec4 seen = behind;
    uint last = 0u;
    float last_depth = 0.0;
    uint count = BATCH;
    while (count == BATCH) {
        // The farthest of those that are over the last one, farthest first.
        uint batch[BATCH];
        float depths[BATCH];
        count = 0u;
        for (uint entry = head; entry != 0u; entry = entries[entry - 1u].next) {
            float depth = depth_at(entry, index);
            if (!is_seen(entry, depth, index, opaque_at)) { continue; }
            if (last != 0u && !is_over(entry, depth, last, last_depth)) { continue; }
            uint place = count;
            while (place > 0u && is_over(batch[place - 1u], depths[place - 1u], entry, depth)) {
                if (place < BATCH) {
                    batch[place] = batch[place - 1u];
                    depths[place] = depths[place - 1u];
                }
                place -= 1u;
            }
            if (place < BATCH) {
                batch[place] = entry;
                depths[place] = depth;
                count = min(count + 1u, BATCH);
            }
        }
        for (uint place = 0u; place < count; ++place) {
            last = batch[place];
            last_depth = depths[place];
            if (index == MIDDLE) {
                vec2 range = depth_range(last, last_depth);
                is_same = is_same && range.x >= nearest && (entries[last - 1u].red & 15u) == 15u;
                nearest = range.y;
            }
            seen = through(seen, transmittance_of(last)) + vec4(radiance_of(last), 0.0);
        }
    }
    return seen;
}

// McGuire & Bavoil 2013, equation 5, with a transmittance a channel.
vec4 weighted(uint head, uint index, vec4 behind, float opaque_at) {
    vec3 sum = vec3(0.0);
    vec3 opacity_sum = vec3(0.0);
    vec3 transmittance = vec3(1.0);
    for (uint entry = head; entry != 0u; entry = entries[entry - 1u].next) {
        float depth = depth_at(entry, index);
        if (!is_seen(entry, depth, index, opaque_at)) { continue; }
        float weight = transparency_weight(depth);
        vec3 passed = transmittance_of(entry);
        sum += weight * radiance_of(entry);
        opacity_sum += weight * (1.0 - passed);
        transmittance *= passed;
    }
    // What is not opaque at all and still shines, as a highlight on clear glass, is added as it is.
    vec3 mean = (1.0 - transmittance) / max(opacity_sum, vec3(1e-5));
    return through(behind, transmittance) + vec4(sum * mean, 0.0);
}

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    uint head = heads[uint(place.y) * width + uint(place.x)];
#ifdef MULTISAMPLE
    // What blends nowhere is resolved already.
    if (head == 0u) { discard; }
#endif
    bool is_same;
#ifdef MULTISAMPLE
    vec4 behind[SAMPLES];
    float opaque_at[SAMPLES];
    vec4 mean = vec4(0.0);
    float nearest = 0.0;
    for (uint index = 0u; index < SAMPLES; ++index) {
        behind[index] = texelFetch(opaque, place, int(index));
        opaque_at[index] = texelFetch(opaque_depth, place, int(index)).r;
        mean += behind[index] / float(SAMPLES);
        nearest = max(nearest, opaque_at[index]);
    }
    if (!WEIGHTED) {
        // Layers are linear in what lies behind: where all samples see the same ones, once does for all.
        radiance = sorted(head, MIDDLE, mean, nearest, is_same);
        if (is_same) {
            radiance.rgb = min(radiance.rgb, vec3(RADIANCE_LIMIT));
            return;
        }
    }
    vec4 sum = vec4(0.0);
    for (uint index = 0u; index < SAMPLES; ++index) {
        sum += WEIGHTED ? weighted(head, index, behind[index], opaque_at[index])
                        : sorted(head, index, behind[index], opaque_at[index], is_same);
    }
    radiance = sum / float(SAMPLES);
#else
    vec4 behind = texelFetch(opaque, place, 0);
    radiance = WEIGHTED ? weighted(head, 0u, behind, 0.0) : sorted(head, 0u, behind, 0.0, is_same);
#endif
    radiance.rgb = min(radiance.rgb, vec3(RADIANCE_LIMIT));
}
