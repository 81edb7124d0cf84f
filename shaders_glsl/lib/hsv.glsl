// Hue, saturation and value of a linear colour. Functions only. Source: Smith 1978, "Color Gamut Transform Pairs".
#ifndef VAIR_HSV_GLSL
#define VAIR_HSV_GLSL

// Linear RGB; hue in turns, any number: red, green and blue at 0, 1/3 and 2/3; saturation and value in [0, 1].
vec3 rgb_from_hsv(vec3 hsv) {
    // Turns away from each channel's own hue, in sixths: a channel is full within one, and gone beyond two.
    vec3 away = abs(fract(hsv.x + vec3(0.5, 0.1666666667, 0.8333333333)) - 0.5) * 6.0;
    return hsv.z * (1.0 - hsv.y * clamp(away - 1.0, 0.0, 1.0));
}

// Hue in [0, 1], 0 for greys; rgb in [0, 1].
vec3 hsv_from_rgb(vec3 rgb) {
    float value = max(max(rgb.r, rgb.g), rgb.b);
    float chroma = value - min(min(rgb.r, rgb.g), rgb.b);
    // Too little to divide by: grey, as is what a device may flush to zero.
    if (chroma < 1e-30) {
        return vec3(0.0, 0.0, value);
    }
    float sixth = value == rgb.r ? (rgb.g - rgb.b) / chroma
                : value == rgb.g ? (rgb.b - rgb.r) / chroma + 2.0
                                 : (rgb.r - rgb.g) / chroma + 4.0;
    return vec3(fract(sixth / 6.0), chroma / value, value);
}

#endif
