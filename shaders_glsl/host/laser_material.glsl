// Laser cloth. Mirrored to Rust by build.rs.
#ifndef VAIR_LASER_MATERIAL_GLSL
#define VAIR_LASER_MATERIAL_GLSL
#include "standard_material.glsl"

struct LaserUniforms {
    float saturation;             // in [0, 1]
    float brightness;             // in [0, 1]
    float hue_span;               // turns
    float hue_offset;             // turns
    vec2 direction;               // unit, in the tangent plane
    float film_thickness_nm;      // where the map says 1
    float film_thickness_min_nm;  // where it says 0
    float film_ior;
    float base_f0;                // of the dielectric under the film
    float _reserved_0;
    float _reserved_1;
    TextureTransform offset_transform;
    TextureTransform hue_ramp_transform;
    TextureTransform direction_transform;
    TextureTransform film_thickness_transform;
};

#endif
