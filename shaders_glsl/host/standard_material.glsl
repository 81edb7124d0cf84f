// The standard material. Mirrored to Rust by build.rs.
#ifndef VAIR_STANDARD_MATERIAL_GLSL
#define VAIR_STANDARD_MATERIAL_GLSL

// One texture: which UV set, and KHR_texture_transform as two rows of a 2x3 matrix.
struct TextureTransform {
    vec3 row_u;                // u' = dot(row_u, (u, v, 1))
    uint uv_set;               // 0 or 1
    vec3 row_v;                // v' = dot(row_v, (u, v, 1))
    float _reserved;
};

struct StandardUniforms {
    vec4 base_color;           // linear RGBA factor
    vec3 emissive;             // linear RGB factor, >= 0
    float alpha_cutoff;        // shown where alpha >= cutoff (mask mode)
    float metallic;            // factor in [0, 1]
    float roughness;           // perceptual roughness factor in [0, 1]
    float normal_scale;        // of the normal map's x and y
    float occlusion_strength;  // in [0, 1]
    float detail_normal_scale; // of the detail normal map's x and y
    float _reserved_0;
    float _reserved_1;
    float _reserved_2;
    TextureTransform base_color_transform;
    TextureTransform metallic_roughness_transform;
    TextureTransform normal_transform;
    TextureTransform occlusion_transform;
    TextureTransform emissive_transform;
    TextureTransform detail_albedo_transform;
    TextureTransform detail_normal_transform;
};

#endif
