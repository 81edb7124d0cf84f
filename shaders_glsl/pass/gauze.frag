#version 460
#extension GL_GOOGLE_include_directive : require
// Gauze: organza, chiffon, tulle. Blends: what it writes is premultiplied, and its holes show what lies behind.
#define CLOTH
#include "surface.glsl"
#include "gauze_threads.glsl"
#include "anisotropy.glsl"
#include "environment_light.glsl"

// The frame of those threads.
mat3 turned_frame(mat3 world_from_tangent) {
    vec2 turn = gauze.thread_turn;
    vec3 along = turn.x * world_from_tangent[0] + turn.y * world_from_tangent[1];
    vec3 across = turn.x * world_from_tangent[1] - turn.y * world_from_tangent[0];
    return mat3(along, across, world_from_tangent[2]);
}

// Premultiplied by the opacity along the view, before the mesh and the transmittance.
vec3 reflected(SurfaceFragment f, Threads t, float depth) {
    vec3 v = f.eye_in_tangent;
    vec3 diffuse = f.base_color * (1.0 - f.metallic);
    AnisotropicLobe warp;
    AnisotropicLobe weft;
    vec3 albedo = vec3(0.0);
    vec3 average = vec3(0.0);
    vec3 mirrored_by_threads = vec3(0.0);
    if (HIGHLIGHT) {
        vec2 alpha = ggx_anisotropic_alpha(f.roughness, gauze.anisotropy);
        vec3 reflectance = gauze.specular * t.noise;
        vec3 f0 = mix(satin_f0(reflectance, 1.0), f.base_color * satin_metal(reflectance), f.metallic);
        float f90 = satin_f90(f0);
        warp = anisotropic_lobe(v, alpha, f0, f90);
        albedo = anisotropic_lobe_albedo(warp, v);
        average = anisotropic_lobe_average_albedo(warp);
        mirrored_by_threads = mirrored_light_along(f, f.world_from_tangent, v, alpha, f0);
        if (HAS_THREAD_PATTERN_MAP) {
            weft = anisotropic_lobe(turned(v), alpha, f0, f90);
            albedo = mix(albedo, anisotropic_lobe_albedo(weft, turned(v)), t.turned);
            vec3 by_weft = mirrored_light_along(f, turned_frame(f.world_from_tangent), turned(v), alpha, f0);
            mirrored_by_threads = mix(mirrored_by_threads, by_weft, t.turned);
        }
    }
    GauzeSurface surface = gauze_surface(diffuse, depth, gauze.mean_opacity, albedo, average);
    // Of even light from behind comes through what light of 60 degrees does, which is the middle of its irradiance.
    float through = gauze_through(depth, depth_along(vec3(0.612372436, 0.612372436, 0.5)));
    vec3 sum = gauze_ambient(surface, albedo, mirrored_by_threads, diffuse_light(f, diffuse), diffuse_light_behind(f, diffuse), through);
    for (uint index = 0u; index < light_count(); ++index) {
        LightSample light = light_at(index, position_in_world);
        vec3 l = light.direction_in_world * f.world_from_tangent;
        vec3 mirrored = vec3(l.xy, abs(l.z));
        float depth_l = depth_along(mirrored);
        vec3 albedo_l = vec3(0.0);
        vec3 bsdf = vec3(0.0);
        if (HIGHLIGHT) {
            albedo_l = anisotropic_lobe_albedo(warp, mirrored);
            vec3 lobe = anisotropic_lobe_times_cosine(warp, v, l);
            if (HAS_THREAD_PATTERN_MAP) {
                albedo_l = mix(albedo_l, anisotropic_lobe_albedo(weft, turned(mirrored)), t.turned);
                lobe = mix(lobe, anisotropic_lobe_times_cosine(weft, turned(v), turned(l)), t.turned);
            }
            bsdf = lobe * gauze_met_by_both(surface.opacity, gauze_opacity(depth_l));
        }
        bsdf += gauze_diffuse_times_cosine(surface, depth_l, l.z, albedo_l);
        sum += light.irradiance * bsdf;
    }
    return sum;
}

// The highlight of classic satin under the scatter colour, on Lambert; times the opacity, as older engines blend.
vec3 classic_lobe(SurfaceFragment f, Threads t, vec2 alpha, vec3 v, vec3 l) {
    vec3 f0 = mix(vec3(0.04), f.base_color, f.metallic);
    // The block holds 0.04 times the tint, which is what the default form asks for.
    return satin_classic_times_cosine(f0, alpha, v, l) * gauze.specular * (25.0 * t.noise);
}

vec3 classic_reflected(SurfaceFragment f, Threads t, float opacity) {
    bool other = t.turned > 0.5;
    vec3 v = other ? turned(f.eye_in_tangent) : f.eye_in_tangent;
    vec2 alpha = satin_classic_alpha(f.roughness, gauze.anisotropy);
    vec3 diffuse = f.base_color * (1.0 - f.metallic);
    vec3 sum = diffuse_light(f, diffuse) * diffuse;
    for (uint index = 0u; index < light_count(); ++index) {
        LightSample light = light_at(index, position_in_world);
        vec3 l = light.direction_in_world * f.world_from_tangent;
        if (l.z <= 0.0) { continue; }
        vec3 brdf = diffuse * (0.318309886 * l.z);
        if (HIGHLIGHT) { brdf += classic_lobe(f, t, alpha, v, other ? turned(l) : l); }
        sum += light.irradiance * brdf;
    }
    return sum * opacity;
}

void main() {
    vec4 color = surface_color();
    int mask = surface_mask(color.a);
    SurfaceFragment f = surface_fragment(color);
    Threads t = threads();
    float cover = t.mesh * gauze.cover * surface_opacity(color.a);
    float opacity;
    vec3 sum;
    if (CLASSIC) {
        opacity = gauze_classic_opacity(gauze.weave, f.eye_in_tangent.z);
        sum = classic_reflected(f, t, opacity);
    } else {
        float depth = depth_along(f.eye_in_tangent);
        opacity = gauze_opacity(depth);
        sum = reflected(f, t, depth);
    }
    surface_output((sum + f.emissive * opacity) * cover, vec3(1.0 - opacity * cover));
    surface_cover(mask);
}
