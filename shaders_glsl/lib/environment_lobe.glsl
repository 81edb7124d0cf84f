// How a lobe wider along one tangent than along the other reads an environment that was prefiltered by round ones: by
// several taps of a lobe of the narrow width, spread along the wide one. Functions only; directions are unit vectors in the
// tangent frame (x = tangent, z = normal).
//
// The taps' normals are those that the eye sees of a profile of GGX along the wide axis, by equal shares: Heitz 2014,
// "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs" (visible normals), which in a plane have the
// closed form below; the share of a tap's light is what the lobe's masking and shadowing leave of it. Each tap then bends
// towards its normal as far as a round lobe of its width does (the table of lobes). Against quadrature over widths 0.01..1
// and all views, under lights of about 10 degrees, RMS over where they stand: 0.60 by one look-up of the mean width, 0.45 by
// 1 tap, 0.20 by 5, 0.16 by 7, 0.14 by 9.
#ifndef VAIR_ENVIRONMENT_LOBE_GLSL
#define VAIR_ENVIRONMENT_LOBE_GLSL

// Width of the taps' profile: with the taps' own it makes the wide one. Widths of tails add up, variances do so too; GGX is
// between.
float environment_tap_spread(vec2 alpha) {
    float narrow = min(alpha.x, alpha.y);
    float wide = max(alpha.x, alpha.y);
    return 0.5 * (sqrt((wide - narrow) * (wide + narrow)) + wide - narrow);
}

// Perceptual roughness of the taps' lobes: the narrow width, and as much more as hides the gaps between few taps.
float environment_tap_roughness(vec2 alpha, uint taps) {
    float gap = environment_tap_spread(alpha) / float(max(taps, 1u));
    return sqrt(min(min(alpha.x, alpha.y) + 0.2 * gap, 1.0));
}

// Normal of the tap in the middle of a share of what is seen, in (0, 1); v above the horizon.
vec3 environment_tap_normal(vec3 v, vec2 alpha, float share) {
    bool along_x = alpha.x >= alpha.y;
    float spread = environment_tap_spread(alpha);
    // In the plane of the wide axis, stretched until the profile is a circle, all that is seen spreads evenly in the sine of
    // its angle from the eye.
    vec2 eye = vec2(spread * (along_x ? v.x : v.y), v.z);
    eye *= inversesqrt(dot(eye, eye));
    vec2 range = eye.x >= 0.0 ? vec2(-1.0, eye.y) : vec2(-eye.y, 1.0);
    float sine = mix(range.x, range.y, share);
    float cosine = sqrt((1.0 - sine) * (1.0 + sine));
    vec2 normal = vec2(spread * (eye.x * cosine + eye.y * sine), eye.y * cosine - eye.x * sine);
    normal *= inversesqrt(dot(normal, normal));
    return along_x ? vec3(normal.x, 0.0, normal.y) : vec3(0.0, normal.x, normal.y);
}

// Where a tap reads: v mirrored by its normal h, its sine from there times `mirror` (of the table of lobes).
vec3 environment_tap_axis(vec3 v, vec3 h, float mirror) {
    vec3 across = mirror * (dot(v, h) * h - v);
    return across + sqrt(max(1.0 - dot(across, across), 0.0)) * h;
}

#endif
