// The threads of gauze: parameters, maps, and how much yarn lies along a direction. For what is seen and what casts shadows.
#ifndef VAIR_GAUZE_THREADS_GLSL
#define VAIR_GAUZE_THREADS_GLSL
#include "gauze_material.glsl"
#include "satin.glsl"
#include "gauze.glsl"

layout(constant_id = 20) const bool HAS_MESH_MAP = false;
layout(constant_id = 21) const bool HAS_SPECULAR_NOISE_MAP = false;
layout(constant_id = 22) const bool HAS_THREAD_PATTERN_MAP = false;
layout(constant_id = 23) const bool CROSSED = false;   // a grid of round threads, otherwise matted yarn
layout(constant_id = 24) const bool HIGHLIGHT = false; // it is not black
layout(constant_id = 25) const bool CLASSIC = false;

layout(set = 1, binding = 20, std140) uniform GauzeBlock { GauzeUniforms gauze; };
#ifdef MAPS
layout(set = 1, binding = 21) uniform texture2D mesh_map;
layout(set = 1, binding = 22) uniform sampler mesh_sampler;
layout(set = 1, binding = 23) uniform texture2D specular_noise_map;
layout(set = 1, binding = 24) uniform sampler specular_noise_sampler;
layout(set = 1, binding = 25) uniform texture2D thread_pattern_map;
layout(set = 1, binding = 26) uniform sampler thread_pattern_sampler;
#endif

// What the maps say.
struct Threads {
    float mesh;   // share of threads, the rest are holes
    float noise;  // local strength of the highlight
    float turned; // share of the threads that lie the other way
};

Threads threads() {
    Threads t;
    t.mesh = 1.0;
    t.noise = 1.0;
    t.turned = 0.0;
#ifdef MAPS
    if (HAS_MESH_MAP) {
        vec2 uv = uv_transformed(gauze.mesh_transform, uv_sets.xy, uv_sets.zw);
        t.mesh = texture(sampler2D(mesh_map, mesh_sampler), uv).r;
    }
    if (HAS_SPECULAR_NOISE_MAP) {
        vec2 uv = uv_transformed(gauze.specular_noise_transform, uv_sets.xy, uv_sets.zw);
        float texel = texture(sampler2D(specular_noise_map, specular_noise_sampler), uv).r;
        t.noise = CLASSIC ? texel : satin_noise(texel);
    }
    if (HAS_THREAD_PATTERN_MAP) {
        vec2 uv = uv_transformed(gauze.thread_pattern_transform, uv_sets.xy, uv_sets.zw);
        float texel = texture(sampler2D(thread_pattern_map, thread_pattern_sampler), uv).r;
        // Wide enough that a pattern too fine for the pixel, seen as its mean, becomes a share of both.
        t.turned = clamp((texel - 0.75 * gauze.thread_threshold) * 4.0, 0.0, 1.0);
    }
#endif
    return t;
}

// Into the frame of the threads that lie the other way.
vec3 turned(vec3 w) {
    vec2 turn = gauze.thread_turn;
    return vec3(turn.x * w.x + turn.y * w.y, turn.x * w.y - turn.y * w.x, w.z);
}

float depth_along(vec3 w) {
    return CROSSED ? gauze_crossed_depth(gauze.weave, w) : gauze_matted_depth(gauze.weave, w.z);
}

#endif
