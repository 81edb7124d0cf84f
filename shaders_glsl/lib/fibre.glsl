// How the strands of fur scatter light: three lobes of one fibre, and what many fibres pass on to each other.
//
// A fibre reflects light off its cuticle (R, white), lets it through (TT) and returns it from its far side (TRT). Each lobe
// is a longitudinal lobe about a cone around the tangent times an azimuthal one, both normalised (Marschner et al. 2003,
// "Light Scattering from Human Hair Fibers"; d'Eon et al. 2011, "An Energy-Conserving Hair Reflectance Model"). What is
// left of the light goes from fibre to fibre and leaves the fur as diffuse, in the fur's colour (in the manner of Zinke
// et al. 2008, "Dual Scattering Approximation for Fast Multiple Scattering in Hair"): white fur loses nothing.
//
// The three lobes stand in the components of a vector: x reflected, y returned, z transmitted.
#ifndef VAIR_FIBRE_GLSL
#define VAIR_FIBRE_GLSL

// Shares of white light: at specular 1 for the first two, at transmission 1 for the third. The rest of what goes through a
// fibre (some .8 in all) meets others, and is diffuse.
const vec3 FIBRE_SHARE = vec3(0.1, 0.1, 0.3);
// The cuticle's scales tilt the lobes by -a, 3 a / 2 and a / 2 (Marschner et al. 2003, table 1), a = 0.08 rad: cosine and
// sine of these.
const vec3 FIBRE_TILT_COSINE = vec3(0.99680171, 0.99280864, 0.99920011);
const vec3 FIBRE_TILT_SINE = vec3(-0.07991469, 0.11971221, 0.03998933);
// Means of cos(phi) and of cos(2 phi) around the fibre, phi = 0 at the eye: of cos(phi / 2) / 4 and of sin(phi / 2)^8.
const vec3 FIBRE_AROUND = vec3(0.33333333, 0.33333333, -0.8);
const vec3 FIBRE_AROUND_TWICE = vec3(-0.06666667, -0.06666667, 0.4);
// The body below fur hides light gradually, between these cosines: strands stand above it, and see past its horizon.
const float FIBRE_HORIZON = 0.5;
// Diffuse light wraps this far around the fur's surface.
const float FIBRE_WRAP = 0.3;
// Share of diffuse light that is scattered by the uppermost fibres, and hence around their tangent.
const float FIBRE_CYLINDRICAL = 0.35;

// What the light does not change.
struct Fibre {
    vec3 normal;   // of the fur, unit vector
    vec3 tangent;  // of the strand, unit vector, to its tip
    vec3 across;   // unit vector to the eye across the tangent; 0 where the eye looks along it
    vec3 sine;     // of the angle from the plane across the tangent to the lobes' cones
    vec3 cosine;
    vec3 variance; // along the fibre
    vec3 share;    // of white light
    vec3 seen;     // how much of each lobe the body below leaves open, in [0, 1]
};

// Variance of the lobe R from the longitudinal roughness; TRT has four times it, TT a quarter. Source: Chiang et al. 2016,
// "A Practical and Controllable Hair and Fur Model for Production Path Tracing", equation 7.
float fibre_variance(float roughness) {
    float b = clamp(roughness, 0.1, 1.0);
    float b2 = b * b;
    float b4 = b2 * b2;
    float b16 = b4 * b4 * b4 * b4;
    float root = 0.726 * b + 0.812 * b2 + 3.7 * b16 * b4;
    return root * root;
}

// I0(x) exp(-x) for x >= 0. Source: Abramowitz & Stegun 1964, "Handbook of Mathematical Functions", 9.8.1 and 9.8.2.
vec3 fibre_bessel(vec3 x) {
    vec3 s = min(x / 3.75, 1.0);
    s *= s;
    vec3 small = exp(-x) * (1.0 + s * (3.5156229 + s * (3.0899424 + s * (1.2067492 + s * (0.2659732
        + s * (0.0360768 + s * 0.0045813))))));
    vec3 from = max(x, 3.75);
    vec3 t = 3.75 / from;
    vec3 large = inversesqrt(from) * (0.39894228 + t * (0.01328592 + t * (0.00225319 + t * (-0.00157565
        + t * (0.00916281 + t * (-0.02057706 + t * (0.02635537 + t * (-0.01647633 + t * 0.00392377))))))));
    return mix(small, large, greaterThan(x, vec3(3.75)));
}

