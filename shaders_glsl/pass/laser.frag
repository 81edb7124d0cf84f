#version 460
#extension GL_GOOGLE_include_directive : require
// Laser cloth: a film whose colour follows the angle of view, over the lobes of the standard surface. Painted, it is a
// factor on the base colour; a thin film takes the place of the base's reflectance. Either is evaluated once a fragment.
#define CLOTH
#include "surface.glsl"
#include "laser_material.glsl"
#include "film.glsl"
#include "laser.glsl"
#include "standard_environment.glsl"

layout(constant_id = 20) const bool IS_THIN_FILM = false;
layout(constant_id = 21) const bool IS_SINE = false;
layout(constant_id = 22) const bool IS_DIRECTIONAL = false;
layout(constant_id = 23) const bool CLASSIC = false;
layout(constant_id = 24) const bool HAS_OFFSET_MAP = false;
layout(constant_id = 25) const bool HAS_HUE_RAMP_MAP = false;
layout(constant_id = 26) const bool HAS_DIRECTION_MAP = false;
layout(constant_id = 27) const bool HAS_FILM_THICKNESS_MAP = false;

layout(set = 1, binding = 20, std140) uniform LaserBlock { LaserUniforms laser; };
#ifdef MAPS
layout(set = 1, binding = 21) uniform texture2D offset_map;
layout(set = 1, binding = 22) uniform sampler offset_sampler;
layout(set = 1, binding = 23) uniform texture2D hue_ramp_map;
layout(set = 1, binding = 24) uniform sampler hue_ramp_sampler;
layout(set = 1, binding = 25) uniform texture2D direction_map;
layout(set = 1, binding = 26) uniform sampler direction_sampler;
layout(set = 1, binding = 27) uniform texture2D film_thickness_map;
layout(set = 1, binding = 28) uniform sampler film_thickness_sampler;
#endif

// From 0 (facing) to 1 (grazing).
float view_curve(vec3 eye_in_tangent) {
    vec2 angle = vec2(eye_in_tangent.z, length(eye_in_tangent.xy));
    if (IS_DIRECTIONAL) {
        vec2 axis = laser.direction;
#ifdef MAPS
        if (HAS_DIRECTION_MAP) {
            vec2 uv = uv_transformed(laser.direction_transform, uv_sets.xy, uv_sets.zw);
            float half_turns = texture(sampler2D(direction_map, direction_sampler), uv).r;
            axis = vec2(cos(3.141592654 * half_turns), sin(3.141592654 * half_turns));
        }
#endif
        angle = laser_angle_along(eye_in_tangent, axis);
    }
    return laser_curve(angle, IS_SINE);
}

// Factor on the base colour.
vec3 painted_color(vec3 eye_in_tangent) {
    float u = view_curve(eye_in_tangent);
    vec2 offset = vec2(laser.hue_offset);
#ifdef MAPS
    if (HAS_OFFSET_MAP) {
        vec2 uv = uv_transformed(laser.offset_transform, uv_sets.xy, uv_sets.zw);
        offset += texture(sampler2D(offset_map, offset_sampler), uv).rg;
    }
    if (HAS_HUE_RAMP_MAP) {
        // Between the middles of the outermost texels: the ends do not run into each other.
        float texel = 1.0 / float(textureSize(sampler2D(hue_ramp_map, hue_ramp_sampler), 0).x);
        vec2 at = vec2(mix(0.5 * texel, 1.0 - 0.5 * texel, u), 0.5);
        vec2 uv = uv_transformed(laser.hue_ramp_transform, at, at);
        vec3 painted = texture(sampler2D(hue_ramp_map, hue_ramp_sampler), uv).rgb;
        vec3 color = laser_ramp(painted, offset.x, laser.saturation, laser.brightness);
        if (HAS_OFFSET_MAP) {
            color = 0.5 * (color + laser_ramp(painted, offset.y, laser.saturation, laser.brightness));
        }
        return color;
    }
#endif
    vec2 phase = u * laser.hue_span + offset;
    vec2 change = vec2(0.0);
    if (!CLASSIC) { change = fwidth(phase); }
    vec3 color = laser_wheel(phase.x, change.x, laser.saturation, laser.brightness);
    if (HAS_OFFSET_MAP) {
        color = 0.5 * (color + laser_wheel(phase.y, change.y, laser.saturation, laser.brightness));
    }
    return color;
}

StandardSurface filmed_surface(SurfaceFragment f) {
    float thickness_nm = laser.film_thickness_nm;
#ifdef MAPS
    if (HAS_FILM_THICKNESS_MAP) {
        vec2 uv = uv_transformed(laser.film_thickness_transform, uv_sets.xy, uv_sets.zw);
        float share = texture(sampler2D(film_thickness_map, film_thickness_sampler), uv).g;
        thickness_nm = mix(laser.film_thickness_min_nm, laser.film_thickness_nm, share);
    }
#endif
    float cosine = f.eye_in_tangent.z;
    vec3 base_f0 = laser.base_f0 + (f.base_color - laser.base_f0) * f.metallic;
    vec3 f0 = film_f0(film_reflectance(cosine, thickness_nm, laser.film_ior, base_f0), cosine);
    return standard_coupled(f0, f.base_color * (1.0 - f.metallic), f.roughness, cosine);
}

void main() {
    vec4 color = surface_color();
    int mask = surface_mask(color.a);
    SurfaceFragment f = surface_fragment(color);
    StandardSurface surface;
    if (IS_THIN_FILM) {
        surface = filmed_surface(f);
    } else {
        surface = standard_surface(f.base_color * painted_color(f.eye_in_tangent), f.metallic, f.roughness, f.eye_in_tangent.z);
    }
    vec3 sum = standard_environment(f, surface);
    for (uint index = 0u; index < light_count(); ++index) {
        LightSample light = light_at(index, position_in_world);
        vec3 light_in_tangent = light.direction_in_world * f.world_from_tangent;
        sum += light.irradiance * standard_brdf_times_cosine(surface, f.eye_in_tangent, light_in_tangent);
    }
    surface_write(f, sum, surface_opacity(color.a));
    surface_cover(mask);
}
