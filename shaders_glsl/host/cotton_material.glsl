// Cotton. Mirrored to Rust by build.rs.
#ifndef VAIR_COTTON_MATERIAL_GLSL
#define VAIR_COTTON_MATERIAL_GLSL
#include "standard_material.glsl"

struct CottonUniforms {
    vec3 sheen_color;          // linear RGB factor, in [0, 1]
    float sheen_roughness;     // perceptual roughness factor in [0, 1]
    vec2 environment_turn;     // cosine and sine of the environment's own rotation around +Y
    float _reserved_0;
    float _reserved_1;
    TextureTransform sheen_color_transform;
    TextureTransform sheen_transform;
    TextureTransform sheen_roughness_transform;
};

#endif
