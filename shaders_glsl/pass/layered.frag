#version 460
#extension GL_GOOGLE_include_directive : require
// Layered: the standard surface with the lobes of glTF's material extensions. Those that are off cost nothing.
#define CLOTH
#include "surface.glsl"
#include "layered_material.glsl"
#include "layered.glsl"
#include "film.glsl"
#include "environment_light.glsl"
#include "transparency.glsl"
#ifdef SHEEN
#include "sheen_table.glsl"
#endif

layout(constant_id = 20) const bool HAS_SPECULAR_MAP = false;
layout(constant_id = 21) const bool HAS_SPECULAR_COLOR_MAP = false;
layout(constant_id = 22) const bool HAS_ANISOTROPY_MAP = false;
layout(constant_id = 23) const bool HAS_IRIDESCENCE_MAP = false;
layout(constant_id = 24) const bool HAS_IRIDESCENCE_THICKNESS_MAP = false;
layout(constant_id = 25) const bool HAS_DIFFUSE_TRANSMISSION_MAP = false;
layout(constant_id = 26) const bool HAS_DIFFUSE_TRANSMISSION_COLOR_MAP = false;
layout(constant_id = 27) const bool HAS_TRANSMISSION_MAP = false;
layout(constant_id = 28) const bool HAS_SHEEN_COLOR_MAP = false;
layout(constant_id = 29) const bool HAS_SHEEN_ROUGHNESS_MAP = false;
layout(constant_id = 30) const bool HAS_CLEARCOAT_MAP = false;
layout(constant_id = 31) const bool HAS_CLEARCOAT_ROUGHNESS_MAP = false;
layout(constant_id = 32) const bool HAS_CLEARCOAT_NORMAL_MAP = false;
layout(constant_id = 33) const bool ANISOTROPY = false;
layout(constant_id = 34) const bool IRIDESCENCE = false;
layout(constant_id = 35) const bool DIFFUSE_TRANSMISSION = false;
layout(constant_id = 36) const bool TRANSMISSION = false;
layout(constant_id = 37) const bool VOLUME = false;    // of a body that transmits
layout(constant_id = 38) const bool CLEARCOAT = false;
layout(constant_id = 39) const bool HAS_THICKNESS_MAP = false;

layout(set = 1, binding = 20, std140) uniform LayeredBlock { LayeredUniforms layered; };
#ifdef MAPS
layout(set = 1, binding = 21) uniform texture2D specular_map;
layout(set = 1, binding = 22) uniform sampler specular_sampler;
layout(set = 1, binding = 23) uniform texture2D specular_color_map;
layout(set = 1, binding = 24) uniform sampler specular_color_sampler;
layout(set = 1, binding = 25) uniform texture2D anisotropy_map;
layout(set = 1, binding = 26) uniform sampler anisotropy_sampler;
layout(set = 1, binding = 27) uniform texture2D iridescence_map;
layout(set = 1, binding = 28) uniform sampler iridescence_sampler;
layout(set = 1, binding = 29) uniform texture2D iridescence_thickness_map;
layout(set = 1, binding = 30) uniform sampler iridescence_thickness_sampler;
layout(set = 1, binding = 31) uniform texture2D diffuse_transmission_map;
layout(set = 1, binding = 32) uniform sampler diffuse_transmission_sampler;
layout(set = 1, binding = 33) uniform texture2D diffuse_transmission_color_map;
layout(set = 1, binding = 34) uniform sampler diffuse_transmission_color_sampler;
layout(set = 1, binding = 35) uniform texture2D transmission_map;
layout(set = 1, binding = 36) uniform sampler transmission_sampler;
layout(set = 1, binding = 37) uniform texture2D sheen_color_map;
layout(set = 1, binding = 38) uniform sampler sheen_color_sampler;
layout(set = 1, binding = 39) uniform texture2D sheen_roughness_map;
layout(set = 1, binding = 40) uniform sampler sheen_roughness_sampler;
layout(set = 1, binding = 41) uniform texture2D clearcoat_map;
layout(set = 1, binding = 42) uniform sampler clearcoat_sampler;
layout(set = 1, binding = 43) uniform texture2D clearcoat_roughness_map;
layout(set = 1, binding = 44) uniform sampler clearcoat_roughness_sampler;
layout(set = 1, binding = 45) uniform texture2D clearcoat_normal_map;
layout(set = 1, binding = 46) uniform sampler clearcoat_normal_sampler;
layout(set = 1, binding = 47) uniform texture2D thickness_map;
layout(set = 1, binding = 48) uniform sampler thickness_sampler;
#define MAP(map, map_sampler, transform) texture(sampler2D(map, map_sampler), uv_transformed(transform, uv_sets.xy, uv_sets.zw))
#endif

