// Opacity to sample coverage. Done in the shader rather than by alpha-to-coverage: the pattern is then the
// same on every driver, and the alpha channel keeps the coverage of the picture.

// A threshold in [0, 1) for each pixel, spread so evenly that neighbours together keep the mean and no pattern stands
// out. Source: Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare", interleaved gradient
// noise.
float coverage_dither(uvec2 pixel) {
    return fract(52.9829189 * fract(dot(vec2(pixel), vec2(0.06711056, 0.00583715))));
}

// Bits of the samples that an opacity in [0, 1] covers. One sample: a plain cut at one half.
int coverage_mask(float opacity, uint sample_count, uvec2 pixel) {
    if (sample_count == 1u) {
        return opacity >= 0.5 ? 1 : 0;
    }
    float wanted = clamp(opacity, 0.0, 1.0) * float(sample_count);
    uint count = uint(floor(wanted + coverage_dither(pixel)));
    // Opposite corners first, so that half coverage is no stripe.
    uint order = (pixel.x + pixel.y) & 1u;
    if (count == 0u) { return 0; }
    if (count >= 4u) { return 15; }
    if (count == 1u) { return order == 0u ? 1 : 8; }
    if (count == 2u) { return order == 0u ? 9 : 6; }
    return order == 0u ? 13 : 14;
}
