// The further lobes of glTF's materials. Mirrored to Rust by build.rs.
#ifndef VAIR_LAYERED_MATERIAL_GLSL
#define VAIR_LAYERED_MATERIAL_GLSL
#include "standard_material.glsl"

struct LayeredUniforms {
    vec3 specular_color;            // factor on the reflectance at normal incidence, linear, >= 0
    float specular;                 // strength of a dielectric's reflection, [0, 1]
    vec3 sheen_color;               // linear
    float sheen_roughness;          // perceptual
    vec3 diffuse_transmission_color; // linear
    float diffuse_transmission;     // share of the scattered light, [0, 1]
    vec2 anisotropy_direction;      // unit, of the streak, from the tangent
    float anisotropy;               // [0, 1]
    float ior;                      // of the base; 0 reflects everything
    float iridescence;              // share of the film, [0, 1]
    float iridescence_ior;          // of the film
    float iridescence_thickness_min; // nm, where the map is 0
    float iridescence_thickness_max; // nm, where it is 1
    float clearcoat;                // share of the varnish, [0, 1]
    float clearcoat_roughness;      // perceptual
    float clearcoat_normal_scale;   // of its normal map's x and y
    float transmission;             // share of what goes straight through, [0, 1]
    vec3 attenuation_color;         // linear, of the body after its distance of attenuation
    float thickness_over_distance;  // ways of that distance in the body's thickness, a metre a unit of the mesh
    TextureTransform specular_transform;
    TextureTransform specular_color_transform;
    TextureTransform anisotropy_transform;
    TextureTransform iridescence_transform;
    TextureTransform iridescence_thickness_transform;
    TextureTransform diffuse_transmission_transform;
    TextureTransform diffuse_transmission_color_transform;
    TextureTransform transmission_transform;
    TextureTransform thickness_transform;
    TextureTransform sheen_color_transform;
    TextureTransform sheen_roughness_transform;
    TextureTransform clearcoat_transform;
    TextureTransform clearcoat_roughness_transform;
    TextureTransform clearcoat_normal_transform;
};

#endif
