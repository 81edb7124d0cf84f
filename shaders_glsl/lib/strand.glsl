// Where strands stand, how thick they are at a height, and how a strand scatters light.
#ifndef VAIR_STRAND_GLSL
#define VAIR_STRAND_GLSL
#include "hash.glsl"

// Feature points are jittered by this share of a cell to either side of its middle: over the whole cell, so that no
// surface, however it cuts the lattice, sees bands of denser or thicker strands.
const float STRAND_JITTER = 0.5;
// Strands root in points at most this far (in cells) off the surface; one point a cell then makes one strand
// per spacing squared of surface. Half a cell is also as far as the eight nearest cells are sure to tell.
const float STRAND_REACH = 0.5;
// Longest half of a view ray's segment (in cells) that strands are looked up along. The eight cells then miss a strand
// in one place of a thousand.
const float STRAND_SEGMENT = 0.25;

struct StrandSample {
    float profile; // 1 on the axis of a full-length strand, falling linearly to 0 at its root radius and below it outside
    float random;  // in [0, 1), one number a strand
};

// Distance of a point from the segment [-half_segment, half_segment] through the origin.
float strand_segment_distance(vec3 point, vec3 half_segment) {
    float length_squared = dot(half_segment, half_segment);
    float along = clamp(dot(point, half_segment) / max(length_squared, 1e-20), -1.0, 1.0);
    return length(point - along * half_segment);
}

// Procedural strands: one jittered point per cell of a lattice in the rest pose, so that density does not
// depend on UVs, nothing stretches, and nothing has seams. A point makes a strand where the surface passes
// close by. `half_segment` is the part of the view ray that the shell stands for, projected along the strands
// onto the surface ("slab shell"); its length is limited to what the eight nearest cells can answer.
StrandSample strand_field(vec3 position_in_cells, vec3 normal, float radius_in_cells, vec3 half_segment) {
    vec3 corner = floor(position_in_cells - 0.5);
    StrandSample nearest = StrandSample(-1e3, 0.0);
    for (int index = 0; index < 8; ++index) {
        vec3 cell = corner + vec3(float(index & 1), float((index >> 1) & 1), float(index >> 2));
        vec3 random = hash_cell(ivec3(cell));
        vec3 offset = cell + 0.5 + (random * 2.0 - 1.0) * STRAND_JITTER - position_in_cells;
        float height = dot(offset, normal);
        vec3 in_plane = offset - height * normal;
        float reach = height / STRAND_REACH;
        float radius = radius_in_cells * max(1.0 - reach * reach, 0.0);
        float distance_to_axis = strand_segment_distance(in_plane, half_segment);
        // The digits that the jitter along x does not use make an independent number.
        float own_random = fract(random.x * 97.0 + random.y * 57.0);
        float full_length = 0.75 + 0.25 * own_random;
        float profile = full_length * (1.0 - distance_to_axis / max(radius, 1e-6));
        if (profile > nearest.profile) {
            nearest = StrandSample(profile, own_random);
        }
    }
    return nearest;
}

// Share of a surface that the procedural strands cover at a threshold, swept over a segment of that half length (in
// cells), overlaps counted as chance. Over a strand's height h off the surface in [-1, 1], its radius 1 - h^2 has the
// mean 2/3 and its square 8/15; full lengths in [.75, 1] are taken at their mean, 7/8.
float strand_mean_coverage(float threshold, float radius_in_cells, float half_length_in_cells) {
    float radius = radius_in_cells * max(1.0 - threshold / 0.875, 0.0);
    float area = 3.14159265 * radius * radius * (8.0 / 15.0) + 4.0 * radius * half_length_in_cells * (2.0 / 3.0);
    return 1.0 - exp(-area);
}

// Threshold of the strand profile at a height in the coat: a texel belongs to a strand where its profile reaches
// it. paraboloid: strands keep their thickness for longer.
float strand_threshold(float height, float cutoff_start, float cutoff_end, bool paraboloid) {
    float rise = paraboloid ? height * height : height;
    return mix(cutoff_start, cutoff_end, rise);
}

// How far strands are below the eye's resolution: 0 each is seen, 1 only their mean is. `slope` is the change of the
// profile over a pixel.
float strand_unresolved(float slope) {
    return smoothstep(0.75, 2.0, slope);
}

// Opacity of a profile at a threshold, one pixel wide at the edge. `slope` is the change of the profile over a
// pixel; below the eye's resolution (slope > 1) it fades to the mean coverage.
float strand_opacity(float profile, float threshold, float slope, float mean_coverage) {
    float edge = clamp((profile - threshold) / max(slope, 1e-6) + 0.5, 0.0, 1.0);
    return mix(edge, mean_coverage, strand_unresolved(slope));
}