// Longitudinal lobes, by sine and cosine of the cones' angles and of the light's: a von Mises-Fisher lobe, turned around the
// fibre. The integral over the sine is 1. Source: d'Eon et al. 2011, equation 7, in a form that neither overflows nor
// cancels.
vec3 fibre_along(vec3 sine, vec3 cosine, vec3 variance, float light_sine, float light_cosine) {
    vec3 from_sine = sine - light_sine;
    vec3 from_cosine = cosine - light_cosine;
    vec3 away = (from_sine * from_sine + from_cosine * from_cosine) / (2.0 * variance);
    return fibre_bessel(cosine * (light_cosine / variance)) * exp(-away) / (variance * (1.0 - exp(-2.0 / variance)));
}

// Azimuthal lobes per radian, for vectors across the tangent to the eye (unit or 0) and to the light: R and TRT as off a
// cylinder's side, TT through it, ahead. Their integral around the fibre is 1. A vector along the tangent has no azimuth.
vec3 fibre_around(vec3 eye_across, vec3 light_across) {
    float light_squared = dot(light_across, light_across);
    if (dot(eye_across, eye_across) < 0.5 || light_squared < 1e-12) { return vec3(0.15915494); }
    // The half angle's cosine as half the length of a sum: 0.5 + 0.5 cos would cancel where the eye looks into the light.
    vec3 sum = eye_across + light_across * inversesqrt(light_squared);
    float half_cosine = min(0.5 * length(sum), 1.0);
    float ahead = 1.0 - half_cosine * half_cosine;
    ahead *= ahead;
    return vec3(0.25 * half_cosine, 0.25 * half_cosine, 0.58205236 * ahead * ahead);
}

// How much light from that cosine the body below the fur lets by. That of the opposite direction is what is missing to 1.
float fibre_horizon(float cosine_to_light) {
    return smoothstep(-FIBRE_HORIZON, FIBRE_HORIZON, cosine_to_light);
}

// Mean of fibre_horizon over the lobes, from mean and variance of the cosine that they see: within 0.075 of it. `facing` is
// the cosine between normal and tangent, `aside` that between normal and the eye across the tangent.
vec3 fibre_seen(vec3 sine, vec3 variance, float facing, float aside) {
    // First and second moment along the axis of a von Mises-Fisher lobe; of wide ones by their series, as they would cancel.
    vec3 tail = exp(-2.0 / variance);
    vec3 first = (1.0 + tail) / (1.0 - tail) - variance;
    vec3 second = 1.0 - 3.0 * variance * first;
    vec3 k = 1.0 / variance;
    vec3 k2 = k * k;
    bvec3 is_wide = lessThan(k, vec3(0.5));
    first = mix(first, k * (1.0 / 3.0 - k2 * (1.0 / 45.0 - k2 * (2.0 / 945.0))), is_wide);
    second = mix(second, k2 * (1.0 / 15.0 - k2 * (2.0 / 315.0 - k2 / 1575.0)), is_wide);
    vec3 sine_mean = first * sine;
    vec3 sine_squared = clamp((1.0 - second) / 3.0 + second * sine * sine, 0.0, 1.0);
    vec3 around = sqrt(1.0 - sine_squared) * FIBRE_AROUND * aside;
    vec3 mean = sine_mean * facing + around;
    vec3 spread = facing * facing * (sine_squared - sine_mean * sine_mean) - around * around
        + (1.0 - sine_squared) * (0.5 * (1.0 - facing * facing) * (1.0 - FIBRE_AROUND_TWICE) + FIBRE_AROUND_TWICE * aside * aside);
    // Slope and width are fitted.
    vec3 x = clamp(mean * inversesqrt(4.41 * (max(spread, 0.0) + 0.08)), -1.0, 1.0);
    return 0.5 + x * (0.75 - 0.25 * x * x);
}

