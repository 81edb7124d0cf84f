// Shadow maps: how far a receiver steps aside of itself, how texels are weighed, and how much light goes through what
// is translucent. Depth is reversed: 1 at the light, 0 far away.
#ifndef VAIR_SHADOW_GLSL
#define VAIR_SHADOW_GLSL

// Of a material that lets nothing through.
const float SHADOW_OPAQUE_DEPTH = 16.0;
// Share of the way from the first translucent surface to the last that counts as being at either.
const float SHADOW_AT = 0.01;

// How far along the normal a receiver is looked up, in units of `reach`, the farthest that a texel read lies from the
// point, across the light: a plane at that angle rises by reach tan over it, and a step h along the normal lifts the
// point by h / cos off the plane along the light. So h = reach sin clears it exactly.
// Source: Holbert 2011, "Saying Goodbye to Shadow Acne" (the step); the size is derived here.
float shadow_normal_step(float reach, float cosine_to_light) {
    return reach * sqrt(max(1.0 - cosine_to_light * cosine_to_light, 0.0));
}

// Weight of a texel whose middle lies `distance` texels from the point, along one axis: a tent of a whole number of
// texels, so that the weights of all texels add up to 1 wherever the point is and shadows do not crawl.
float shadow_filter_weight(float distance, float radius) {
    return max(radius - abs(distance), 0.0) / (radius * radius);
}

// Share of light that passes a texel with an opaque surface at `map_depth`.
float shadow_passed(float map_depth, float depth) {
    return map_depth <= depth ? 1.0 : 0.0;
}

// Optical depth of something that lets this share of light through.
vec3 shadow_optical_depth(vec3 transmittance) {
    return -log(max(transmittance, vec3(exp(-SHADOW_OPAQUE_DEPTH))));
}

// Where a depth lies between the first translucent surface, 0, and the last one, 1; negative before the first.
float shadow_place(float depth, float nearest, float farthest) {
    return (nearest - depth) / max(nearest - farthest, 1e-6);
}

// What one surface of optical depth `optical_depth` at `place` adds to the depths collected up to four knots: right behind
// the first surface, at a third and two thirds of the way, and right before the last one. Two sheets, the common case,
// are thus told apart exactly whatever the distance between them; fur between is read as a line between the knots.
// Source: Yuksel & Keyser 2008, "Deep Opacity Maps"; the place of the knots is ours.
vec4 shadow_layers(float optical_depth, float place) {
    return optical_depth * vec4(lessThanEqual(vec4(place), vec4(SHADOW_AT, 1.0 / 3.0, 2.0 / 3.0, 1.0 - SHADOW_AT)));
}

// Share of all optical depth that light has crossed on its way to `place`. `depths`: at the knots; `total`: behind all.
float shadow_crossed(vec4 depths, float total, float place) {
    if (place <= SHADOW_AT) { return 0.0; }
    if (place > 1.0 + SHADOW_AT) { return 1.0; }
    float crossed = place < 1.0 / 3.0   ? mix(depths.x, depths.y, 3.0 * place)
                    : place < 2.0 / 3.0 ? mix(depths.y, depths.z, 3.0 * place - 1.0)
                                        : mix(depths.z, depths.w, min(3.0 * place - 2.0, 1.0));
    return clamp(crossed / max(total, 1e-6), 0.0, 1.0);
}

#endif
