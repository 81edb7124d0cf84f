// Where a vertex is on the picture and where it was in the previous frame; for vertex shaders with MOTION.
#ifndef VAIR_MOTION_GLSL
#define VAIR_MOTION_GLSL
#include "object.glsl"
#include "previous_frame.glsl"

layout(set = 0, binding = 16, std140) uniform PreviousFrameBlock { PreviousFrame previous_frame; };
layout(set = 2, binding = 1, std430) readonly buffer PreviousObjectList { ObjectUniforms previous_objects[]; };

layout(location = 9) in vec3 previous_position;

// x, y and w of clip space: these, not their quotients, are linear over a triangle.
layout(location = 8) out vec3 place_in_clip;
layout(location = 9) out vec3 previous_place_in_clip;

void motion_write(vec4 now_in_clip, vec3 previous_in_world) {
    place_in_clip = now_in_clip.xyw;
    previous_place_in_clip = (previous_frame.clip_from_world * vec4(previous_in_world, 1.0)).xyw;
}

#endif
