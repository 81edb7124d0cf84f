#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
// One shell of fur that casts a shadow, by how densely its strands stand: single ones are finer than texels.
#include "frame.glsl"
#include "object.glsl"
#include "standard_material.glsl"
#include "fur_material.glsl"
#include "uv.glsl"
#include "direction.glsl"
#include "strand.glsl"
#include "shadow_output.glsl"

layout(constant_id = 2) const bool PROJECT_UV = false;
layout(constant_id = 7) const bool PARABOLOID = false;
layout(constant_id = 8) const bool HAS_DISTRIBUTION_MAP = false;

layout(set = 0, binding = 0, std140) uniform FrameBlock { FrameUniforms frame; };
layout(set = 1, binding = 0, std140) uniform FurBlock { FurUniforms fur; };
layout(set = 2, binding = 0, std430) readonly buffer ObjectList { ObjectUniforms objects[]; };
layout(push_constant) uniform DrawBlock { ObjectDraw draw; };
#ifdef MAPS
layout(set = 1, binding = 3) uniform texture2D distribution_map;
layout(set = 1, binding = 4) uniform sampler distribution_sampler;
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

float threshold_at(float height) {
    return strand_threshold(height, fur.cutoff_start, fur.cutoff_end, PARABOLOID) + 0.5 * fur.taper * height * height;
}

void main() {
    float height = height_and_length.x;
    vec3 normal = direction_or(root_direction_in_world, frame.view_in_world);
    vec3 strand = direction_or(strand_in_world, normal);
    vec3 to_light = frame.orthographic > 0.5 ? frame.view_in_world : direction_or(frame.eye_in_world - position_in_world, normal);
    float slab_height = 1.0 / float(fur.layers);
    float upper = threshold_at(height);
    float lower = threshold_at(height - slab_height);
    float depth;
#ifdef MAPS
    if (HAS_DISTRIBUTION_MAP) {
        vec4 uv_sets = interpolated_uv_sets;
        if (PROJECT_UV) {
            uv_sets = vec4(uv_projected(root_in_rest, direction_in_rest) * fur.projection_scale, 0.0, 0.0);
        }
        vec2 uv = uv_transformed(fur.distribution_transform, uv_sets.xy, uv_sets.zw);
        float margin = texture(sampler2D(distribution_map, distribution_sampler), uv).r - 0.5 * (lower + upper);
        depth = SHADOW_OPAQUE_DEPTH * strand_opacity(margin, fwidth(margin), margin >= 0.0 ? 1.0 : 0.0);
    } else
#endif
    {
        // Light from above meets the caps that no slab above has covered; from anywhere it meets sides.
        bool is_outermost = uint(height * float(fur.layers) + 0.5) == fur.layers;
        float above = is_outermost ? 0.0 : strand_cross_section(upper, fur.strand_radius);
        float cap = max(strand_cross_section(lower, fur.strand_radius) - above, 0.0);
        float path_m = height_and_length.y * slab_height * max(dot(strand, normal), 0.1) / max(abs(dot(normal, to_light)), 0.1);
        float along = dot(strand, to_light);
        float across_m = path_m * sqrt(max(1.0 - along * along, 0.0));
        float in_cells = across_m / (objects[draw.object_index].world_from_rest * fur.strand_spacing);
        depth = cap + strand_width(0.5 * (lower + upper), fur.strand_radius) * in_cells;
    }
    depth *= height_and_length.y > 0.0 ? 1.0 - fur.tip_fade * height : 0.0;
    shadow_write(vec3(exp(-depth)));
}
