// What a crevice leaves of the environment. Functions only. Occlusion is the share of the irradiance of an even sky that
// arrives: 1 = open.
//
// Sources: Jimenez et al. 2016, "Practical Real-Time Strategies for Accurate Indirect Occlusion" (light that bounces
// within a crevice; the opening as a cone around the normal). What a lobe sees through that cone is our own fit.
#ifndef VAIR_OCCLUSION_GLSL
#define VAIR_OCCLUSION_GLSL

// Share of a GGX lobe's light, or of one as wide, that comes through the opening; mu_v in [0, 1], roughness perceptual.
//
// A log-logistic curve: half of the light arrives where the cone's edge meets the middle of the lobe, and how fast it
// rises there is how narrow the lobe is beside its distance from the normal. Against quadrature over roughness 0.05..1 and
// mu 0.05..1: 0.031 off in the mean (RMS over the occlusion), 0.089 at most; Lagarde & de Rousiers' form is 0.23 and 0.54.
float occlusion_of_lobe(float mu_v, float roughness, float occlusion) {
    if (occlusion <= 0.0 || occlusion >= 1.0) {
        return occlusion <= 0.0 ? 0.0 : 1.0;
    }
    float alpha = clamp(roughness * roughness, 0.01, 1.0);
    float sine_squared = (1.0 - mu_v) * (1.0 + mu_v);
    float width = alpha * alpha;
    float middle = clamp(mix(sine_squared, 0.55, width / (width + 0.09)), 1e-4, 0.9999);
    float rise = sqrt(1.0 + 0.16 * sine_squared * mu_v * mu_v / width);
    float odds = (1.0 - occlusion) * middle / (occlusion * (1.0 - middle));
    return 1.0 / (1.0 + pow(max(odds, 1e-30), rise));
}

// Occlusion of a crevice whose walls reflect that colour.
vec3 occlusion_bounced(float occlusion, vec3 color) {
    vec3 a = 2.0404 * color - 0.3324;
    vec3 b = -4.7951 * color + 0.6417;
    vec3 c = 2.7552 * color + 0.6903;
    float x = occlusion;
    return clamp(max(vec3(x), ((x * a + b) * x + c) * x), 0.0, 1.0);
}

#endif
