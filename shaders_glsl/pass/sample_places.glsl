// Where the four samples lie in a pixel, from its middle (Vulkan 1.3, "Standard sample locations").
#ifndef VAIR_SAMPLE_PLACES_GLSL
#define VAIR_SAMPLE_PLACES_GLSL

const vec2 SAMPLE_PLACES[4] = vec2[](vec2(-0.125, -0.375), vec2(0.375, -0.125), vec2(-0.375, 0.125), vec2(0.125, 0.375));

#endif
