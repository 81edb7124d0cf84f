// Opacity to sample coverage. Done in the shader rather than by alpha-to-coverage: the pattern is then the
// same on every driver, and the alpha channel keeps the coverage of the picture.
#ifndef VAIR_COVERAGE_GLSL
#define VAIR_COVERAGE_GLSL
#include "hash.glsl"

// Two numbers in [0, 1) that are fixed to the surface, one pair a cell about as wide as a pixel: an opacity that is met
// where it exceeds the first keeps its mean, and its grain moves with the surface instead of the screen. The second
// chooses samples. Layers with different numbers are independent.
// Source: Wyman & McGuire 2017, "Hashed Alpha Testing", with an integer hash for theirs of sines.
vec2 coverage_grain(vec3 position, float pixel_size, uint layer) {
    float cell_size = exp2(ceil(log2(max(pixel_size, 1e-30))));
    return hash_cell(ivec3(floor(position / cell_size)) + ivec3(int(layer) * 7919)).zy;
}

// Bits of the samples that an opacity in [0, 1] covers. `threshold` in [0, 1) rounds: one half to the nearest count,
// random numbers so that the mean is kept. `order` in [0, 1) chooses which samples come first. Equal orders nest, as the
// layers of one strand do; different ones add up, as strands behind each other do. One sample: covered where the opacity
// reaches the threshold.
int coverage_mask(float opacity, uint sample_count, float threshold, float order) {
    if (sample_count == 1u) {
        return opacity > 0.0 && opacity >= threshold ? 1 : 0;
    }
    uint count = min(uint(floor(clamp(opacity, 0.0, 1.0) * 4.0 + threshold)), 4u);
    // The first `count` of the samples 0, 3, 1, 2 (opposite corners first), turned by the order. Four bits a count.
    uint first = uint(order * 4.0) & 3u;
    uint masks = first == 0u ? 0xfb910u : first == 1u ? 0xfd980u : first == 2u ? 0xfe620u : 0xf7640u;
    return int((masks >> (count * 4u)) & 15u);
}

#endif
