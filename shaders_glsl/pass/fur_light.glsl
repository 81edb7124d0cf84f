// What the strands of a coat see of the surroundings.
#ifndef VAIR_FUR_LIGHT_GLSL
#define VAIR_FUR_LIGHT_GLSL
#include "lighting.glsl"
#include "fibre.glsl"

// Zonal bands 0 to 2 of fibre_diffuse about the coat's normal (the part around the tangent for a strand that leans by 45
// degrees), and of the transmitted lobe at roughness 0.35 about the way ahead.
const vec3 FUR_DIFFUSE_BANDS = vec3(1.0, 0.53, 0.07);
const vec3 FUR_AHEAD_BANDS = vec3(1.0, 0.8, 0.55);

// Mean radiance around a direction by the kernel that has those zonal bands.
vec3 environment_mean(vec3 direction_in_world, vec3 bands) {
    vec3 w = environment_direction(direction_in_world);
    vec3 band_1 = frame.environment_harmonics[1].rgb * w.y + frame.environment_harmonics[2].rgb * w.z
        + frame.environment_harmonics[3].rgb * w.x;
    vec3 band_2 = 1.092548431 * (frame.environment_harmonics[4].rgb * (w.x * w.y)
            + frame.environment_harmonics[5].rgb * (w.y * w.z) + frame.environment_harmonics[7].rgb * (w.x * w.z))
        + frame.environment_harmonics[6].rgb * (0.315391565 * (3.0 * w.z * w.z - 1.0))
        + frame.environment_harmonics[8].rgb * (0.546274215 * (w.x * w.x - w.y * w.y));
    vec3 mean = frame.environment_harmonics[0].rgb * 0.282094792 + bands.y * 0.488602512 * band_1 + bands.z * band_2;
    return max(mean, vec3(0.0));
}

// Light of the surroundings that strands send to the eye. Both highlights see the direction on their cones' middle that
// is nearest to the eye, spread as far as between them they spread it: a GGX lobe of width alpha, seen from the front,
// spreads reflections by a variance of 2 alpha^2, and the mean of one and four times the variance is about twice it.
vec3 fur_surroundings(Fibre fibre, vec3 color, vec3 to_eye, float depth) {
    vec3 diffuse = environment_mean(fibre.normal, FUR_DIFFUSE_BANDS);
    vec3 ahead = environment_mean(-to_eye, FUR_AHEAD_BANDS);
    vec3 mirror = (fibre.sine.x + fibre.sine.y) * fibre.tangent + (fibre.cosine.x + fibre.cosine.y) * fibre.across;
    float roughness = min(sqrt(sqrt(fibre.variance.x)), 1.0);
    vec3 mirrored = environment_radiance(mirror, roughness);
    return fibre_surroundings(fibre, color, diffuse, ahead, mirrored, depth);
}

#endif