// A fibre as the eye sees it. `variance` is that of R.
Fibre fibre_to_eye(vec3 normal, vec3 tangent, vec3 to_eye, float specular, float transmission, float variance) {
    Fibre fibre;
    fibre.normal = normal;
    fibre.tangent = tangent;
    float eye_sine = dot(tangent, to_eye);
    vec3 across = to_eye - eye_sine * tangent;
    float eye_cosine = length(across);
    fibre.across = eye_cosine > 1e-3 ? across / eye_cosine : vec3(0.0);
    fibre.sine = FIBRE_TILT_SINE * eye_cosine - FIBRE_TILT_COSINE * eye_sine;
    fibre.cosine = abs(FIBRE_TILT_COSINE * eye_cosine + FIBRE_TILT_SINE * eye_sine);
    fibre.variance = variance * vec3(1.0, 4.0, 0.25);
    fibre.share = FIBRE_SHARE * vec3(specular, specular, transmission);
    fibre.seen = fibre_seen(fibre.sine, fibre.variance, dot(normal, tangent), dot(normal, fibre.across));
    return fibre;
}

// What one way through a fibre leaves of light, for fur that is to have that colour: absorption by Chiang et al. 2016,
// equation 9, at azimuthal roughness 0.3, along the mean chord (1.85 radii, refracted by an index of 1.55).
vec3 fibre_transmittance(vec3 color) {
    vec3 root = log(clamp(color, 1e-4, 1.0)) / 5.888414;
    return exp(-1.85 * root * root);
}

// Diffuse light that fur of that optical depth leaves. The depth is what white fur shows, light that fibres pass on to
// each other included; dark fibres pass on less of what they intercept, so that colours deepen towards the root.
vec3 fibre_passed_on(vec3 color, float depth) {
    return exp(-depth * (1.5 - 0.5 * color));
}

// Light that went straight on: of what fibres intercept, half goes ahead, each time attenuated by one way through (the
// forward half of Zinke et al. 2008).
vec3 fibre_ahead(vec3 transmittance, float depth) {
    return transmittance * exp(-depth * (1.0 - 0.5 * transmittance));
}

// Diffuse kernel, per steradian: light around the fur's normal, wrapped, and around the strands' tangent. Its integral over
// all directions is 1: the horizon hides half of what a sine around the tangent weighs, whatever the tangent.
float fibre_diffuse(Fibre fibre, vec3 to_light, float light_cosine) {
    float cosine_to_light = dot(fibre.normal, to_light);
    float wrapped = max(cosine_to_light + FIBRE_WRAP, 0.0) / (3.14159265 * (1.0 + FIBRE_WRAP) * (1.0 + FIBRE_WRAP));
    float cylindrical = 0.20264237 * light_cosine * fibre_horizon(cosine_to_light);
    return mix(wrapped, cylindrical, FIBRE_CYLINDRICAL);
}

// Share of white light that is left for the diffuse part. `margin` 1 takes off by what fibre_seen may err, so that a light
// is never given back with gain.
float fibre_rest(Fibre fibre, float margin) {
    float lobes = fibre.share.x + fibre.share.y + fibre.share.z;
    return 1.0 - dot(fibre.share, fibre.seen) - margin * min(0.08 * lobes, 0.024);
}

// Radiance per unit irradiance of strands of that colour, below fur of that optical depth along the light. What hides a
// strand from the eye is drawn, and counts here no more.
vec3 fibre_scattering(Fibre fibre, vec3 color, vec3 to_light, float depth) {
    float light_sine = dot(fibre.tangent, to_light);
    vec3 light_across = to_light - light_sine * fibre.tangent;
    float light_cosine = length(light_across);
    vec3 lobes = fibre.share * fibre_horizon(dot(fibre.normal, to_light)) * fibre_around(fibre.across, light_across)
        * fibre_along(fibre.sine, fibre.cosine, fibre.variance, light_sine, light_cosine);
    vec3 once = fibre_transmittance(color);
    vec3 diffuse = color * (fibre_rest(fibre, 1.0) * fibre_diffuse(fibre, to_light, light_cosine));
    return exp(-depth) * (lobes.x + lobes.y * once * once) + lobes.z * fibre_ahead(once, depth)
        + fibre_passed_on(color, depth) * diffuse;
}

// The same for an environment: mean radiance that the diffuse part, the transmitted lobe and the two highlights see; through a
// fur of that optical depth, on average over all directions.
vec3 fibre_environment(Fibre fibre, vec3 color, vec3 diffuse, vec3 behind, vec3 mirrored, float depth) {
    vec3 lobes = fibre.share * fibre.seen;
    vec3 once = fibre_transmittance(color);
    return exp(-depth) * (lobes.x + lobes.y * once * once) * mirrored + lobes.z * fibre_ahead(once, depth) * behind
        + fibre_passed_on(color, depth) * (fibre_rest(fibre, 0.0) * color * diffuse);
}

#endif
