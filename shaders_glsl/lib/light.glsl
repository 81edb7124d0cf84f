// Punctual lights. Source: KHR_lights_punctual, "Range property" and "Inner and outer cone angles".
#ifndef VAIR_LIGHT_GLSL
#define VAIR_LIGHT_GLSL
#include "direction.glsl"
#include "frame.glsl"

// Times the peak of the sharpest lobe (about 1e8) this is still a finite number; infinity times nothing would be NaN.
const float LARGEST_IRRADIANCE = 1e30;

struct LightSample {
    vec3 direction_in_world; // unit vector to the light
    vec3 irradiance;         // linear RGB on a surface that faces the light
};

float light_range_window(float distance_squared, float range_m) {
    float ratio = distance_squared / (range_m * range_m);
    return clamp(1.0 - ratio * ratio, 0.0, 1.0);
}

LightSample light_sample(LightSource light, vec3 position_in_world) {
    LightSample result;
    if (light.kind == LIGHT_DIRECTIONAL) {
        result.direction_in_world = light.direction_to_light;
        result.irradiance = min(light.intensity, vec3(LARGEST_IRRADIANCE));
        return result;
    }
    vec3 to_light = light.position_in_world - position_in_world;
    // A surface inside the light would divide by zero; a millionth of a metre is below any scene's scale.
    float distance_squared = max(dot(to_light, to_light), 1e-12);
    result.direction_in_world = direction_or(to_light, vec3(0.0));
    float falloff = 1.0 / distance_squared;
    if (light.range_m > 0.0) {
        falloff *= light_range_window(distance_squared, light.range_m);
    }
    if (light.kind == LIGHT_SPOT) {
        float cosine = dot(light.direction_to_light, result.direction_in_world);
        float cone = clamp(cosine * light.spot_scale + light.spot_offset, 0.0, 1.0);
        falloff *= cone * cone;
    }
    result.irradiance = min(light.intensity * falloff, vec3(LARGEST_IRRADIANCE));
    return result;
}

#endif
