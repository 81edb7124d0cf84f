#version 460
#extension GL_GOOGLE_include_directive : require
// Satin: silk, charmeuse, taffeta, brocade. Two anisotropic lobes, narrow and wide, over a diffuse base.
#define CLOTH
#include "surface.glsl"
#include "satin_material.glsl"
#include "anisotropy.glsl"
#include "satin.glsl"
#include "environment_light.glsl"

layout(constant_id = 20) const bool HAS_SPECULAR_NOISE_MAP = false;
layout(constant_id = 21) const bool NARROW = false;    // the narrow lobe is not black
layout(constant_id = 22) const bool SECONDARY = false; // the wide lobe is not black
layout(constant_id = 23) const bool TWO_WAY = false;
layout(constant_id = 24) const bool CLASSIC = false;

layout(set = 1, binding = 20, std140) uniform SatinBlock { SatinUniforms satin; };
#ifdef MAPS
layout(set = 1, binding = 21) uniform texture2D specular_noise_map;
layout(set = 1, binding = 22) uniform sampler specular_noise_sampler;
#endif

// One lobe and, in cross weaves, the same along the other threads; each has half of their share of the surface.
struct Weave {
    AnisotropicLobe warp;
    AnisotropicLobe weft;
    float share;
};

Weave weave(vec3 v, float roughness, vec3 reflectance, vec3 other, vec3 base_color, float metallic) {
    Weave w;
    vec2 alpha = ggx_anisotropic_alpha(min(roughness, 1.0), satin.anisotropy);
    w.share = satin_share(reflectance, other);
    vec3 f0 = mix(satin_f0(reflectance, w.share), base_color * satin_metal(reflectance), metallic);
    float f90 = satin_f90(f0);
    w.warp = anisotropic_lobe(v, alpha, f0, f90);
    if (TWO_WAY) { w.weft = anisotropic_lobe(v, alpha.yx, f0, f90); }
    return w;
}

vec3 weave_times_cosine(Weave w, vec3 v, vec3 l) {
    vec3 value = anisotropic_lobe_times_cosine(w.warp, v, l);
    if (TWO_WAY) { value = 0.5 * (value + anisotropic_lobe_times_cosine(w.weft, v, l)); }
    return w.share * value;
}

vec3 weave_albedo(Weave w, vec3 direction) {
    vec3 value = anisotropic_lobe_albedo(w.warp, direction);
    if (TWO_WAY) { value = 0.5 * (value + anisotropic_lobe_albedo(w.weft, direction)); }
    return w.share * value;
}

// What its lobes send to the eye of their environment.
vec3 weave_environment(SurfaceFragment f, Weave w) {
    vec3 v = f.eye_in_tangent;
    vec2 alpha = vec2(w.warp.alpha_x, w.warp.alpha_y);
    vec3 value = anisotropic_lobe_albedo(w.warp, v) * mirrored_light_along(f, f.world_from_tangent, v, alpha, w.warp.f0);
    if (TWO_WAY) {
        vec3 light = mirrored_light_along(f, f.world_from_tangent, v, alpha.yx, w.weft.f0);
        value = 0.5 * (value + anisotropic_lobe_albedo(w.weft, v) * light);
    }
    return w.share * value;
}

vec3 reflected(SurfaceFragment f, float noise) {
    vec3 v = f.eye_in_tangent;
    float strength = satin.specular_strength * noise;
    vec3 narrow_reflectance = satin_reflectance(satin.specular_color, strength, satin.light_tint);
    vec3 wide_reflectance = satin_reflectance(satin.secondary_color, strength, satin.light_tint);
    Weave narrow;
    Weave wide;
    vec3 albedo = vec3(0.0);
    vec3 average = vec3(0.0);
    vec3 sum = vec3(0.0);
    if (NARROW) {
        narrow = weave(v, f.roughness, narrow_reflectance, wide_reflectance, f.base_color, f.metallic);
        albedo += weave_albedo(narrow, v);
        // That of the weft is the same.
        average += narrow.share * anisotropic_lobe_average_albedo(narrow.warp);
        sum += weave_environment(f, narrow);
    }
    if (SECONDARY) {
        float roughness = f.roughness * satin.secondary_width;
        wide = weave(v, roughness, wide_reflectance, narrow_reflectance, f.base_color, f.metallic);
        albedo += weave_albedo(wide, v);
        average += wide.share * anisotropic_lobe_average_albedo(wide.warp);
        sum += weave_environment(f, wide);
    }
    vec3 diffuse = f.base_color * (1.0 - f.metallic);
    vec3 coupled = diffuse * 0.318309886 * (1.0 - albedo) / max(1.0 - average, 1e-4);
    sum += diffuse * (1.0 - albedo) * diffuse_light(f, diffuse);
    for (uint index = 0u; index < light_count(); ++index) {
        LightSample light = light_at(index, position_in_world);
        vec3 l = light.direction_in_world * f.world_from_tangent;
        if (l.z <= 0.0) { continue; }
        vec3 brdf = vec3(0.0);
        vec3 left = vec3(1.0);
        if (NARROW) {
            brdf += weave_times_cosine(narrow, v, l);
            left -= weave_albedo(narrow, l);
        }
        if (SECONDARY) {
            brdf += weave_times_cosine(wide, v, l);
            left -= weave_albedo(wide, l);
        }
        sum += light.irradiance * (brdf + coupled * left * l.z);
    }
    return sum;
}

