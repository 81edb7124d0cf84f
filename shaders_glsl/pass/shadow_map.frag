#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
// A surface that casts a shadow: whole, by its mask, or by its opacity.
#define UNLIT
#define SHADOW
#include "surface.glsl"
#include "shadow_output.glsl"

void main() {
    vec4 color = surface_color();
    int mask = surface_mask(color.a);
    uint mode = ALPHA_MODE;
    if (mode == 2u) { shadow_write(vec3(1.0 - surface_opacity(color.a))); }
    surface_cover(mask);
}
