// Gauze. Mirrored to Rust by build.rs.
#ifndef VAIR_GAUZE_MATERIAL_GLSL
#define VAIR_GAUZE_MATERIAL_GLSL
#include "standard_material.glsl"

struct GauzeUniforms {
    vec3 specular;             // 0.04 times the strengths and the colour of the highlight, linear, may exceed 1
    float anisotropy;          // in [-1, 1]
    vec2 thread_turn;          // cosine and sine of the angle between crossing threads
    float thread_threshold;    // in [0, 1]
    float cover;               // share of the weave that transmittance leaves, in (0, 1]
    float weave;               // depth of matted yarn from the front; cover of crossed threads; exponent of classic gauze
    float mean_opacity;        // cosine-weighted mean over all directions
    float _reserved_0;
    float _reserved_1;
    TextureTransform mesh_transform;
    TextureTransform specular_noise_transform;
    TextureTransform thread_pattern_transform;
};

#endif
