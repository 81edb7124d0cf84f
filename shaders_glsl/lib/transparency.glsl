// What blends, as an entry of a pixel's list: how it is packed, and what it does to the light behind it. Functions only.
//
// Light from behind is multiplied by the transmittance, a colour, and premultiplied radiance is added (Porter & Duff 1984,
// "Compositing Digital Images", with an opacity a channel). A channel of an entry is one word: 15 bits of radiance (a half
// float without its sign), 12 of transmittance, 5 of something else. So a layer is off by at most 2^-11 of its radiance and
// by 1.3e-4 of the light behind it.
#ifndef VAIR_TRANSPARENCY_GLSL
#define VAIR_TRANSPARENCY_GLSL

// Bits of the nearest half float, the even one of two; x in [0, 65504].
uint transparency_half(float x) {
    // Below 2^-14 halves are multiples of 2^-24.
    if (x < 6.103515625e-5) {
        return uint(x * 16777216.0 + 0.5);
    }
    uint bits = floatBitsToUint(x);
    return ((bits + 0xfffu + (bits >> 13u & 1u)) >> 13u) - 0x1c000u;
}

// One channel: radiance >= 0 (at most 64512 is kept), transmittance in [0, 1], rest < 32.
uint transparency_packed(float radiance, float transmittance, uint rest) {
    uint seen = transparency_half(min(max(radiance, 0.0), 64512.0));
    uint passed = uint(clamp(transmittance, 0.0, 1.0) * 4095.0 + 0.5);
    return seen << 17u | passed << 5u | rest;
}

// Radiance of a packed channel.
float transparency_radiance(uint packed) {
    uint bits = packed >> 17u;
    return bits < 1024u ? float(bits) * 5.9604644775390625e-8 : uintBitsToFloat((bits << 13u) + 0x38000000u);
}

// Transmittance of a packed channel.
float transparency_transmittance(uint packed) {
    return float(packed >> 5u & 4095u) / 4095.0;
}

// Weight of what lies at a reversed depth in [0, 1] (McGuire & Bavoil 2013, "Weighted Blended Order-Independent
// Transparency", equation 10 without its alpha, which premultiplied radiance already holds).
float transparency_weight(float depth) {
    return clamp(3000.0 * depth * depth * depth, 0.01, 3000.0);
}

// Share of the light left after a way through something that leaves `color`, in [0, 1], after a distance of 1; `way` >= 0
// in such distances (Beer-Lambert; KHR_materials_volume).
vec3 transparency_attenuation(vec3 color, float way) {
    if (way <= 0.0) {
        return vec3(1.0);
    }
    return pow(color, vec3(way));
}

#endif