vec3 classic_times_cosine(vec3 f0, float roughness, float anisotropy, vec3 v, vec3 l) {
    return satin_classic_times_cosine(f0, satin_classic_alpha(roughness, anisotropy), v, l);
}

vec3 classic_environment(SurfaceFragment f, vec3 f0, float roughness, float anisotropy, vec3 tint) {
    vec3 v = f.eye_in_tangent;
    vec2 alpha = satin_classic_alpha(roughness, anisotropy);
    vec2 terms = anisotropic_albedo_terms(v, min(alpha, 1.0));
    vec3 albedo = (f0 + (1.0 - f0) * terms.y) * (terms.x * alpha.x * alpha.y);
    vec3 light = mirrored_light_along(f, f.world_from_tangent, v, min(alpha, 1.0), f0);
    return satin_classic_light(tint, light, satin.light_tint) * albedo;
}

vec3 classic_reflected(SurfaceFragment f, float noise) {
    vec3 v = f.eye_in_tangent;
    vec3 f0 = mix(vec3(0.04), f.base_color, f.metallic);
    vec3 diffuse = f.base_color * (1.0 - f.metallic);
    float strength = satin.specular_strength * noise;
    float wide_roughness = min(f.roughness * satin.secondary_width, 1.0);
    float a = satin.anisotropy;
    vec3 sum = diffuse_light(f, diffuse) * diffuse;
    if (NARROW) {
        sum += strength * classic_environment(f, f0, f.roughness, a, satin.specular_color);
        if (TWO_WAY) { sum += strength * classic_environment(f, f0, f.roughness, -a, satin.specular_color); }
    }
    if (SECONDARY) {
        sum += strength * classic_environment(f, f0, wide_roughness, a, satin.secondary_color);
        if (TWO_WAY) { sum += strength * classic_environment(f, f0, wide_roughness, -a, satin.secondary_color); }
    }
    for (uint index = 0u; index < light_count(); ++index) {
        LightSample light = light_at(index, position_in_world);
        vec3 l = light.direction_in_world * f.world_from_tangent;
        if (l.z <= 0.0) { continue; }
        sum += light.irradiance * diffuse * (0.318309886 * l.z);
        if (NARROW) {
            vec3 lobe = classic_times_cosine(f0, f.roughness, a, v, l);
            if (TWO_WAY) { lobe += classic_times_cosine(f0, f.roughness, -a, v, l); }
            sum += satin_classic_light(satin.specular_color, light.irradiance, satin.light_tint) * (strength * lobe);
        }
        if (SECONDARY) {
            vec3 lobe = classic_times_cosine(f0, wide_roughness, a, v, l);
            if (TWO_WAY) { lobe += classic_times_cosine(f0, wide_roughness, -a, v, l); }
            sum += satin_classic_light(satin.secondary_color, light.irradiance, satin.light_tint) * (strength * lobe);
        }
    }
    return sum;
}

void main() {
    vec4 color = surface_color();
    int mask = surface_mask(color.a);
    SurfaceFragment f = surface_fragment(color);
    float noise = 1.0;
#ifdef MAPS
    if (HAS_SPECULAR_NOISE_MAP) {
        vec2 uv = uv_transformed(satin.specular_noise_transform, uv_sets.xy, uv_sets.zw);
        noise = satin_noise(texture(sampler2D(specular_noise_map, specular_noise_sampler), uv).r);
    }
#endif
    vec3 sum = CLASSIC ? classic_reflected(f, noise) : reflected(f, noise);
    surface_write(f, sum, surface_opacity(color.a));
    surface_cover(mask);
}