// What the material says of a fragment, its maps applied.
struct LayeredFragment {
    vec3 f0;              // of the base, film included
    float f90;
    vec2 widths;          // along and across the streak
    vec2 streak;          // its direction in the surface's tangent frame, unit
    vec3 reflected;       // albedo of what is scattered to this side
    vec3 transmitted;     // and to the other
    float transmission;
    vec3 sheen_color;
    float sheen_roughness;
    float clearcoat;
    float clearcoat_roughness;
};

void anisotropic_streak(SurfaceFragment f, inout LayeredFragment m) {
    m.streak = layered.anisotropy_direction;
    float strength = layered.anisotropy;
#ifdef MAPS
    if (HAS_ANISOTROPY_MAP) {
        vec3 map = MAP(anisotropy_map, anisotropy_sampler, layered.anisotropy_transform).rgb;
        vec2 local = map.rg * 2.0 - 1.0;
        float squared = dot(local, local);
        local = squared > 1e-8 ? local * inversesqrt(squared) : vec2(1.0, 0.0);
        m.streak = mat2(m.streak, vec2(-m.streak.y, m.streak.x)) * local;
        strength *= map.b;
    }
#endif
    m.widths = layered_widths(f.roughness, strength);
}

void dielectric_and_metal(SurfaceFragment f, inout LayeredFragment m) {
    float specular = layered.specular;
    vec3 color = layered.specular_color;
#ifdef MAPS
    if (HAS_SPECULAR_MAP) { specular *= MAP(specular_map, specular_sampler, layered.specular_transform).a; }
    if (HAS_SPECULAR_COLOR_MAP) {
        color *= MAP(specular_color_map, specular_color_sampler, layered.specular_color_transform).rgb;
    }
#endif
    vec3 dielectric = min(layered_f0_of_ior(layered.ior) * color, 1.0) * specular;
    m.f0 = dielectric + (f.base_color - dielectric) * f.metallic;
    m.f90 = specular + (1.0 - specular) * f.metallic;
}

void thin_film(SurfaceFragment f, inout LayeredFragment m) {
    float share = layered.iridescence;
    float thickness_nm = layered.iridescence_thickness_max;
#ifdef MAPS
    if (HAS_IRIDESCENCE_MAP) { share *= MAP(iridescence_map, iridescence_sampler, layered.iridescence_transform).r; }
    if (HAS_IRIDESCENCE_THICKNESS_MAP) {
        float map = MAP(iridescence_thickness_map, iridescence_thickness_sampler, layered.iridescence_thickness_transform).g;
        thickness_nm = mix(layered.iridescence_thickness_min, thickness_nm, map);
    }
#endif
    // By the eye's angle, which is that of what a smooth surface mirrors: so a film costs nothing a light.
    vec3 film = film_reflectance(f.eye_in_tangent.z, thickness_nm, layered.iridescence_ior, m.f0);
    m.f0 = mix(m.f0, film_f0(film, f.eye_in_tangent.z), share);
    m.f90 = mix(m.f90, 1.0, share);
}

void scattered_light(SurfaceFragment f, inout LayeredFragment m) {
    vec3 reflected = f.base_color;
    m.transmitted = vec3(0.0);
    if (DIFFUSE_TRANSMISSION) {
        float share = layered.diffuse_transmission;
        vec3 color = layered.diffuse_transmission_color;
#ifdef MAPS
        if (HAS_DIFFUSE_TRANSMISSION_MAP) {
            share *= MAP(diffuse_transmission_map, diffuse_transmission_sampler, layered.diffuse_transmission_transform).a;
        }
        if (HAS_DIFFUSE_TRANSMISSION_COLOR_MAP) {
            color *= MAP(diffuse_transmission_color_map, diffuse_transmission_color_sampler,
                         layered.diffuse_transmission_color_transform).rgb;
        }
#endif
        reflected *= 1.0 - share;
        m.transmitted = color * share;
    }
    m.transmission = 0.0;
    if (TRANSMISSION) {
        m.transmission = layered.transmission;
#ifdef MAPS
        if (HAS_TRANSMISSION_MAP) {
            m.transmission *= MAP(transmission_map, transmission_sampler, layered.transmission_transform).r;
        }
#endif
    }
    float scattered = (1.0 - f.metallic) * (1.0 - m.transmission);
    m.reflected = reflected * scattered;
    m.transmitted *= scattered;
}

