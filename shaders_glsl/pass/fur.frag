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
#include "fibre.glsl"
#include "lock.glsl"
#include "coverage.glsl"
#ifdef COUNT
#include "count.glsl"
#endif
#ifdef GBUFFER
#include "gbuffer.glsl"
#endif
#ifdef LIST
#include "object.glsl"
#include "oit_append.glsl"
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

#include "fur_light.glsl"
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

#ifdef OCCLUDED
ShadowReceiver shadow_receiver() {
    ShadowReceiver receiver;
    receiver.normal_in_world = direction_or(root_direction_in_world, frame.view_in_world);
    receiver.depth_m = (1.0 - height_and_length.x) * height_and_length.y;
    return receiver;
}
#endif

// Most places at which a distribution map is looked up along the path.
const int MAP_TAPS = 8;

float threshold_at(float height) {
    return strand_threshold(height, fur.cutoff_start, fur.cutoff_end, PARABOLOID) + 0.5 * fur.taper * height * height;
}

// A vector of the shell's surface, given by how far it goes along the pixel's two steps. On a surface seen edge-on these
// are nearly parallel, and rounding would decide; a little damping (Tikhonov) then keeps the shortest answer.
vec2 in_pixel_steps(vec3 vector, vec3 step_x, vec3 step_y) {
    float xx = dot(step_x, step_x) * 1.0001 + 1e-30;
    float xy = dot(step_x, step_y);
    float yy = dot(step_y, step_y) * 1.0001 + 1e-30;
    vec2 right = vec2(dot(vector, step_x), dot(vector, step_y));
    return vec2(right.x * yy - right.y * xy, right.y * xx - right.x * xy) / (xx * yy - xy * xy);
}

