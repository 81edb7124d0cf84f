#version 460
#extension GL_GOOGLE_include_directive : require
// Depth, normal and motion of surfaces, one sample a pixel. Maps that bend the normal are left out: the screen's
// occlusion needs the surface that the depth is of. A surface that blends counts where it covers more than half.
#include "surface.glsl"
#include "gbuffer.glsl"

void main() {
    uint mode = ALPHA_MODE;
    float alpha = surface_color().a;
    bool covers = mode == 2u ? alpha > 0.5 : surface_mask(alpha) != 0;
#ifdef UNLIT
    vec3 normal = direction_or(cross(dFdx(position_in_world), dFdy(position_in_world)), frame.view_in_world);
    normal = dot(normal, frame.view_in_world) < 0.0 ? -normal : normal;
#else
    vec3 normal = direction_or(normal_in_world, frame.view_in_world);
    if (DOUBLE_SIDED && !gl_FrontFacing) { normal = -normal; }
#endif
    // No light here: the target is the G-buffer's.
    radiance = gbuffer_texel(normal);
    if (!covers) { discard; }
}
