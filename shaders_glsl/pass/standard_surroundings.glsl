// The surroundings on the lobes of the standard surface: what standard, laser and glint share. After surface.glsl.
#ifndef VAIR_STANDARD_SURROUNDINGS_GLSL
#define VAIR_STANDARD_SURROUNDINGS_GLSL
#include "standard.glsl"
#include "surroundings.glsl"

vec3 standard_surroundings(SurfaceFragment f, StandardSurface surface) {
    vec3 mirrored = mirrored_light(f, f.world_from_tangent, f.eye_in_tangent, surface.roughness, surface.f0);
    return standard_ambient(surface, mirrored, diffuse_light(f, surface.diffuse));
}

#endif