#ifdef SHEEN
void fuzz(inout LayeredFragment m) {
    m.sheen_color = layered.sheen_color;
    m.sheen_roughness = layered.sheen_roughness;
#ifdef MAPS
    if (HAS_SHEEN_COLOR_MAP) {
        m.sheen_color *= MAP(sheen_color_map, sheen_color_sampler, layered.sheen_color_transform).rgb;
    }
    if (HAS_SHEEN_ROUGHNESS_MAP) {
        m.sheen_roughness *= MAP(sheen_roughness_map, sheen_roughness_sampler, layered.sheen_roughness_transform).a;
    }
#endif
}
#endif

void varnish(inout LayeredFragment m) {
    m.clearcoat = layered.clearcoat;
    m.clearcoat_roughness = layered.clearcoat_roughness;
#ifdef MAPS
    if (HAS_CLEARCOAT_MAP) { m.clearcoat *= MAP(clearcoat_map, clearcoat_sampler, layered.clearcoat_transform).r; }
    if (HAS_CLEARCOAT_ROUGHNESS_MAP) {
        m.clearcoat_roughness *= MAP(clearcoat_roughness_map, clearcoat_roughness_sampler, layered.clearcoat_roughness_transform).g;
    }
#endif
}

// The varnish has a normal of its own: that of the mesh, or of its own map.
vec3 varnish_normal(SurfaceFragment f) {
#ifdef MAPS
    if (HAS_CLEARCOAT_NORMAL_MAP) {
        vec3 map = MAP(clearcoat_normal_map, clearcoat_normal_sampler, layered.clearcoat_normal_transform).xyz * 2.0 - 1.0;
        map.xy *= layered.clearcoat_normal_scale;
        vec3 tangent = tangent_in_world.xyz;
        vec3 bitangent = tangent_in_world.w * cross(normal_in_world, tangent);
        vec3 mapped = map.x * tangent + map.y * bitangent + map.z * normal_in_world;
        return direction_or(DOUBLE_SIDED && !gl_FrontFacing ? -mapped : mapped, f.normal_in_world);
    }
#endif
    return f.normal_in_world;
}

// Albedo terms of the base's lobe towards w, of either side.
vec2 base_terms(vec3 w, float roughness, vec2 widths) {
    w.z = abs(w.z);
    return ANISOTROPY ? anisotropic_albedo_terms(w, widths) : ggx_albedo_terms(w.z, roughness);
}

// What a body leaves of the light on its way from the back to the front, where it is seen to leave: straight through, as
// thick as the file says whatever the angle.
vec3 absorbed() {
    float way = gl_FrontFacing ? layered.thickness_over_distance * draw.metres_per_unit : 0.0;
#ifdef MAPS
    if (HAS_THICKNESS_MAP) { way *= MAP(thickness_map, thickness_sampler, layered.thickness_transform).g; }
#endif
    return transparency_attenuation(layered.attenuation_color, way);
}

float largest(vec3 color) {
    return max(max(color.r, color.g), color.b);
}

