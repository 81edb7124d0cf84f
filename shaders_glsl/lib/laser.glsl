// Laser cloth: a painted film whose hue follows the angle of view. Functions only; the colour is a factor on the base
// colour, of metal and diffuse alike, and as it is at most 1 nothing exceeds what came in.
//
// Sources: formulas.md 1.4 of older engine shaders (hue, curves and direction). The fade of hues that a pixel cannot hold
// is the response of a Gaussian as wide as the pixel to the first harmonic of the wheel.
#ifndef VAIR_LASER_GLSL
#define VAIR_LASER_GLSL
#include "hsv.glsl"

// Cosine and sine of the view angle that lies in the plane of the normal and of an axis in the tangent plane (unit); both
// 0 where the view is across that plane. eye in the tangent frame, above the horizon.
vec2 laser_angle_along(vec3 eye, vec2 axis) {
    float along = dot(eye.xy, axis);
    return vec2(eye.z, abs(along)) * inversesqrt(eye.z * eye.z + along * along + 1e-8);
}

// What drives the hue, from 0 (facing) to 1 (grazing). angle = cosine and sine of the view angle.
float laser_curve(vec2 angle, bool is_sine) {
    return is_sine ? angle.y : 1.0 - angle.x;
}

// Colour of the wheel at a phase in turns. change = turns from one pixel to the next: where many fall in one, their mean
// is shown, a grey, in the place of sparkles.
vec3 laser_wheel(float phase, float change, float saturation, float brightness) {
    float turns = min(change, 1e3);
    // 2 pi^2 / 12: the variance of a box that wide.
    float kept = exp(-1.644934067 * turns * turns);
    return rgb_from_hsv(vec3(phase, saturation, brightness)) * kept + brightness * (1.0 - 0.5 * saturation) * (1.0 - kept);
}

// A painted colour, linear in [0, 1], its hue turned by offset turns.
vec3 laser_ramp(vec3 painted, float offset, float saturation, float brightness) {
    vec3 hsv = hsv_from_rgb(painted);
    return rgb_from_hsv(vec3(hsv.x + offset, hsv.y * saturation, hsv.z * brightness));
}

#endif
