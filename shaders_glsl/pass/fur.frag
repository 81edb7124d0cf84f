#version 460
#extension GL_GOOGLE_include_directive : require
// One shell layer of fur: which strands cut it here, and the light they send to the eye.
#include "frame.glsl"
#include "standard_material.glsl"
#include "fur_material.glsl"
#include "light.glsl"
#include "uv.glsl"
#include "direction.glsl"
#include "hash.glsl"
#include "strand.glsl"
#include "lock.glsl"
#include "coverage.glsl"
#ifdef COUNT
#include "count.glsl"
#endif

layout(constant_id = 2) const bool PROJECT_UV = false;   // the mesh has no UVs
layout(constant_id = 5) const uint SAMPLE_COUNT = 1;
layout(constant_id = 6) const bool BLEND = false;            // 1: over-blending instead of sample coverage
layout(constant_id = 7) const bool PARABOLOID = false;
layout(constant_id = 8) const bool HAS_DISTRIBUTION_MAP = false;
layout(constant_id = 9) const bool HAS_BASE_COLOR_MAP = false;
layout(constant_id = 10) const bool HAS_SPOT_MAP = false;
layout(constant_id = 11) const bool HAS_LOCKS = false;       // clump or curl
layout(constant_id = 12) const bool KEEP_PARTIAL = false;    // partial opacity near by, too, not only far away
layout(constant_id = 14) const uint SAMPLING = 0;            // 0 slab, 1 point
layout(constant_id = 15) const uint ALPHA = 0;               // 0 correlated between shells, 1 each shell alone, 2 step

layout(set = 0, binding = 0, std140) uniform FrameBlock { FrameUniforms frame; };
layout(set = 0, binding = 1, std430) readonly buffer LightList { LightSource lights[]; };
layout(set = 1, binding = 0, std140) uniform FurBlock { FurUniforms fur; };
#ifdef MAPS
layout(set = 1, binding = 3) uniform texture2D distribution_map;
layout(set = 1, binding = 4) uniform sampler distribution_sampler;
layout(set = 1, binding = 5) uniform texture2D base_color_map;
layout(set = 1, binding = 6) uniform sampler base_color_sampler;
layout(set = 1, binding = 7) uniform texture2D spot_map;
layout(set = 1, binding = 8) uniform sampler spot_sampler;
#endif

layout(location = 0) in vec3 position_in_world;
layout(location = 1) in vec3 root_direction_in_world;
layout(location = 2) in vec3 strand_in_world;
layout(location = 3) in vec3 root_in_rest;
layout(location = 4) in vec3 direction_in_rest;
layout(location = 5) in vec2 height_and_length;
#ifdef MAPS
layout(location = 6) in vec4 interpolated_uv_sets;
#endif
#ifdef COLOR
layout(location = 7) in vec3 vertex_color;
#endif

layout(location = 0) out vec4 radiance;

// A vector of the shell's surface, given by how far it goes along the pixel's two steps.
vec2 in_pixel_steps(vec3 vector, vec3 step_x, vec3 step_y) {
    float xx = dot(step_x, step_x);
    float xy = dot(step_x, step_y);
    float yy = dot(step_y, step_y);
    float determinant = xx * yy - xy * xy;
    if (determinant <= 1e-6 * xx * yy) { return vec2(0.0); }
    vec2 right = vec2(dot(vector, step_x), dot(vector, step_y));
    return vec2(right.x * yy - right.y * xy, right.y * xx - right.x * xy) / determinant;
}

