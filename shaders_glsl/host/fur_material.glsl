// The fur material of one object. Mirrored to Rust by build.rs.
#ifndef VAIR_FUR_MATERIAL_GLSL
#define VAIR_FUR_MATERIAL_GLSL
#include "standard_material.glsl"

struct FurUniforms {
    vec3 base_color;           // linear RGB factor
    float _reserved_3;
    vec3 root_color;           // linear RGB factor at the skin
    float length_m;            // strand length in world units
    vec3 tip_color;            // linear RGB factor at the tip
    float strand_spacing;      // mean spacing of procedural strands, in units of the rest pose
    vec3 spot_color;           // linear RGB the spot map blends to
    float strand_radius;       // root radius of procedural strands over their spacing, in (0, 0.5]
    vec3 force;                // unit direction times strength in [0, 1], world space
    float color_variation;     // brightness variation between strands, in [0, 1]
    vec2 comb;                 // lie of the fur in the tangent plane, length in [0, 1]
    float cutoff_start;        // threshold at the root
    float cutoff_end;          // threshold at the tip
    float edge_fade;           // fades strands at grazing angles, in [0, 1]
    float tip_fade;            // transparency towards the tip, in [0, 1]
    float taper;               // how fast strands thin beyond their shape, >= 0
    float occlusion;           // 0 none .. 1 darkest root
    float specular;            // strength of the strand highlights, in [0, 1]
    float roughness;           // longitudinal roughness of a strand, in [0, 1]
    float height_strength;     // how much the height map shortens strands, in [0, 1]
    float clump;               // strands gather towards their lock's middle, in [0, 1]
    float curl;                // radius of a coil at the tip, in strand spacings, in [0, 1]
    float projection_scale;    // UV units per rest-pose unit where the mesh has no UVs
    uint layers;               // number of shells
    float transmission;        // strength of the transmitted lobe, in [0, 1]
    float _reserved_1;
    float _reserved_2;
    TextureTransform distribution_transform;
    TextureTransform base_color_transform;
    TextureTransform height_transform;
    TextureTransform spot_transform;
    TextureTransform comb_transform;
};

#endif
