// What the guide holds of the nearest surface beside its depth: normal and motion.
#ifndef VAIR_GUIDE_GLSL
#define VAIR_GUIDE_GLSL
#include "octahedral.glsl"

#ifdef MOTION
#include "previous_frame.glsl"
layout(set = 0, binding = 16, std140) uniform PreviousFrameBlock { PreviousFrame previous_frame; };
layout(location = 8) in vec3 place_in_clip;
layout(location = 9) in vec3 previous_place_in_clip;
#endif

// xy: unit normal in world space, octahedral; zw: pixels from the previous frame's place to this one's.
vec4 guide_texel(vec3 normal) {
    vec2 motion = vec2(0.0);
#ifdef MOTION
    // What was behind the eye has no place on the picture to come from.
    if (previous_place_in_clip.z > 0.0) {
        motion = place_in_clip.xy / place_in_clip.z - previous_place_in_clip.xy / previous_place_in_clip.z;
        motion *= previous_frame.pixels_from_clip;
    }
#endif
    return vec4(octahedral_from_direction(normal), motion);
}

#endif
