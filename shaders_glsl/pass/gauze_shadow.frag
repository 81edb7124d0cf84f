#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
// Gauze that casts a shadow: light passes between its threads, and what they scatter forwards goes on in their colour.
#define UNLIT
#define SHADOW
#include "surface.glsl"
#include "gauze_threads.glsl"
#include "shadow_output.glsl"

layout(location = 1) in vec3 normal_in_world;

void main() {
    vec4 color = surface_color();
    int mask = surface_mask(color.a);
    vec3 normal = direction_or(normal_in_world, frame.view_in_world);
    vec3 to_light = frame.orthographic > 0.5 ? frame.view_in_world : direction_or(frame.eye_in_world - position_in_world, normal);
    vec3 l = to_light * direction_frame_along(normal, tangent_in_world.xyz, tangent_in_world.w);
    l.z = abs(l.z);
    float depth = depth_along(l);
    float opacity = CLASSIC ? gauze_classic_opacity(gauze.weave, l.z) : gauze_opacity(depth);
    vec3 forwards = (CLASSIC ? 0.0 : gauze_through(depth, depth) * (1.0 - material.metallic)) * clamp(color.rgb, 0.0, 1.0);
    float met = opacity * threads().mesh * gauze.cover * surface_opacity(color.a);
    shadow_write(mask == 0 ? vec3(1.0) : 1.0 - met * (1.0 - forwards));
}
