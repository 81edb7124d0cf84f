// What every surface shader has in common: bindings and inputs, the base colour, coverage, the shading frame, and what
// the maps of the standard material say of a fragment. A family's fragment shader defines CLOTH before it includes this
// and then finds the threads' tangent in the frame; the standard surface takes any frame around the normal.
#ifndef VAIR_SURFACE_GLSL
#define VAIR_SURFACE_GLSL
#include "frame.glsl"
#include "standard_material.glsl"
#include "direction.glsl"
#include "uv.glsl"
#include "hash.glsl"
#include "coverage.glsl"
#include "object.glsl"
#ifdef COUNT
#define UNLIT
#include "count.glsl"
#endif
#ifdef LIST
#include "oit_append.glsl"
#endif

layout(constant_id = 0) const uint ALPHA_MODE = 0; // 0 opaque, 1 mask, 2 blend
layout(constant_id = 1) const uint SAMPLE_COUNT = 1;
layout(constant_id = 2) const bool DOUBLE_SIDED = false;
layout(constant_id = 3) const bool HAS_BASE_COLOR_MAP = false;
layout(constant_id = 4) const bool HAS_METALLIC_ROUGHNESS_MAP = false;
layout(constant_id = 5) const bool HAS_OCCLUSION_MAP = false;
layout(constant_id = 6) const bool HAS_EMISSIVE_MAP = false;
layout(constant_id = 7) const bool HAS_NORMAL_MAP = false;
layout(constant_id = 8) const bool HAS_DETAIL_ALBEDO_MAP = false;
layout(constant_id = 9) const bool HAS_DETAIL_NORMAL_MAP = false;

layout(set = 1, binding = 0, std140) uniform StandardBlock { StandardUniforms material; };
#ifdef UNLIT
layout(set = 0, binding = 0, std140) uniform FrameBlock { FrameUniforms frame; };
#else
#include "lighting.glsl"
#endif
#ifdef UV
layout(set = 1, binding = 1) uniform texture2D base_color_map;
layout(set = 1, binding = 2) uniform sampler base_color_sampler;
#ifndef UNLIT
layout(set = 1, binding = 3) uniform texture2D metallic_roughness_map;
layout(set = 1, binding = 4) uniform sampler metallic_roughness_sampler;
layout(set = 1, binding = 5) uniform texture2D occlusion_map;
layout(set = 1, binding = 6) uniform sampler occlusion_sampler;
layout(set = 1, binding = 7) uniform texture2D emissive_map;
layout(set = 1, binding = 8) uniform sampler emissive_sampler;
#endif
#endif
#if defined UV && defined TANGENT
layout(set = 1, binding = 9) uniform texture2D normal_map;
layout(set = 1, binding = 10) uniform sampler normal_sampler;
#endif
#ifdef DETAIL
layout(set = 1, binding = 11) uniform texture2D detail_albedo_map;
layout(set = 1, binding = 12) uniform sampler detail_albedo_sampler;
layout(set = 1, binding = 13) uniform texture2D detail_normal_map;
layout(set = 1, binding = 14) uniform sampler detail_normal_sampler;
#endif

layout(location = 0) in vec3 position_in_world;
#ifndef UNLIT
layout(location = 1) in vec3 normal_in_world;
#endif
#ifdef UV
layout(location = 2) in vec4 uv_sets;
#endif
#ifdef TANGENT
layout(location = 3) in vec4 tangent_in_world;
#endif
#ifdef COLOR
layout(location = 4) in vec4 vertex_color;
#endif

#ifdef UNLIT
layout(push_constant) uniform DrawBlock { ObjectDraw draw; };
#endif

#ifndef SHADOW
layout(location = 0) out vec4 radiance;
#endif
#ifdef LIST
// What surface_output was given.
vec3 listed_radiance;
vec3 listed_transmittance;
#endif

