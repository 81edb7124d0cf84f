// Colour: sRGB transfer function (IEC 61966-2-1) and Rec. 709 luminance. Functions only.
#ifndef VAIR_COLOR_GLSL
#define VAIR_COLOR_GLSL

// Linear from sRGB-coded, [0, 1].
vec3 linear_from_srgb(vec3 coded) {
    vec3 low = coded / 12.92;
    vec3 high = pow((max(coded, vec3(0.04045)) + 0.055) / 1.055, vec3(2.4));
    return mix(high, low, lessThanEqual(coded, vec3(0.04045)));
}

// sRGB-coded from linear, [0, 1].
vec3 srgb_from_linear(vec3 linear) {
    vec3 low = linear * 12.92;
    vec3 high = 1.055 * pow(max(linear, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055;
    return mix(high, low, lessThanEqual(linear, vec3(0.0031308)));
}

// Luminance of a linear Rec. 709 colour.
float luminance(vec3 color) {
    return dot(color, vec3(0.2126, 0.7152, 0.0722));
}

#endif
