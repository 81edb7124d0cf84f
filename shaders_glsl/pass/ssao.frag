#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
// Share of the ambient light that what stands around a pixel lets through, by the horizons of a few slices.
#include "direction.glsl"
#include "horizon.glsl"
#include "ssao.glsl"

layout(location = 0) out float visibility;

const float PI = 3.14159265;

void main() {
    visibility = 1.0;
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    ivec2 size = textureSize(gbuffer_depth, 0);
    Standing here = standing_at(pixel);
    if (!here.is_there) { return; }
    vec3 normal = normal_at(pixel);
    bool is_parallel = draw.orthographic > 0.5;
    vec3 to_eye = is_parallel ? vec3(0.0, 0.0, 1.0) : direction_or(-here.position, vec3(0.0, 0.0, 1.0));
    mat3 around = direction_frame(to_eye);
    vec2 pixels_per_m = 0.5 * vec2(size) * draw.focal / (is_parallel ? 1.0 : max(-here.position.z, 1e-20));
    float radius_px = min(draw.radius_m * max(pixels_per_m.x, pixels_per_m.y), float(max(size.x, size.y)));

    // Sixteen turns and four offsets over each 4 x 4 pixels, which the blur takes together (Jimenez et al. 2016).
    float turn = float((((pixel.x + pixel.y) & 3) << 2) + (pixel.x & 3)) / 16.0;
    float offset = (float((pixel.y - pixel.x) & 3) + 0.5) / 4.0;
    float lost = 0.0;
    float whole = 0.0;
    for (uint index = 0u; index < draw.slices; ++index) {
        float azimuth = PI * (float(index) + turn) / float(draw.slices);
        vec3 along = cos(azimuth) * around[0] + sin(azimuth) * around[1];
        HorizonSlice slice = horizon_slice(along, to_eye, normal);
        // Where the slice cuts the picture; rows count downwards.
        vec2 way = (along.xy - to_eye.xy * (along.z / to_eye.z)) * pixels_per_m;
        way = way / max(length(way), 1e-20) * vec2(1.0, -1.0);
        for (int side = -1; side <= 1; side += 2) {
            float normal_angle = float(side) * slice.normal_angle;
            vec3 tangent = float(side) * slice.tangent;
            float highest = 0.5 * PI + normal_angle;
            float horizon = 0.0;
            for (uint index = 0u; index < draw.steps; ++index) {
                // Closer together near by, where a pixel means a large angle.
                float share = (float(index) + offset) / float(draw.steps);
                ivec2 at = pixel + ivec2(round(float(side) * way * (1.0 + radius_px * share * share)));
                if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) { break; }
                Standing there = standing_at(at);
                vec3 to_sample = there.position - here.position;
                float falloff = horizon_falloff(dot(to_sample, to_sample), draw.radius_m);
                if (!there.is_there || falloff <= 0.0) { continue; }
                float elevation = horizon_elevation(to_sample, normal, tangent, slice.weight, highest);
                if (elevation > horizon) {
                    float rise = horizon_arc(elevation, normal_angle) - horizon_arc(horizon, normal_angle);
                    lost += slice.weight * falloff * rise;
                    horizon = elevation;
                }
            }
            whole += slice.weight * horizon_arc(highest, normal_angle);
        }
    }
    if (whole > 0.0) { visibility = clamp(1.0 - lost / whole, 0.0, 1.0); }
}