void main() {
    vec4 color = surface_color();
    int mask = surface_mask(color.a);
    SurfaceFragment f = surface_fragment(color);

    LayeredFragment m;
    m.streak = vec2(1.0, 0.0);
    m.widths = vec2(ggx_alpha(f.roughness));
    if (ANISOTROPY) { anisotropic_streak(f, m); }
    dielectric_and_metal(f, m);
    if (IRIDESCENCE) { thin_film(f, m); }
    scattered_light(f, m);
#ifdef SHEEN
    fuzz(m);
#endif
    if (CLEARCOAT) { varnish(m); }

    mat3 world_from_base = f.world_from_tangent;
    if (ANISOTROPY) {
        vec3 across = vec3(-m.streak.y, m.streak.x, 0.0);
        world_from_base = f.world_from_tangent * mat3(vec3(m.streak, 0.0), across, vec3(0.0, 0.0, 1.0));
    }
    vec3 to_eye = f.world_from_tangent * f.eye_in_tangent;
    vec3 eye = to_eye * world_from_base;
    vec3 averages = ANISOTROPY ? anisotropic_average_terms(m.widths) : ggx_average_terms(f.roughness);
    vec2 terms = base_terms(eye, f.roughness, m.widths);
    LayeredBase base = layered_base(m.f0, m.f90, m.widths, terms, averages, m.reflected, m.transmitted);
    vec3 mirrored = ANISOTROPY ? mirrored_light_along(f, world_from_base, eye, m.widths, m.f0)
                               : mirrored_light(f, world_from_base, eye, f.roughness, m.f0);
    vec3 behind = DIFFUSE_TRANSMISSION ? diffuse_light_behind(f, m.transmitted) : vec3(0.0);
    vec3 sum = layered_base_ambient(base, mirrored, diffuse_light(f, m.reflected), behind);
    vec3 through = TRANSMISSION ? layered_through(m.transmission, f.metallic, f.base_color, base.albedo) : vec3(0.0);
    if (VOLUME) { through *= absorbed(); }

#ifdef SHEEN
    SheenLobe sheen = sheen_table_lobe(SHEEN_CHARLIE, eye, m.sheen_roughness);
    float sheen_strength = largest(m.sheen_color);
    float sheen_albedo = layered_sheen_albedo(sheen.albedo);
    float left_by_sheen = layered_under(sheen_strength, sheen_albedo, 0.0);
    vec3 sheen_light = fuzz_light(f, world_from_base, eye, SHEEN_CHARLIE, m.sheen_roughness, m.sheen_color);
    sum = sum * left_by_sheen + m.sheen_color * sheen.albedo * sheen_light;
    through *= left_by_sheen;
#endif
    mat3 world_from_coat;
    vec3 eye_in_coat;
    float coat_albedo = 0.0;
    float coat_strength = 0.0;
    if (CLEARCOAT) {
        world_from_coat = direction_frame(varnish_normal(f));
        eye_in_coat = to_eye * world_from_coat;
        eye_in_coat.z = max(eye_in_coat.z, 1e-3);
        coat_albedo = layered_coat_albedo(eye_in_coat.z, m.clearcoat_roughness);
        coat_strength = m.clearcoat * layered_coat_compensation(eye_in_coat.z, m.clearcoat_roughness);
        float left = layered_under(m.clearcoat, coat_albedo, 0.0);
        vec3 coat_light = mirrored_light(f, world_from_coat, eye_in_coat, m.clearcoat_roughness, vec3(0.04));
        sum = sum * left + m.clearcoat * coat_albedo * coat_light;
        f.emissive *= left;
        through *= left;
    }

    for (uint index = 0u; index < light_count(); ++index) {
        LightSample light = light_at(index, position_in_world);
        vec3 l = light.direction_in_world * world_from_base;
        vec3 seen = layered_base_times_cosine(base, eye, l, base_terms(l, f.roughness, m.widths));
#ifdef SHEEN
        float sheen_albedo_l = sheen_table_texel(SHEEN_CHARLIE, abs(l.z), m.sheen_roughness).x;
        seen *= layered_under(sheen_strength, sheen_albedo, layered_sheen_albedo(sheen_albedo_l));
        seen += m.sheen_color * sheen_brdf_times_cosine(SHEEN_CHARLIE, sheen, eye, l);
#endif
        if (CLEARCOAT) {
            vec3 l_in_coat = light.direction_in_world * world_from_coat;
            float albedo = layered_coat_albedo(min(abs(l_in_coat.z), 1.0), m.clearcoat_roughness);
            seen *= layered_under(m.clearcoat, coat_albedo, albedo);
            seen += coat_strength * layered_coat_times_cosine(m.clearcoat_roughness, eye_in_coat, l_in_coat);
        }
        sum += light.irradiance * seen;
    }
    float opacity = surface_opacity(color.a);
    surface_output(min(sum + f.emissive, vec3(RADIANCE_LIMIT)) * opacity, vec3(1.0) - opacity * (vec3(1.0) - through));
    surface_cover(mask);
}