// Linear RGBA before coverage.
vec4 surface_color() {
    vec4 color = material.base_color;
#ifdef COLOR
    color *= vertex_color;
#endif
#ifdef UV
    if (HAS_BASE_COLOR_MAP) {
        vec2 uv = uv_transformed(material.base_color_transform, uv_sets.xy, uv_sets.zw);
        color *= texture(sampler2D(base_color_map, base_color_sampler), uv);
    }
#endif
#ifdef DETAIL
    if (HAS_DETAIL_ALBEDO_MAP) {
        vec2 uv = uv_transformed(material.detail_albedo_transform, uv_sets.xy, uv_sets.zw);
        // Twice the map, so that mid grey (0.2140 linear, 0.5 stored) leaves the base colour as it is.
        vec3 detail = texture(sampler2D(detail_albedo_map, detail_albedo_sampler), uv).rgb;
        color.rgb = clamp(color.rgb * detail * 4.6716, 0.0, 1.0);
    }
#endif
    return color;
}

#ifndef UNLIT
vec3 shading_normal(vec3 geometric_normal) {
#if defined UV && defined TANGENT
    vec3 in_tangent = vec3(0.0, 0.0, 1.0);
    if (HAS_NORMAL_MAP) {
        vec2 uv = uv_transformed(material.normal_transform, uv_sets.xy, uv_sets.zw);
        in_tangent = texture(sampler2D(normal_map, normal_sampler), uv).xyz * 2.0 - 1.0;
        in_tangent.xy *= material.normal_scale;
    }
#ifdef DETAIL
    if (HAS_DETAIL_NORMAL_MAP) {
        vec2 uv = uv_transformed(material.detail_normal_transform, uv_sets.xy, uv_sets.zw);
        vec3 detail = texture(sampler2D(detail_normal_map, detail_normal_sampler), uv).xyz * 2.0 - 1.0;
        detail.xy *= material.detail_normal_scale;
        // "Whiteout" blend (Barre-Brisebois & Hill 2012, "Blending in Detail"): slopes add.
        in_tangent = vec3(in_tangent.xy + detail.xy, in_tangent.z * detail.z);
    }
#endif
    vec3 tangent = tangent_in_world.xyz;
    // The interpolated vectors are used as they are (MikkTSpace), so that baked maps decode exactly.
    vec3 bitangent = tangent_in_world.w * cross(normal_in_world, tangent);
    vec3 mapped = in_tangent.x * tangent + in_tangent.y * bitangent + in_tangent.z * normal_in_world;
    float length_squared = dot(mapped, mapped);
    if (length_squared > 1e-20) {
        mapped *= inversesqrt(length_squared);
        return dot(mapped, mapped) > 0.5 ? mapped : geometric_normal;
    }
#endif
    return geometric_normal;
}
#endif

// Samples that a masked surface covers, all of them otherwise.
int surface_mask(float alpha) {
    uint mode = ALPHA_MODE;
    uint samples = SAMPLE_COUNT;
    if (mode != 1u) { return -1; }
    // One pixel wide at the edge, so that several samples smooth it.
    float slope = max(fwidth(alpha), 1e-4);
    float edge = samples == 1u ? (alpha >= material.alpha_cutoff ? 1.0 : 0.0)
                               : clamp((alpha - material.alpha_cutoff) / slope + 0.5, 0.0, 1.0);
    return coverage_mask(edge, samples, 0.5, 0.0);
}

float surface_opacity(float alpha) {
    uint mode = ALPHA_MODE;
    return mode == 2u ? clamp(alpha, 0.0, 1.0) : 1.0;
}

#ifndef SHADOW
// All that a surface shows: linear radiance, premultiplied by its opacity, and the share of what lies behind that it lets
// through, by channel.
void surface_output(vec3 premultiplied, vec3 transmittance) {
#ifdef LIST
    listed_radiance = premultiplied;
    listed_transmittance = transmittance;
#else
    float opacity = 1.0 - (transmittance.r + transmittance.g + transmittance.b) * (1.0 / 3.0);
    radiance = vec4(min(premultiplied * frame.pre_exposure, vec3(RADIANCE_LIMIT)), opacity);
#endif
}
#endif

