// Satin. Mirrored to Rust by build.rs.
#ifndef VAIR_SATIN_MATERIAL_GLSL
#define VAIR_SATIN_MATERIAL_GLSL
#include "standard_material.glsl"

struct SatinUniforms {
    vec3 specular_color;       // linear, of the narrow lobe
    float specular_strength;   // in [0, 30]
    vec3 secondary_color;      // linear, of the wide lobe
    float secondary_width;     // roughness of the wide lobe, in that of the narrow one, >= 1
    float anisotropy;          // in [-1, 1]
    float light_tint;          // share of the light's own colour, in [0, 1]
    float _reserved_0;
    float _reserved_1;
    TextureTransform specular_noise_transform;
};

#endif
