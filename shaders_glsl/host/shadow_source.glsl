// One map of the shadow atlas. Mirrored to Rust by build.rs.
#ifndef VAIR_SHADOW_SOURCE_GLSL
#define VAIR_SHADOW_SOURCE_GLSL

struct ShadowSource {
    mat4 clip_from_world;      // reversed Z, Y up; w is 1 for parallel rays, otherwise metres along the axis
    vec2 origin_px;            // of the map's tile in the atlas
    float size_px;             // of its sides
    float texel_m;             // width of a texel times 1 / w
};

#endif
