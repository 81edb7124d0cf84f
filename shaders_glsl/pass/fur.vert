#version 460
#extension GL_GOOGLE_include_directive : require
// One shell layer per instance; instance 0 is the outermost, so that early depth tests reject what it hides.
#include "frame.glsl"
#include "object.glsl"
#include "standard_material.glsl"
#include "fur_material.glsl"
#include "direction.glsl"
#include "hash.glsl"
#include "strand.glsl"
#include "uv.glsl"
#ifdef MOTION
#include "motion.glsl"
#endif

layout(constant_id = 0) const bool INNER_FIRST = false;    // 1: instance 0 is the innermost (blend mode)
layout(constant_id = 14) const uint SAMPLING = 0;          // 0 slab, 1 point
layout(constant_id = 16) const uint SHELL_SOURCE = 0;      // 0 instance, 1 draw, 2 vertex
layout(constant_id = 2) const bool PROJECT_UV = false;     // 1: the mesh has no UVs
layout(constant_id = 3) const bool HAS_HEIGHT_MAP = false;
layout(constant_id = 13) const bool HAS_COMB_MAP = false; // only with COMB

layout(set = 0, binding = 0, std140) uniform FrameBlock { FrameUniforms frame; };
layout(set = 1, binding = 0, std140) uniform FurBlock { FurUniforms fur; };
layout(set = 2, binding = 0, std430) readonly buffer ObjectList { ObjectUniforms objects[]; };
layout(push_constant) uniform DrawBlock { ObjectDraw draw; };
#ifdef MAPS
layout(set = 1, binding = 1) uniform texture2D height_map;
layout(set = 1, binding = 2) uniform sampler height_sampler;
layout(set = 1, binding = 9) uniform texture2D comb_map;
layout(set = 1, binding = 10) uniform sampler comb_sampler;
#endif

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 shell_direction;
layout(location = 2) in vec3 rest_position;
layout(location = 3) in vec3 rest_direction;
#ifdef MAPS
layout(location = 4) in vec2 uv_0;
layout(location = 6) in vec2 uv_1;
#endif
#ifdef COLOR
layout(location = 5) in vec4 color;
#endif
#ifdef COMB
layout(location = 7) in vec3 shell_side;
#endif
#ifdef STRAND_DYNAMICS
layout(location = 8) in vec3 sway; // force of the strands' own inertia, of length in [0, 1], world space
#endif

#ifdef MOTION
layout(location = 10) in vec3 previous_direction;
#ifdef COMB
layout(location = 11) in vec3 previous_side;
#endif
#endif

layout(location = 0) out vec3 position_in_world;
layout(location = 1) out vec3 root_direction_in_world;
layout(location = 2) out vec3 strand_in_world;      // tangent of the strand at this height
layout(location = 3) out vec3 root_in_rest;
layout(location = 4) out vec3 direction_in_rest;
layout(location = 5) out vec2 height_and_length;    // height in the fur [0, 1], strand length in metres
#ifdef MAPS
layout(location = 6) out vec4 uv_sets;
#endif
#ifdef COLOR
layout(location = 7) out vec3 vertex_color;
#endif

// A place on a strand.
struct StrandPlace {
    vec3 position;             // world space
    vec3 tangent;
};

// What bends strands beside the comb. The strands' own inertia is that of this frame in the previous one, too.
vec3 bending_force() {
    vec3 total = fur.force;
#ifdef STRAND_DYNAMICS
    total += sway;
#endif
    return total;
}

// At a height of the strand that stands on `root`; `side` is the first axis of the comb.
StrandPlace strand_place(vec3 root, vec3 direction, vec3 side, vec2 comb, float height, float strand_length) {
    vec3 total = bending_force();
    side = direction_or(side - dot(side, direction) * direction, vec3(0.0));
    total += comb.x * side + comb.y * cross(direction, side);
    float strength = length(total);
    if (strength > 1.0) { total /= strength; }

    vec3 sideways = direction_or(total - dot(total, direction) * direction, vec3(0.0));
    float angle = strand_bend_angle(direction, total);
    vec2 bent = strand_arc(height, angle);
    return StrandPlace(root + (sideways * bent.x + direction * bent.y) * strand_length,
                       sideways * sin(angle * height) + direction * cos(angle * height));
}

vec3 root_direction(ObjectUniforms object, vec3 direction) {
    return direction_or(mat3(object.normal_from_object) * direction, vec3(0.0, 1.0, 0.0));
}

void main() {
    mat4 world_from_object = objects[draw.object_index].world_from_object;
    vec3 root = (world_from_object * vec4(position, 1.0)).xyz;
    vec3 direction = root_direction(objects[draw.object_index], shell_direction);

    uint shell = uint(gl_InstanceIndex);
    if (SHELL_SOURCE == 1u) { shell = draw.shell; }
    if (SHELL_SOURCE == 2u) { shell = uint(gl_VertexIndex) / draw.vertices_per_shell; }
    uint layer = INNER_FIRST ? shell : fur.layers - 1u - shell;
    // Of slab [layer / N, (layer + 1) / N], the upper boundary, where view rays come in, or the middle.
    float height = (float(layer) + (SAMPLING == 1u ? 0.5 : 1.0)) / float(fur.layers);

    float strand_length = fur.length_m;
#ifdef COLOR
    strand_length *= color.a;
    vertex_color = color.rgb;
#endif
#ifdef MAPS
    uv_sets = vec4(uv_0, uv_1);
    if (PROJECT_UV) { uv_sets = vec4(uv_projected(rest_position, rest_direction) * fur.projection_scale, 0.0, 0.0); }
    if (HAS_HEIGHT_MAP) {
        vec2 uv = uv_transformed(fur.height_transform, uv_sets.xy, uv_sets.zw);
        float map = textureLod(sampler2D(height_map, height_sampler), uv, 0.0).r;
        strand_length *= mix(1.0, map, fur.height_strength);
    }
#endif

    vec3 side = vec3(0.0);
    vec2 comb = vec2(0.0);
#ifdef COMB
    // The comb lays strands over in the tangent plane; its axes are fixed to the surface and move with it.
    side = mat3(world_from_object) * shell_side;
    comb = fur.comb;
#ifdef MAPS
    if (HAS_COMB_MAP) {
        vec2 uv = uv_transformed(fur.comb_transform, uv_sets.xy, uv_sets.zw);
        comb += textureLod(sampler2D(comb_map, comb_sampler), uv, 0.0).rg * 2.0 - 1.0;
    }
#endif
#endif
    StrandPlace place = strand_place(root, direction, side, comb, height, strand_length);
    position_in_world = place.position;

    root_direction_in_world = direction;
    strand_in_world = place.tangent;
    root_in_rest = rest_position;
    direction_in_rest = rest_direction;
    height_and_length = vec2(height, strand_length);
    gl_Position = frame.clip_from_world * vec4(position_in_world, 1.0);
#ifdef MOTION
    mat4 world_from_previous = previous_objects[draw.previous_object_index].world_from_object;
    vec3 was_root = (world_from_previous * vec4(previous_position, 1.0)).xyz;
    vec3 was_direction = root_direction(previous_objects[draw.previous_object_index], previous_direction);
    vec3 was_side = vec3(0.0);
#ifdef COMB
    was_side = mat3(world_from_previous) * previous_side;
#endif
    motion_write(gl_Position, strand_place(was_root, was_direction, was_side, comb, height, strand_length).position);
#endif
}