void main() {
    float height = height_and_length.x;
    vec3 normal = direction_or(root_direction_in_world, frame.view_in_world);
    vec3 strand = direction_or(strand_in_world, normal);
    vec3 to_eye = frame.orthographic > 0.5 ? frame.view_in_world
                                              : direction_or(frame.eye_in_world - position_in_world, normal);
    float cosine_to_eye = dot(normal, to_eye);

    // The shell stands for a slab. Through it the view ray shifts, relative to the strands, by half_slab on the
    // surface to either side of the middle.
    vec3 step_x = dFdx(position_in_world);
    vec3 step_y = dFdy(position_in_world);
    float slab_m = height_and_length.y / float(fur.layers);
    float along_strand = max(dot(strand, normal), 0.1);
    // Shells that face away are drawn, too: past the outline their strands stand out over it.
    float along_ray = cosine_to_eye < 0.0 ? min(cosine_to_eye, -0.05) : max(cosine_to_eye, 0.05);
    vec3 half_slab = 0.5 * slab_m * (to_eye / along_ray - strand / along_strand);
    vec2 in_steps = in_pixel_steps(half_slab, step_x, step_y);

    float threshold = strand_threshold(height, fur.cutoff_start, fur.cutoff_end, PARABOLOID) + 0.5 * fur.taper * height * height;
    vec3 rest_x = dFdx(root_in_rest);
    vec3 rest_y = dFdy(root_in_rest);
    // The narrower side of the pixel: the wider one, at grazing angles, runs along the slab's segment.
    float pixel_in_rest = sqrt(min(dot(rest_x, rest_x), dot(rest_y, rest_y)));
#ifdef MAPS
    // Taken here: after a discard the neighbours that a derivative needs may be gone.
    vec4 uv_sets_x = dFdx(interpolated_uv_sets);
    vec4 uv_sets_y = dFdy(interpolated_uv_sets);
    vec4 uv_sets = interpolated_uv_sets;
    if (PROJECT_UV) {
        // Here and not at the vertices: a triangle may span two sides of the box. The changes take this pixel's side.
        uv_sets = vec4(uv_projected(root_in_rest, direction_in_rest) * fur.projection_scale, 0.0, 0.0);
        uv_sets_x = vec4(uv_projected(rest_x, direction_in_rest) * fur.projection_scale, 0.0, 0.0);
        uv_sets_y = vec4(uv_projected(rest_y, direction_in_rest) * fur.projection_scale, 0.0, 0.0);
    }
#endif
    float own_random = 0.5;
    float opacity;
    float slope;
#ifdef MAPS
    if (HAS_DISTRIBUTION_MAP) {
        vec2 map_uv = uv_transformed(fur.distribution_transform, uv_sets.xy, uv_sets.zw);
        vec2 gradient_x = uv_gradient(fur.distribution_transform, uv_sets_x);
        vec2 gradient_y = uv_gradient(fur.distribution_transform, uv_sets_y);
        float map = textureGrad(sampler2D(distribution_map, distribution_sampler), map_uv, gradient_x, gradient_y).r;
        // A map is 0 between strands, however far they are: the edge must end there.
        slope = min(fwidth(map), 2.0 * threshold);
        opacity = strand_opacity(map, threshold, slope, map >= threshold ? 1.0 : 0.0);
        own_random = hash_cell(ivec3(floor(map_uv * 64.0), 0)).x;
    } else
#endif
    {
        float cells_per_unit = 1.0 / fur.strand_spacing;
        vec3 rest_normal = direction_or(direction_in_rest, vec3(0.0, 1.0, 0.0));
        vec3 half_segment = (in_steps.x * rest_x + in_steps.y * rest_y) * cells_per_unit;
        if (SAMPLING == 1u) { half_segment = vec3(0.0); }
        float half_length = length(half_segment);
        float seen_length = min(half_length, STRAND_SEGMENT);
        half_segment *= seen_length / max(half_length, 1e-6);
        vec3 in_cells = root_in_rest * cells_per_unit;
        if (HAS_LOCKS) { in_cells = lock_root(in_cells, rest_normal, height, fur.clump, fur.curl); }
        StrandSample field = strand_field(in_cells, rest_normal, fur.strand_radius, half_segment);
        slope = pixel_in_rest * cells_per_unit / fur.strand_radius;
        opacity = strand_opacity(field.profile, threshold, slope,
                                 strand_mean_coverage(threshold, fur.strand_radius, seen_length));
        // Strands along the rest of a grazing ray: what they hide is known, if not where they stand.
        float hidden = 1.0 - strand_mean_coverage(threshold, fur.strand_radius, half_length);
        float seen = 1.0 - strand_mean_coverage(threshold, fur.strand_radius, seen_length);
        opacity = 1.0 - (1.0 - opacity) * (hidden / seen);
        if (ALPHA == 2u) { opacity = field.profile >= threshold ? 1.0 : 0.0; }
        own_random = field.random;
    }
    // Each factor lies in [0, 1], so their product does.
    opacity *= (1.0 - fur.tip_fade * height) * mix(1.0, clamp(cosine_to_eye, 0.0, 1.0), fur.edge_fade);

    uint samples = SAMPLE_COUNT;
    float unresolved = strand_unresolved(slope);
    int mask = -1;
    if (BLEND) {
        mask = opacity > 0.0 ? -1 : 0;
    } else {
        // Where strands are smaller than pixels, and where partial opacity is wanted, grain keeps its mean.
        vec2 grain = coverage_grain(root_in_rest, pixel_in_rest);
        float rounding = mix(0.5, grain.x, KEEP_PARTIAL ? 1.0 : unresolved);
        mask = coverage_mask(opacity, samples, rounding, grain.y);
    }
#ifdef COUNT
    count_fragment(uint(mask), samples, !BLEND);
    radiance = vec4(1.0);
    if (mask == 0) { discard; }
#else
    if (mask == 0) { discard; }
    gl_SampleMask[0] = mask;

    vec3 color = fur.base_color;
#ifdef COLOR
    color *= vertex_color;
#endif
#ifdef MAPS
    if (HAS_BASE_COLOR_MAP) {
        vec2 uv = uv_transformed(fur.base_color_transform, uv_sets.xy, uv_sets.zw);
        vec2 gradient_x = uv_gradient(fur.base_color_transform, uv_sets_x);
        vec2 gradient_y = uv_gradient(fur.base_color_transform, uv_sets_y);
        color *= textureGrad(sampler2D(base_color_map, base_color_sampler), uv, gradient_x, gradient_y).rgb;
    }
    if (HAS_SPOT_MAP) {
        vec2 uv = uv_transformed(fur.spot_transform, uv_sets.xy, uv_sets.zw);
        vec2 gradient_x = uv_gradient(fur.spot_transform, uv_sets_x);
        vec2 gradient_y = uv_gradient(fur.spot_transform, uv_sets_y);
        color = mix(color, fur.spot_color, textureGrad(sampler2D(spot_map, spot_sampler), uv, gradient_x, gradient_y).r);
    }
#endif
    color *= mix(fur.root_color, fur.tip_color, height);
    color = min(color * (1.0 + fur.color_variation * (own_random * 2.0 - 1.0)), vec3(1.0));

    float variance = strand_variance(fur.roughness);
    vec3 sum = frame.ambient_radiance * color * mix(1.0 - fur.occlusion, 1.0, height);
    for (uint index = 0u; index < frame.light_count; ++index) {
        LightSample light = light_sample(lights[index], position_in_world);
        float through = strand_light_through_coat(height, fur.occlusion, dot(normal, light.direction_in_world));
        vec3 scattered = strand_scattering(color, normal, strand, to_eye, light.direction_in_world, fur.specular, variance);
        sum += light.irradiance * through * scattered;
    }
    sum = min(sum, vec3(RADIANCE_LIMIT));
    radiance = BLEND ? vec4(sum * opacity, opacity) : vec4(sum, 1.0);
#endif
}
