// Texels of a cube in a storage buffer: levels one after the other, the largest first, down to one texel a face; of each
// the faces in Vulkan's order, of each face the rows.
#ifndef VAIR_ENVIRONMENT_TEXELS_GLSL
#define VAIR_ENVIRONMENT_TEXELS_GLSL

uint cube_level_start(uint face_px, uint level) {
    uint start = 0u;
    for (uint above = 0u; above < level; ++above) {
        uint side = face_px >> above;
        start += 6u * side * side;
    }
    return start;
}

// Middle of a texel in [-1, 1].
vec2 cube_place(ivec2 texel, uint side) {
    return (vec2(texel) + 0.5) * (2.0 / float(side)) - 1.0;
}

#endif
