// What the lobes of a surface see of their environment: mean radiances, by which a material weights their albedos, so that
// under constant light every lobe returns its albedo and nothing else. Occlusion dims each lobe by what it would have seen,
// with what bounces back from walls of its own colour. After surface.glsl.
#ifndef VAIR_ENVIRONMENT_LIGHT_GLSL
#define VAIR_ENVIRONMENT_LIGHT_GLSL
#include "environment_lobe.glsl"
#include "occlusion.glsl"
#include "sheen.glsl"

layout(constant_id = 92) const uint ANISOTROPIC_TAPS = 9;

// A direction that a bent normal sends into the surface goes along it: hidden, it would meet the surface itself.
vec3 above_horizon(SurfaceFragment f, vec3 direction_in_world) {
    float below = min(dot(direction_in_world, f.normal_in_world), 0.0);
    return direction_in_world - below * f.normal_in_world;
}

// Factor on the light of a lobe of that reflectance, of which that share comes through a crevice.
vec3 through_crevice(SurfaceFragment f, float mu_v, float roughness, vec3 reflectance) {
    // Without a map this is known when the pipeline is made, and all that follows is gone.
    if (f.occlusion >= 1.0) { return vec3(1.0); }
    return occlusion_bounced(occlusion_of_lobe(mu_v, roughness, f.occlusion), reflectance);
}

vec3 diffuse_light_about(SurfaceFragment f, vec3 normal_in_world, vec3 albedo) {
    vec3 light = environment_irradiance(normal_in_world);
    return f.occlusion >= 1.0 ? light : light * occlusion_bounced(f.occlusion, albedo);
}

// By a diffuse lobe of that albedo.
vec3 diffuse_light(SurfaceFragment f, vec3 albedo) {
    return diffuse_light_about(f, f.world_from_tangent[2], albedo);
}

// By one on the far side.
vec3 diffuse_light_behind(SurfaceFragment f, vec3 albedo) {
    return diffuse_light_about(f, -f.world_from_tangent[2], albedo);
}

vec3 lobe_light(SurfaceFragment f, mat3 world_from_tangent, vec3 v, vec4 entry) {
    vec3 axis = world_from_tangent * environment_lobe_axis(v, entry.x);
    return environment_radiance(above_horizon(f, axis), entry.y);
}

// By a GGX lobe in that frame; reflectance at normal incidence.
vec3 mirrored_light(SurfaceFragment f, mat3 world_from_tangent, vec3 v, float roughness, vec3 reflectance) {
    vec3 light = lobe_light(f, world_from_tangent, v, lobe_entry(ENVIRONMENT_GGX, v.z, roughness));
    return light * through_crevice(f, v.z, roughness, reflectance);
}

// By an anisotropic one of those widths.
vec3 mirrored_light_along(SurfaceFragment f, mat3 world_from_tangent, vec3 v, vec2 alpha, vec3 reflectance) {
    vec4 entry = lobe_entry(ENVIRONMENT_GGX, v.z, environment_tap_roughness(alpha, ANISOTROPIC_TAPS));
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (uint index = 0u; index < ANISOTROPIC_TAPS; ++index) {
        vec3 h = environment_tap_normal(v, alpha, (float(index) + 0.5) / float(ANISOTROPIC_TAPS));
        vec3 mirrored = reflect(-v, h);
        float weight = mirrored.z > 0.0 ? ggx_masking_shadowing_times_cosine(v, mirrored, alpha.x, alpha.y) : 0.0;
        vec3 axis = world_from_tangent * environment_tap_axis(v, h, entry.x);
        sum += weight * environment_radiance(above_horizon(f, axis), entry.y);
        weights += weight;
    }
    float mean_roughness = sqrt(sqrt(alpha.x * alpha.y));
    return sum / max(weights, 1e-20) * through_crevice(f, v.z, mean_roughness, reflectance);
}

// By a lobe of fuzz of that model and colour.
vec3 fuzz_light(SurfaceFragment f, mat3 world_from_tangent, vec3 v, uint sheen, float roughness, vec3 color) {
    vec3 light = lobe_light(f, world_from_tangent, v, lobe_entry(1u + sheen, v.z, roughness));
    // Fuzz scatters as widely as the roughest highlight.
    return light * through_crevice(f, v.z, 1.0, color);
}

#endif
