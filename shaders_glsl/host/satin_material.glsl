// Satin. Mirrored to Rust by build.rs.
#ifndef VAIR_SATIN_MATERIAL_GLSL
#define VAIR_SATIN_MATERIAL_GLSL
#include "standard_material.glsl"

struct SatinUniforms {
    float anisotropy;          // in [-1, 1]
    float _reserved_0;
    float _reserved_1;
    float _reserved_2;
    TextureTransform specular_noise_transform;
};

#endif
