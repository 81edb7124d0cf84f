// What the G-buffer holds of the nearest surface beside its depth: normal and motion.
#ifndef VAIR_GBUFFER_GLSL
#define VAIR_GBUFFER_GLSL
#include "octahedral.glsl"

#ifdef MOTION
#include "previous_frame.glsl"
layout(set = 0, binding = 16, std140) uniform PreviousFrameBlock { PreviousFrame previous_frame; };
layout(location = 8) in vec3 place_in_clip;
layout(location = 9) in vec3 previous_place_in_clip;
#endif

layout(constant_id = 17) const bool MOTION_ALONE = false; // the target has room for motion alone

// xy: unit normal in world space, octahedral; zw: pixels from the previous frame's place to this one's. Motion alone: xy.
vec4 gbuffer_texel(vec3 normal) {
    vec2 motion = vec2(0.0);
#ifdef MOTION
    // What was behind the eye has no place on the picture to come from.
    if (previous_place_in_clip.z > 0.0) {
        motion = place_in_clip.xy / place_in_clip.z - previous_place_in_clip.xy / previous_place_in_clip.z;
        motion *= previous_frame.pixels_from_clip;
    }
#endif
    vec2 octahedral = octahedral_from_direction(normal);
    return MOTION_ALONE ? vec4(motion, octahedral) : vec4(octahedral, motion);
}

#endif
