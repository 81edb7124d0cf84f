// Velvet. Mirrored to Rust by build.rs.
#ifndef VAIR_VELVET_MATERIAL_GLSL
#define VAIR_VELVET_MATERIAL_GLSL

struct VelvetUniforms {
    vec3 scatter_color;        // linear RGB, in [0, 1]
    float scatter_roughness;   // perceptual roughness of the scattering fibres, in [0, 1]
    float scatter_scale;       // width of the classic rim, in [0, 1]
    float _reserved_0;
    float _reserved_1;
    float _reserved_2;
};

#endif