#ifndef UNLIT
#ifdef OCCLUDED
ShadowReceiver shadow_receiver() {
    ShadowReceiver receiver;
    receiver.normal_in_world = direction_or(normal_in_world, frame.view_in_world);
    receiver.depth_m = 0.0;
    return receiver;
}
#endif

// What the maps say of a fragment. The tangent frame is orthonormal; the eye is above the horizon.
struct SurfaceFragment {
    vec3 base_color;           // linear, [0, 1]
    float metallic;
    float roughness;           // perceptual
    float occlusion;           // share of the ambient light that arrives, by map and screen
    vec3 emissive;             // linear radiance
    vec3 normal_in_world;      // interpolated, turned to the side that is seen; the maps have not bent it
    mat3 world_from_tangent;   // columns: tangent, bitangent, shading normal; CLOTH: along u and v, on both sides
    vec3 eye_in_tangent;       // unit, z >= 1e-3
};

SurfaceFragment surface_fragment(vec4 color) {
    SurfaceFragment f;
    f.base_color = clamp(color.rgb, 0.0, 1.0);
    f.metallic = material.metallic;
    f.roughness = material.roughness;
    // The screen knows what is nearest and opaque, not what blends before it.
    uint mode = ALPHA_MODE;
    f.occlusion = mode == 2u ? 1.0 : screen_occlusion();
    f.emissive = material.emissive;
#ifdef UV
    if (HAS_METALLIC_ROUGHNESS_MAP) {
        vec2 uv = uv_transformed(material.metallic_roughness_transform, uv_sets.xy, uv_sets.zw);
        vec4 map = texture(sampler2D(metallic_roughness_map, metallic_roughness_sampler), uv);
        f.roughness *= map.g;
        f.metallic *= map.b;
    }
    if (HAS_OCCLUSION_MAP) {
        vec2 uv = uv_transformed(material.occlusion_transform, uv_sets.xy, uv_sets.zw);
        float map = texture(sampler2D(occlusion_map, occlusion_sampler), uv).r;
        f.occlusion *= 1.0 + material.occlusion_strength * (map - 1.0);
    }
    if (HAS_EMISSIVE_MAP) {
        vec2 uv = uv_transformed(material.emissive_transform, uv_sets.xy, uv_sets.zw);
        f.emissive *= texture(sampler2D(emissive_map, emissive_sampler), uv).rgb;
    }
#endif
    f.normal_in_world = direction_or(normal_in_world, frame.view_in_world);
    vec3 normal = shading_normal(f.normal_in_world);
    if (DOUBLE_SIDED && !gl_FrontFacing) {
        f.normal_in_world = -f.normal_in_world;
        normal = -normal;
    }
#ifdef CLOTH
    // Threads run the same way on both sides: the bitangent does not turn with the normal.
    bool turned = DOUBLE_SIDED && !gl_FrontFacing;
    f.world_from_tangent =
        direction_frame_along(normal, tangent_in_world.xyz, turned ? -tangent_in_world.w : tangent_in_world.w);
#else
    f.world_from_tangent = direction_frame(normal);
#endif
    vec3 to_eye = frame.orthographic > 0.5 ? frame.view_in_world : direction_or(frame.eye_in_world - position_in_world, normal);
    f.eye_in_tangent = to_eye * f.world_from_tangent;
    // A bent normal may turn away from the eye; grazing is then the nearest view that has a meaning.
    f.eye_in_tangent.z = max(f.eye_in_tangent.z, 1e-3);
    return f;
}

// `reflected` is what the lights and the environment give.
void surface_write(SurfaceFragment f, vec3 reflected, float opacity) {
    surface_output(min(reflected + f.emissive, vec3(RADIANCE_LIMIT)) * opacity, vec3(1.0 - opacity));
}
#endif

// Last: the textures above need all neighbours for their derivatives.
void surface_cover(int mask) {
#ifdef LIST
    uint samples = uint(mask) & uint(gl_SampleMaskIn[0]);
    radiance = list_append(listed_radiance, listed_transmittance, list_slope(), samples, draw.rank);
#endif
    if (mask == 0) { discard; }
    gl_SampleMask[0] = mask;
}

#endif