// Strand bent to a circular arc that keeps its length: x = sideways, y = along the root direction, both over the
// strand length. `angle` is the turn from root to tip in [0, pi / 2], where height grows with `height` for sure.
// Half-angle form: no cancellation as the angle goes to 0.
vec2 strand_arc(float height, float angle) {
    float half_turn = 0.5 * angle * height;
    float full_turn = 2.0 * half_turn;
    float sinc_half = half_turn < 1e-3 ? 1.0 - half_turn * half_turn / 6.0 : sin(half_turn) / half_turn;
    float sinc_full = full_turn < 1e-3 ? 1.0 - full_turn * full_turn / 6.0 : sin(full_turn) / full_turn;
    return height * vec2(half_turn * sinc_half * sinc_half, sinc_full);
}

// Turn of a strand from root to tip under a force of unit direction times strength in [0, 1]: towards the force,
// never beyond it, never more than a right angle, and none for a force straight down the strand, where
// "sideways" has no direction.
float strand_bend_angle(vec3 root_direction, vec3 force) {
    float strength = length(force);
    float along = dot(root_direction, force);
    float sideways = length(force - along * root_direction);
    if (sideways < 1e-6) {
        return 0.0;
    }
    float to_force = atan(sideways, along);
    return min(strength * to_force, 1.57079633 * sideways);
}

// Light that a strand at `height` receives through the coat above it. The optical depth at the root is
// -ln(1 - occlusion); it falls linearly with height, and slanted light crosses 1 / cosine as much of it.
float strand_light_through_coat(float height, float occlusion, float cosine_to_light) {
    float depth_at_root = -log(max(1.0 - occlusion, 1e-3));
    return exp(-depth_at_root * (1.0 - height) / max(cosine_to_light, 0.05));
}

// Cosine around the fibre of a direction along it, which has none: there cos(phi / 2) takes its mean, 2 / pi, and the
// lobe keeps its integral. 8 / pi^2 - 1.
const float STRAND_COSINE_ALONG = -0.189430531;

// Scattering lobe of a fibre: Gaussian in the sum of the sines of the two angles along the fibre (mean `shift`,
// variance `variance`), cos(phi / 2) / 4 around it. Its integral over all directions is at most 1; no cosine
// belongs to it. Azimuthal part: Marschner et al. 2003, "Light Scattering from Human Hair Fibers", section 5.
float strand_lobe(vec3 tangent, vec3 to_eye, vec3 to_light, float shift, float variance) {
    float sine_eye = dot(tangent, to_eye);
    float sine_light = dot(tangent, to_light);
    float deviation = sine_eye + sine_light - shift;
    float along = exp(-0.5 * deviation * deviation / variance) * inversesqrt(6.28318531 * variance);
    vec3 eye_across = to_eye - sine_eye * tangent;
    vec3 light_across = to_light - sine_light * tangent;
    float lengths = dot(eye_across, eye_across) * dot(light_across, light_across);
    float cosine = lengths > 1e-12 ? dot(eye_across, light_across) * inversesqrt(lengths) : STRAND_COSINE_ALONG;
    return along * 0.25 * sqrt(max(0.5 + 0.5 * cosine, 0.0));
}

// Variance of a lobe from the longitudinal roughness. Source: Chiang et al. 2016, "A Practical and Controllable
// Hair and Fur Model for Production Path Tracing", equation 7.
float strand_variance(float roughness) {
    float b = clamp(roughness, 0.1, 1.0);
    float b2 = b * b;
    float b4 = b2 * b2;
    float b16 = b4 * b4 * b4 * b4;
    float root = 0.726 * b + 0.812 * b2 + 3.7 * b16 * b4;
    return root * root;
}

// Light wraps this far around the coat's surface: strands stand up and catch it past the terminator.
const float STRAND_WRAP = 0.3;

// Share of light reflected as a white highlight, and as a coloured one that went through the strand twice.
const float STRAND_REFLECTED = 0.10;
const float STRAND_RETURNED = 0.30;
// Tilt of the cuticle's scales, as the sine that shifts the two highlights apart.
const float STRAND_SCALE_TILT = 0.08;

// Radiance per unit irradiance of a strand with reflectance `color`: diffuse multiple scattering (wrapped, at most
// `color`), a white highlight shifted to the root and a coloured one shifted to the tip.
vec3 strand_scattering(vec3 color, vec3 normal, vec3 tangent, vec3 to_eye, vec3 to_light, float specular, float variance) {
    float sine_light = dot(tangent, to_light);
    float across = sqrt(max(1.0 - sine_light * sine_light, 0.0));
    float wrapped = max(dot(normal, to_light) + STRAND_WRAP, 0.0) / ((1.0 + STRAND_WRAP) * (1.0 + STRAND_WRAP));
    float reflected = STRAND_REFLECTED * specular;
    float returned = STRAND_RETURNED * specular;
    vec3 diffuse = color * ((1.0 - reflected - returned) * 0.318309886 * wrapped * mix(0.7, 1.05, across));
    float facing = clamp(wrapped * 4.0, 0.0, 1.0);
    float white = reflected * strand_lobe(tangent, to_eye, to_light, -STRAND_SCALE_TILT, variance);
    float colored = returned * strand_lobe(tangent, to_eye, to_light, 1.5 * STRAND_SCALE_TILT, 4.0 * variance);
    return diffuse + facing * (vec3(white) + color * colored);
}

#endif
