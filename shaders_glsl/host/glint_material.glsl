// Glint. Mirrored to Rust by build.rs.
#ifndef VAIR_GLINT_MATERIAL_GLSL
#define VAIR_GLINT_MATERIAL_GLSL
#include "standard_material.glsl"

struct GlintUniforms {
    vec3 flake_color;          // linear reflectance of the metal at normal incidence
    float coverage;            // mean share of the cloth that flakes cover, in [0, 0.9]
    float intensity;           // share of its light that a flake gives back, in [0, 1]
    float flake_roughness;     // perceptual, of the lobe that all flakes make up
    float cells_per_metre;     // rhombi of the flakes' lattice along their edges
    float radius;              // as in GlintFlakes
    float jitter;
    float lobe;
    float variation;
    uint fineness;
    TextureTransform mask_transform;
};

#endif
