#version 460
#extension GL_GOOGLE_include_directive : require
// Standard and unlit surfaces.
#include "frame.glsl"
#include "object.glsl"
#include "direction.glsl"
#ifdef MOTION
#include "motion.glsl"
#endif

layout(set = 0, binding = 0, std140) uniform FrameBlock { FrameUniforms frame; };
layout(set = 2, binding = 0, std430) readonly buffer ObjectList { ObjectUniforms objects[]; };
layout(push_constant) uniform DrawBlock { ObjectDraw draw; };

layout(location = 0) in vec3 position;
layout(location = 0) out vec3 position_in_world;
#ifndef UNLIT
layout(location = 1) in vec3 normal;
layout(location = 1) out vec3 normal_in_world;
#endif
#ifdef UV
layout(location = 2) in vec2 uv_0;
layout(location = 3) in vec2 uv_1;
layout(location = 2) out vec4 uv_sets;
#endif
#ifdef TANGENT
layout(location = 4) in vec4 tangent;
layout(location = 3) out vec4 tangent_in_world;
#endif
#ifdef COLOR
layout(location = 5) in vec4 color;
layout(location = 4) out vec4 vertex_color;
#endif
#ifdef REST
layout(location = 6) in vec3 rest_position;
layout(location = 7) in vec3 rest_normal;
layout(location = 5) out vec3 rest_position_m;
layout(location = 6) out vec3 normal_in_rest;
#endif

void main() {
    mat4 world_from_object = objects[draw.object_index].world_from_object;
    vec4 world = world_from_object * vec4(position, 1.0);
    position_in_world = world.xyz;
    gl_Position = frame.clip_from_world * world;
    gl_PointSize = 1.0;
#ifdef MOTION
    motion_write(gl_Position, (previous_objects[draw.previous_object_index].world_from_object * vec4(previous_position, 1.0)).xyz);
#endif
#ifndef UNLIT
    // Unit length before interpolation, as MikkTSpace wants it: an object's scale must not tilt mapped normals.
    normal_in_world = direction_or(mat3(objects[draw.object_index].normal_from_object) * normal, vec3(0.0));
#endif
#ifdef UV
    uv_sets = vec4(uv_0, uv_1);
#endif
#ifdef TANGENT
    float side = tangent.w * objects[draw.object_index].handedness;
    tangent_in_world = vec4(direction_or(mat3(world_from_object) * tangent.xyz, vec3(0.0)), side);
#endif
#ifdef COLOR
    vertex_color = color;
#endif
#ifdef REST
    rest_position_m = rest_position * objects[draw.object_index].world_from_rest;
    normal_in_rest = rest_normal;
#endif
}
