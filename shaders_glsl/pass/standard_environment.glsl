// The environment on the lobes of the standard surface: what standard, laser and glint share. After surface.glsl.
#ifndef VAIR_STANDARD_ENVIRONMENT_GLSL
#define VAIR_STANDARD_ENVIRONMENT_GLSL
#include "standard.glsl"
#include "environment_light.glsl"

vec3 standard_environment(SurfaceFragment f, StandardSurface surface) {
    vec3 mirrored = mirrored_light(f, f.world_from_tangent, f.eye_in_tangent, surface.roughness, surface.f0);
    return standard_ambient(surface, mirrored, diffuse_light(f, surface.diffuse));
}

#endif
