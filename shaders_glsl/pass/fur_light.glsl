// What the strands of fur see of the environment.
#ifndef VAIR_FUR_LIGHT_GLSL
#define VAIR_FUR_LIGHT_GLSL
#include "lighting.glsl"
#include "fibre.glsl"

// Zonal bands 1 and 2 (band 0 is 1) of fibre_diffuse about the fur's normal (the part around the tangent for a strand that leans by 45
// degrees), and of the transmitted lobe at roughness 0.35 about the way ahead.
const vec2 FUR_DIFFUSE_BANDS = vec2(0.53, 0.07);
const vec2 FUR_AHEAD_BANDS = vec2(0.8, 0.55);

vec3 fur_mean_light(vec3 direction_in_world, vec2 bands) {
    return max(environment_mean(environment_direction(direction_in_world), bands.x, bands.y), vec3(0.0));
}

// Light of the environment that strands send to the eye. Both highlights see the direction on their cones' middle that
// is nearest to the eye, spread as far as between them they spread it: a GGX lobe of width alpha, seen from the front,
// spreads reflections by a variance of 2 alpha^2, and the mean of one and four times the variance is about twice it.
vec3 fur_environment(Fibre fibre, vec3 color, vec3 to_eye, float depth) {
    vec3 diffuse = fur_mean_light(fibre.normal, FUR_DIFFUSE_BANDS);
    vec3 behind = fur_mean_light(-to_eye, FUR_AHEAD_BANDS);
    vec3 mirror = (fibre.sine.x + fibre.sine.y) * fibre.tangent + (fibre.cosine.x + fibre.cosine.y) * fibre.across;
    float roughness = min(sqrt(sqrt(fibre.variance.x)), 1.0);
    vec3 mirrored = environment_radiance(mirror, roughness);
    return fibre_environment(fibre, color, diffuse, behind, mirrored, depth);
}

#endif
