// What hides lights: the shadow maps, read. Included by lighting.glsl where something is occluded.
#ifndef VAIR_SHADOW_MAPS_GLSL
#define VAIR_SHADOW_MAPS_GLSL
#include "shadow.glsl"
#include "shadow_source.glsl"

layout(constant_id = 96) const uint SHADOW_FILTER_PX = 2;            // radius of the filter, texels
layout(constant_id = 97) const bool HAS_TRANSLUCENT_SHADOWS = false; // something lets light through in part

layout(set = 0, binding = 6, std430) readonly buffer ShadowList { ShadowSource shadows[]; };
layout(set = 0, binding = 7) uniform texture2D shadow_map;          // nearest opaque surface
layout(set = 0, binding = 8) uniform texture2D shadow_front_map;    // first translucent surface, 0 for none
layout(set = 0, binding = 9) uniform texture2D shadow_back_map;     // last one
layout(set = 0, binding = 10) uniform texture2D shadow_layer_map;   // optical depth up to four knots between them
layout(set = 0, binding = 11) uniform texture2D shadow_total_map;   // of all: by channel, and the mean
layout(set = 0, binding = 14) uniform sampler shadow_sampler;

// Where light is looked up.
struct ShadowReceiver {
    vec3 normal_in_world;      // unit; of the surface as it stands, which maps have not bent
    float depth_m;             // below the outer end of its own fur, which darkens it by itself
};

// Every lit shader says it of its fragment.
ShadowReceiver shadow_receiver();

// Texels that the filter leaves beyond itself.
const float SHADOW_BORDER_PX = 4.0;

// Share of a filter's texels that no opaque surface hides; `at`: texels of the atlas.
float shadow_lit(vec2 at, float depth) {
    vec2 texels = vec2(textureSize(sampler2D(shadow_map, shadow_sampler), 0));
    float radius = float(SHADOW_FILTER_PX);
    vec2 corner = floor(at - 0.5);
    vec2 between = at - 0.5 - corner;
    float sum = 0.0;
    for (uint y = 0u; y < SHADOW_FILTER_PX; ++y) {
        for (uint x = 0u; x < SHADOW_FILTER_PX; ++x) {
            vec2 first = vec2(2u * uvec2(x, y)) - radius + 1.0;
            vec4 depths = textureGather(sampler2D(shadow_map, shadow_sampler), (corner + first + 1.0) / texels);
            vec2 low = vec2(shadow_filter_weight(first.x - between.x, radius), shadow_filter_weight(first.y - between.y, radius));
            vec2 high =
                vec2(shadow_filter_weight(first.x + 1.0 - between.x, radius), shadow_filter_weight(first.y + 1.0 - between.y, radius));
            sum += low.x * low.y * shadow_passed(depths.w, depth) + high.x * low.y * shadow_passed(depths.z, depth)
                + low.x * high.y * shadow_passed(depths.x, depth) + high.x * high.y * shadow_passed(depths.y, depth);
        }
    }
    return sum;
}

// Share of light, by channel, that what is translucent lets through to one texel's depth.
vec3 shadow_through_texel(ivec2 texel, float front, float back, float depth) {
    if (front <= 0.0) { return vec3(1.0); }
    vec4 layers = texelFetch(sampler2D(shadow_layer_map, shadow_sampler), texel, 0);
    vec4 total = texelFetch(sampler2D(shadow_total_map, shadow_sampler), texel, 0);
    return exp(-total.rgb * shadow_crossed(layers, total.a, shadow_place(depth, front, back)));
}

// The same of the four texels around a place.
vec3 shadow_through(vec2 at, float depth) {
    vec2 texels = vec2(textureSize(sampler2D(shadow_front_map, shadow_sampler), 0));
    vec2 corner = floor(at - 0.5);
    vec2 between = at - 0.5 - corner;
    vec4 front = textureGather(sampler2D(shadow_front_map, shadow_sampler), (corner + 1.0) / texels);
    if (max(max(front.x, front.y), max(front.z, front.w)) <= depth) { return vec3(1.0); }
    vec4 back = textureGather(sampler2D(shadow_back_map, shadow_sampler), (corner + 1.0) / texels);
    ivec2 texel = ivec2(corner);
    vec3 upper = mix(shadow_through_texel(texel, front.w, back.w, depth),
                     shadow_through_texel(texel + ivec2(1, 0), front.z, back.z, depth), between.x);
    vec3 lower = mix(shadow_through_texel(texel + ivec2(0, 1), front.x, back.x, depth),
                     shadow_through_texel(texel + ivec2(1, 1), front.y, back.y, depth), between.x);
    return mix(upper, lower, between.y);
}

// Share of a light, by channel, that reaches a place. The finest map that shows the place tells.
vec3 shadow_transmittance(LightSource light, vec3 to_light, vec3 position_in_world) {
    ShadowReceiver receiver = shadow_receiver();
    float cosine = dot(receiver.normal_in_world, to_light);
    // What shines through is lit on its other side.
    vec3 normal = cosine < 0.0 ? -receiver.normal_in_world : receiver.normal_in_world;
    // Fur is looked up where the light comes into it.
    vec3 place = position_in_world + to_light * (receiver.depth_m / max(abs(cosine), 0.25));
    for (uint index = 0u; index < light.shadow_count; ++index) {
        ShadowSource map = shadows[light.first_shadow + index];
        float texel_m = map.texel_m * (map.clip_from_world * vec4(place, 1.0)).w;
        // To the corner of the filter, and half a texel for the rounding of depths.
        float aside_m = shadow_normal_step(1.41421356 * float(SHADOW_FILTER_PX) * texel_m, cosine) + 0.5 * texel_m;
        vec4 clip = map.clip_from_world * vec4(place + aside_m * normal, 1.0);
        vec3 seen = clip.xyz / max(clip.w, 1e-30);
        vec2 at = (seen.xy * vec2(0.5, -0.5) + 0.5) * map.size_px;
        bool is_shown = clip.w > 0.0 && seen.z > 0.0 && all(greaterThan(at, vec2(SHADOW_BORDER_PX)))
            && all(lessThan(at, vec2(map.size_px - SHADOW_BORDER_PX)));
        if (!is_shown) { continue; }
        float lit = shadow_lit(map.origin_px + at, seen.z);
        return HAS_TRANSLUCENT_SHADOWS && lit > 0.0 ? lit * shadow_through(map.origin_px + at, seen.z) : vec3(lit);
    }
    return vec3(1.0);
}

#endif
