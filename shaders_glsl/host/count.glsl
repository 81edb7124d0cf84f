// Counts fragments where they would be shaded. Only in COUNT permutations; the host sums what stands here. Mirrored to
// Rust by build.rs.
#ifndef VAIR_COUNT_GLSL
#define VAIR_COUNT_GLSL
#include "sample_places.glsl"

// Fragments of one row of pixels.
struct RowCounts {
    uint rasterized;           // fragment shader invocations if nothing were hidden
    uint shaded;               // those that early depth tests let through
    uint covered_pixels;       // pixels where a shaded fragment also survived the coverage
};

// One pass. A row's sums fit in 32 bits for up to 2^32 / width fragments a pixel, a million at 4096 pixels.
layout(set = 3, binding = 0, std430) buffer FragmentCounts {
    uint pass_number;          // from 1
    uint width;                // pixels
    RowCounts rows[];
};
// All passes, for each pixel: the nearest depth of each sample so far, as bits, then the last pass that covered it.
layout(set = 3, binding = 1, std430) buffer FragmentPixels { uint pixels[]; };

// Counts this fragment, of which `coverage` (bits of the samples) survives. A fragment shader that writes memory runs
// before the depth test, so the test that stands before the ordinary shader is done here: depth is reversed and not
// negative, and as bits it orders as it does as a number. Call it where all neighbours still run.
void count_fragment(uint coverage, uint sample_count, bool writes_depth) {
    vec2 depth_slope = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z));
    uint row = uint(gl_FragCoord.y);
    uint first = (row * width + uint(gl_FragCoord.x)) * (sample_count + 1u);
    uint reached = uint(gl_SampleMaskIn[0]);
    uint passing = 0u;
    for (uint index = 0u; index < sample_count; ++index) {
        if ((reached >> index & 1u) == 0u) { continue; }
        float depth = gl_FragCoord.z + (sample_count == 1u ? 0.0 : dot(depth_slope, SAMPLE_PLACES[index]));
        // Minus zero would be a large number of bits.
        uint bits = depth > 0.0 ? floatBitsToUint(depth) : 0u;
        bool writes = writes_depth && (coverage >> index & 1u) != 0u;
        if (bits >= atomicMax(pixels[first + index], writes ? bits : 0u)) { passing |= 1u << index; }
    }
    atomicAdd(rows[row].rasterized, 1u);
    if (passing == 0u) { return; }
    atomicAdd(rows[row].shaded, 1u);
    if ((passing & coverage) == 0u) { return; }
    if (atomicExchange(pixels[first + sample_count], pass_number) != pass_number) {
        atomicAdd(rows[row].covered_pixels, 1u);
    }
}

#endif
