// Opacity to sample coverage. Done in the shader rather than by alpha-to-coverage: the pattern is then the
// same on every driver, and the alpha channel keeps the coverage of the picture. Needs hash.glsl.

// A number in [0, 1) that is fixed to the surface, one a cell about as wide as a pixel: an opacity that is met where it
// exceeds this keeps its mean, and its grain moves with the surface instead of the screen.
// Source: Wyman & McGuire 2017, "Hashed Alpha Testing", with an integer hash for theirs of sines.
float coverage_grain(vec3 position, float pixel_size) {
    float cell_size = exp2(ceil(log2(max(pixel_size, 1e-30))));
    return hash_cell(ivec3(floor(position / cell_size))).z;
}

// Bits of the samples that an opacity in [0, 1] covers. `threshold` in [0, 1) rounds: one half to the nearest count,
// random numbers so that the mean is kept. One sample: covered where the opacity reaches the threshold.
int coverage_mask(float opacity, uint sample_count, float threshold, uvec2 pixel) {
    if (sample_count == 1u) {
        return opacity > 0.0 && opacity >= threshold ? 1 : 0;
    }
    uint count = uint(floor(clamp(opacity, 0.0, 1.0) * 4.0 + threshold));
    // Larger counts hold the smaller ones: strands stand above their own roots. Opposite corners come first.
    uint even = (pixel.x + pixel.y) & 1u;
    if (count == 0u) { return 0; }
    if (count >= 4u) { return 15; }
    if (count == 1u) { return even == 0u ? 1 : 2; }
    if (count == 2u) { return even == 0u ? 9 : 6; }
    return even == 0u ? 13 : 14;
}