void main() {
    float height = height_and_length.x;
    vec3 normal = direction_or(root_direction_in_world, frame.view_in_world);
    vec3 strand = direction_or(strand_in_world, normal);
    vec3 to_eye = frame.orthographic > 0.5 ? frame.view_in_world
                                              : direction_or(frame.eye_in_world - position_in_world, normal);
    float cosine_to_eye = dot(normal, to_eye);

    // The shell is the upper boundary of its slab, where the view ray comes in (or, seen from behind, goes out). Within
    // the slab it goes on for `reach`, to the lower boundary or, past the outline, to where the surface bends away from
    // it: at `share` of the slab's depth.
    vec3 step_x = dFdx(position_in_world);
    vec3 step_y = dFdy(position_in_world);
    // The shell as it was drawn: its facets, not the smooth normal, tell where the ray comes in and how far it goes.
    vec3 facet = direction_or(cross(step_x, step_y), normal);
    facet = dot(facet, normal) < 0.0 ? -1.0 * facet : facet;
    float facing = dot(facet, to_eye);
    vec3 aside = to_eye - facing * facet;
    vec2 aside_in_steps = in_pixel_steps(aside, step_x, step_y);
    float bend = dot(aside, aside_in_steps.x * dFdx(normal) + aside_in_steps.y * dFdy(normal));
    float slab_height = 1.0 / float(fur.layers);
    float slab_m = height_and_length.y * slab_height;
    float depth_m = slab_m * max(dot(strand, facet), 0.1);
    float cosine = max(abs(facing), 0.02);
    float inside = cosine * cosine - 2.0 * bend * depth_m;
    float reach_m = inside > 0.0 ? 2.0 * depth_m / (cosine + sqrt(inside)) : cosine / bend;
    float share = inside > 0.0 ? 1.0 : cosine * cosine / (2.0 * bend * depth_m);
    // The same way relative to the strands, which lean.
    vec3 way_in_world = (facing < 0.0 ? reach_m : -reach_m) * to_eye + share * slab_m * strand;
    vec2 way_in_steps = in_pixel_steps(way_in_world, step_x, step_y);

    uint layer = uint(height * float(fur.layers) - 0.25);
    float upper_height = height;
    float lower_height = height - share * slab_height;
    if (SAMPLING == 1u) {
        way_in_steps = vec2(0.0);
        upper_height = height + 0.5 * slab_height;
        lower_height = height - 0.5 * slab_height;
    }
    // Of the profile, where the way begins and ends.
    float upper = threshold_at(upper_height);
    float lower = threshold_at(lower_height);
    vec3 rest_x = dFdx(root_in_rest);
    vec3 rest_y = dFdy(root_in_rest);
    vec3 turn_in_rest = way_in_steps.x * dFdx(direction_in_rest) + way_in_steps.y * dFdy(direction_in_rest);
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
    float own_random;
    float opacity;
    float slope;
    // Where on the way, from -1 at its lower end to 1, the ray meets what it sees.
    float place = 0.0;
    float entry = facing < 0.0 ? -1.0 : 1.0;
#ifdef MAPS
    if (HAS_DISTRIBUTION_MAP) {
        vec2 map_uv = uv_transformed(fur.distribution_transform, uv_sets.xy, uv_sets.zw);
        vec2 gradient_x = uv_gradient(fur.distribution_transform, uv_sets_x);
        vec2 gradient_y = uv_gradient(fur.distribution_transform, uv_sets_y);
        vec2 way = way_in_steps.x * gradient_x + way_in_steps.y * gradient_y;
        vec2 in_texels = way * vec2(textureSize(sampler2D(distribution_map, distribution_sampler), 0));
        int taps = SAMPLING == 1u ? 1 : clamp(int(ceil(0.5 * length(in_texels))), 1, MAP_TAPS);
        float margin = -1.0;
        for (int tap = 0; tap < taps && margin < 0.0; ++tap) {
            place = entry * (1.0 - (2.0 * float(tap) + 1.0) / float(taps));
            vec2 uv = map_uv + (0.5 - 0.5 * place) * way;
            float map = textureGrad(sampler2D(distribution_map, distribution_sampler), uv, gradient_x, gradient_y).r;
            margin = max(margin, map - threshold_at(mix(lower_height, upper_height, 0.5 + 0.5 * place)));
        }
        // A map is 0 between strands, however far they are: the edge must end there.
        slope = min(fwidth(margin), lower + upper);
        float met = margin >= 0.0 ? 1.0 : 0.0;
        opacity = ALPHA == 2u ? met : strand_opacity(margin, slope, met);
        own_random = hash_cell(ivec3(floor(map_uv * 64.0), 0)).x;
    } else
#endif
    {
        float cells_per_unit = 1.0 / fur.strand_spacing;
        vec3 rest_normal = direction_or(direction_in_rest, vec3(0.0, 1.0, 0.0));
        vec3 start = root_in_rest * cells_per_unit;
        vec3 way = (way_in_steps.x * rest_x + way_in_steps.y * rest_y) * cells_per_unit;
        if (HAS_LOCKS) {
            Lock lock = lock_at(start, rest_normal);
            bool is_point = SAMPLING == 1u;
            vec3 up = lock_way_to_root(lock.from_middle, lock.random, rest_normal,
                                       is_point ? height : upper_height, fur.clump, fur.curl);
            vec3 down = lock_way_to_root(lock.from_middle + way, lock.random, rest_normal,
                                         is_point ? height : lower_height, fur.clump, fur.curl);
            start += up;
            way += down - up;
        }
        float way_length = length(way);
        float walked = min(way_length, 2.0 * STRAND_WALK);
        float walked_share = way_length > 0.0 ? walked / way_length : 1.0;
        lower = mix(upper, lower, walked_share);
        lower_height = mix(upper_height, lower_height, walked_share);
        way *= walked_share;
        // The surface bends away under the ray: the path is straight, and touches it, at its middle.
        vec3 turn = walked_share * turn_in_rest;
        StrandPath path;
        path.normal = direction_or(rest_normal + 0.5 * turn, rest_normal);
        path.radius = fur.strand_radius;
        path.entry = entry;
        path.half_segment = -0.5 * way;
        path.middle = start + 0.5 * way - 0.125 * dot(turn, way) * rest_normal;
        path.threshold = SAMPLING == 1u ? threshold_at(height) : 0.5 * (lower + upper);
        path.threshold_rise = SAMPLING == 1u ? 0.0 : 0.5 * (upper - lower);
        slope = pixel_in_rest * cells_per_unit / fur.strand_radius;
        // Without edges as wide as a pixel, a strand is met or it is not.
        path.enough = ALPHA == 2u ? 0.0 : 0.5 * slope;
        StrandHit hit = strand_walk(path);
        // Means are seen in the middle.
        place = SAMPLING == 1u ? 0.0 : hit.place * (1.0 - strand_unresolved(slope));
        own_random = hit.random;
        float width = strand_width(path.threshold, fur.strand_radius);
        // The outermost slab shows its strands' caps whole, and from below none are seen.
        bool is_outermost = layer + 1u == fur.layers;
        float above = ALPHA == 1u || is_outermost ? 0.0 : strand_cross_section(upper, fur.strand_radius);
        float cap = entry < 0.0 ? 0.0 : strand_cross_section(lower, fur.strand_radius) - above;
        float mean = strand_slab_opacity(cap, width, way_length);
        opacity = ALPHA == 2u ? (hit.margin >= 0.0 ? 1.0 : 0.0) : strand_opacity(hit.margin, slope, mean);
        // Strands along the rest of a grazing ray: what they hide is known, if not where they stand.
        float rest = strand_slab_opacity(0.0, width, way_length - walked);
        if (ALPHA != 2u) { opacity += (1.0 - opacity) * rest * (1.0 - strand_unresolved(slope)); }
    }
    height = mix(lower_height, upper_height, 0.5 + 0.5 * place);
    // Where strands have no length there are none: all shells lie on the skin.
    if (height_and_length.y <= 0.0) { opacity = 0.0; }
    // Each factor lies in [0, 1], so their product does.
    opacity *= (1.0 - fur.tip_fade * height) * mix(1.0, clamp(cosine_to_eye, 0.0, 1.0), fur.edge_fade);

    uint samples = SAMPLE_COUNT;
    float unresolved = strand_unresolved(slope);
    int mask = -1;
#ifdef GBUFFER
    // One sample, and what blends counts where it covers more than half.
    if (BLEND) {
        mask = opacity > 0.5 ? -1 : 0;
    } else
#else
    if (BLEND) {
        mask = opacity > 0.0 ? -1 : 0;
    } else
#endif
    {
        // Where strands are smaller than pixels, and where partial opacity is wanted, grain keeps its mean.
        // Seen one by one, the shells of a strand cover the same samples; means are met by chance, each its own.
        vec2 grain = coverage_grain(root_in_rest, pixel_in_rest, unresolved > 0.0 ? layer : 0u);
        float rounding = mix(0.5, grain.x, KEEP_PARTIAL ? 1.0 : unresolved);
        mask = coverage_mask(opacity, samples, rounding, grain.y);
    }
#ifdef COUNT
    count_fragment(uint(mask), samples, !BLEND);
    radiance = vec4(1.0);
    if (mask == 0) { discard; }
#elif defined GBUFFER
    if (mask == 0) { discard; }
    // No light here: the target is the G-buffer's.
    radiance = gbuffer_texel(normal);
#else
#ifdef LIST
    vec2 depth_slope = list_slope();
#endif
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

    // Optical depths on average over all directions and along each light. What hides the strand from the eye are the
    // shells above, so that the view counts once.
    Fibre fibre = fibre_to_eye(normal, strand, to_eye, fur.specular, fur.transmission, fibre_variance(fur.roughness));
    float depth_all_over = -log(max(1.0 - fur.occlusion * (1.0 - height), 1e-3));
    // Strands know how they hide each other; the screen would count it twice.
    vec3 sum = fur_environment(fibre, color, to_eye, depth_all_over);
    for (uint index = 0u; index < light_count(); ++index) {
        LightSample light = light_at(index, position_in_world);
        float depth = strand_optical_depth(height, fur.occlusion, dot(normal, light.direction_in_world));
        sum += light.irradiance * fibre_scattering(fibre, color, light.direction_in_world, depth);
    }
    sum = min(sum * frame.pre_exposure, vec3(RADIANCE_LIMIT));
#ifdef LIST
    radiance = list_append(sum * opacity, vec3(1.0 - opacity), depth_slope, uint(gl_SampleMaskIn[0]), draw.rank);
#else
    radiance = BLEND ? vec4(sum * opacity, opacity) : vec4(sum, 1.0);
#endif
#endif
}
