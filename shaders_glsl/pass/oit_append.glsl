// Puts a fragment that blends into its pixel's list instead of over what was drawn before it. Only in LIST permutations.
#ifndef VAIR_OIT_APPEND_GLSL
#define VAIR_OIT_APPEND_GLSL
#include "oit_list.glsl"
#include "transparency.glsl"

// A shader that writes memory runs before the depth test otherwise, and would list what is hidden.
layout(early_fragment_tests) in;

// Highest rank that an entry keeps.
const uint MAX_RANK = 1023u;

// What depth changes by to the next pixels, over itself. Call it where all neighbours still run.
vec2 list_slope() {
    return vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z)) / max(gl_FragCoord.z, 1e-30);
}

// What goes to the colour target: nothing, or all of it where no entry is left. Premultiplied radiance; of what lies at
// one depth, the higher rank is over the others.
vec4 list_append(vec3 radiance, vec3 transmittance, vec2 slope, uint samples, uint rank) {
    radiance = min(radiance, vec3(RADIANCE_LIMIT));
    if (samples == 0u || (radiance == vec3(0.0) && transmittance == vec3(1.0))) { return vec4(0.0); }
    uint index = atomicAdd(fragment_count, 1u);
    if (index >= capacity) { return vec4(radiance, 1.0 - (transmittance.r + transmittance.g + transmittance.b) / 3.0); }
    uint pixel = uint(gl_FragCoord.y) * width + uint(gl_FragCoord.x);
    uint kept = min(rank, MAX_RANK);
    entries[index].depth = gl_FragCoord.z;
    entries[index].slope = packHalf2x16(clamp(slope, -1e4, 1e4));
    entries[index].red = transparency_packed(radiance.r, transmittance.r, samples);
    entries[index].green = transparency_packed(radiance.g, transmittance.g, kept & 31u);
    entries[index].blue = transparency_packed(radiance.b, transmittance.b, kept >> 5u);
    entries[index].next = atomicExchange(heads[pixel], index + 1u);
    return vec4(0.0);
}

#endif
