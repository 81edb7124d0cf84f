// Where the picture was before. Mirrored to Rust by build.rs.
#ifndef VAIR_PREVIOUS_FRAME_GLSL
#define VAIR_PREVIOUS_FRAME_GLSL

struct PreviousFrame {
    mat4 clip_from_world;
    vec2 pixels_from_clip;     // half the picture's size; y negative, as rows count downwards
    float _reserved_0;
    float _reserved_1;
};

#endif
