#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
// The mean of each 4 x 4 pixels' slices, of those that lie on the same surface.
#include "ssao.glsl"

layout(set = 0, binding = 2) uniform texture2D occlusion;
layout(location = 0) out float visibility;

// Off the tangent plane by this share of the radius, a pixel belongs to another surface.
const float REACH = 0.1;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(gbuffer_depth, 0) - 1;
    Standing here = standing_at(pixel);
    visibility = 1.0;
    if (!here.is_there) { return; }
    vec3 normal = normal_at(pixel);
    float sum = 0.0;
    float weights = 0.0;
    for (int index = 0; index < 16; ++index) {
        ivec2 at = clamp(pixel + ivec2(index & 3, index >> 2) - 2, ivec2(0), last);
        Standing there = standing_at(at);
        float off_plane = abs(dot(there.position - here.position, normal)) / (REACH * draw.radius_m);
        float weight = there.is_there ? max(1.0 - off_plane, 0.0) * max(dot(normal, normal_at(at)), 0.0) : 0.0;
        sum += weight * texelFetch(occlusion, at, 0).r;
        weights += weight;
    }
    visibility = weights > 0.0 ? sum / weights : texelFetch(occlusion, pixel, 0).r;
}
