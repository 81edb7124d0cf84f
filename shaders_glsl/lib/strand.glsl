// Where strands stand, how thick they are at a height, and how they lean and hide each other.
#ifndef VAIR_STRAND_GLSL
#define VAIR_STRAND_GLSL
#include "hash.glsl"

// Feature points are jittered by this share of a cell to either side of its middle: over the whole cell, so that no
// surface, however it cuts the lattice, sees bands of denser or thicker strands.
const float STRAND_JITTER = 0.5;
// Strands root in points at most this far (in cells) off the surface; one point a cell then makes one strand
// per spacing squared of surface. Half a cell is also as far as the eight nearest cells are sure to tell.
const float STRAND_REACH = 0.5;
// Longest half of a view ray's way through a slab (in cells) along which strands are looked up one by one.
const float STRAND_WALK = 3.0;
// Faces of cells that a way of twice that length can cross, in any direction.
const int STRAND_FACES = 14;

// What a shell stands for: the part of the view ray between its slab's two boundaries, as it moves relative to the
// strands. A place on the path is a number in [-1, 1], from the slab's lower boundary to its upper one.
struct StrandPath {
    vec3 middle;          // root that the ray passes in the slab's middle, in cells
    float threshold;      // of the profile there
    vec3 half_segment;    // from the middle to the upper boundary, across the strands, in cells
    float threshold_rise; // from the middle to the upper boundary
    vec3 normal;          // unit vector
    float radius;         // of strands at their root, in cells
    float entry;          // where the ray comes in: 1 from above, -1 from below
    float enough;         // half a pixel in root radii: the margin at which a strand fills it
};

// Thinner strands, in cells, are none: their profile would be all rounding.
const float STRAND_SMALLEST_RADIUS = 1e-3;

struct StrandHit {
    float margin; // how far inside a strand the ray comes, in root radii; negative: it misses all
    float place;  // on the path: where the ray enters the first strand, or comes closest to one
    float random; // in [0, 1), one number a strand
};

// What the ray meets of the strand in one cell. Along the path the profile is concave and the threshold linear, so that
// their difference has one maximum and, before it, at most one zero.
StrandHit strand_meet(StrandPath path, ivec3 cell) {
    vec3 random = hash_cell(cell);
    vec3 offset = (vec3(cell) - path.middle) + (0.5 - STRAND_JITTER + random * (2.0 * STRAND_JITTER));
    float height = dot(offset, path.normal);
    float reach = height / STRAND_REACH;
    float radius = path.radius * (1.0 - reach * reach);
    if (radius < STRAND_SMALLEST_RADIUS) { return StrandHit(-1e3, 0.0, 0.0); }
    // The digits that the jitter along x does not use make an independent number.
    float own_random = fract(random.x * 97.0 + random.y * 57.0);
    float full_length = 0.75 + 0.25 * own_random;

    vec3 across = offset - height * path.normal;
    float half_length = length(path.half_segment);
    float along = half_length > 1e-6 ? dot(across, path.half_segment) / half_length : 0.0;
    // The difference of the squares would cancel far along the path.
    float aside = length(half_length > 1e-6 ? across - along / half_length * path.half_segment : across);
    // The profile falls by full_length / radius a cell; where it falls more slowly than the threshold does, the lower
    // end is best.
    float fall = path.threshold_rise * radius;
    float reachable = half_length * full_length;
    float best = -sign(path.threshold_rise);
    if (reachable > abs(fall)) {
        float tilt = fall / reachable;
        best = clamp((along - tilt * aside * inversesqrt(max(1.0 - tilt * tilt, 1e-6))) / half_length, -1.0, 1.0);
    }
    float from_axis = length(vec2(aside, best * half_length - along));
    float above = full_length - (path.threshold + best * path.threshold_rise);
    float margin = above - full_length * from_axis / radius;
    // In root radii. What is thinner than a pixel covers no more of it than its own width.
    float in_radii = radius / (full_length * path.radius);
    float seen = min(margin * in_radii, 2.0 * above * in_radii - path.enough);
    if (margin <= 0.0) { return StrandHit(seen, best, own_random); }

    // The zero: where the distance from the axis is the radius that the threshold leaves, a quadratic in the place. From
    // the maximum towards the entry it is the first of the two; the other is the mirrored cone's. None lies before the
    // entry where the ray comes in within the strand.
    float left = radius * (1.0 - path.threshold / full_length);
    float shrink = fall / full_length;
    float a = half_length * half_length - shrink * shrink;
    float b = left * shrink - half_length * along;
    float c = aside * aside + along * along - left * left;
    float root = sqrt(max(b * b - a * c, 0.0));
    float q = -(b + (b < 0.0 ? -root : root));
    float to_first = abs(a) > 1e-12 ? (q / a - best) * path.entry : -1.0;
    float to_second = abs(q) > 1e-12 ? (c / q - best) * path.entry : -1.0;
    float to_entry = (path.entry - best) * path.entry;
    if (to_first > -1e-4) { to_entry = min(to_entry, to_first); }
    if (to_second > -1e-4) { to_entry = min(to_entry, to_second); }
    return StrandHit(seen, best + max(to_entry, 0.0) * path.entry, own_random);
}

// Of two hits the first, or where not both are inside a strand the one with the larger margin; with the larger margin.
StrandHit strand_first(StrandHit a, StrandHit b, float entry) {
    bool both = a.margin > 0.0 && b.margin > 0.0;
    bool is_b = both ? b.place * entry > a.place * entry : b.margin > a.margin;
    return StrandHit(max(a.margin, b.margin), is_b ? b.place : a.place, is_b ? b.random : a.random);
}

// Procedural strands: one jittered point per cell of a lattice in the rest pose, so that density does not depend on
// UVs, nothing stretches, and nothing has seams. A point makes a strand where the surface passes close by. Walks the
// cells along the path from its entry until a strand is met: eight cells hold all strands that can reach a place, and
// with each face that the path crosses four more come in.
StrandHit strand_walk(StrandPath path) {
    path.half_segment -= dot(path.half_segment, path.normal) * path.normal;
    StrandHit hit = StrandHit(-1e3, 0.0, 0.0);
    vec3 start = path.middle + path.entry * path.half_segment - 0.5;
    vec3 way = -2.0 * path.entry * path.half_segment;
    ivec3 corner = ivec3(floor(start));
    for (int index = 0; index < 8; ++index) {
        hit = strand_first(hit, strand_meet(path, corner + ivec3(index & 1, (index >> 1) & 1, index >> 2)), path.entry);
    }
    vec3 steps = 1.0 / max(abs(way), vec3(1e-20));
    vec3 share = start - vec3(corner);
    vec3 next = mix(share, 1.0 - share, greaterThan(way, vec3(0.0))) * steps;
    for (int face = 0; face < STRAND_FACES; ++face) {
        float crossed = min(next.x, min(next.y, next.z));
        // Nearer than the next face no other strand begins.
        if (crossed >= 1.0 || (hit.margin >= path.enough && 0.5 - 0.5 * path.entry * hit.place <= crossed)) { break; }
        ivec3 axis = next.x == crossed ? ivec3(1, 0, 0) : next.y == crossed ? ivec3(0, 1, 0) : ivec3(0, 0, 1);
        bool ahead = dot(way, vec3(axis)) > 0.0;
        corner += ahead ? axis : -axis;
        next += vec3(axis) * steps;
        ivec3 new_corner = ahead ? corner + axis : corner;
        for (int index = 0; index < 4; ++index) {
            ivec3 cell = new_corner + axis.yzx * (index & 1) + axis.zxy * (index >> 1);
            hit = strand_first(hit, strand_meet(path, cell), path.entry);
        }
    }
    hit.margin = min(hit.margin, path.enough);
    return hit;
}

// Mean over full lengths f in [0.75, 1] of (1 - threshold / f) and of its square, where positive: how much of their
// radius, and of their cross-section, strands have left at a threshold >= 0.
vec2 strand_left(float threshold) {
    float least = max(threshold, 0.75);
    if (least >= 1.0) { return vec2(0.0); }
    float t_log = threshold * log(least);
    return 4.0 * max(vec2(1.0 - least + t_log, 1.0 - least + 2.0 * t_log + threshold * threshold * (1.0 / least - 1.0)), 0.0);
}

// Mean cross-section of strands a cell of surface, overlaps counted twice. Over a strand's height h off the surface in
// [-1, 1], its radius 1 - h^2 has the mean 2/3 and its square 8/15.
float strand_cross_section(float threshold, float radius) {
    return 3.14159265 * (8.0 / 15.0) * radius * radius * strand_left(threshold).y;
}

// The same of their widths, seen from the side.
float strand_width(float threshold, float radius) {
    return 2.0 * (2.0 / 3.0) * radius * strand_left(threshold).x;
}

// Mean opacity of a slab of strands that stand anywhere, met over `length_in_cells` across them. From above the ray
// meets the caps that the slab above has not covered already, which `cap` is the area of; from anywhere it meets sides.
// Shells of one strand thus do not count it twice, and the opacity of fur does not depend on their number.
float strand_slab_opacity(float cap, float width, float length_in_cells) {
    return 1.0 - exp(-(max(cap, 0.0) + width * length_in_cells));
}

// Threshold of the strand profile at a height in the fur: a texel belongs to a strand where its profile reaches
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

// Opacity at a margin, one pixel wide at the edge. `slope` is the change of the margin over a pixel; below the eye's
// resolution (slope > 1) it fades to the mean.
float strand_opacity(float margin, float slope, float mean) {
    float edge = clamp(margin / max(slope, 1e-6) + 0.5, 0.0, 1.0);
    return mix(edge, mean, strand_unresolved(slope));
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

// The body below fur is curved: light at its horizon crosses not endlessly much of the fur, and light from this far (as
// a cosine) below it still reaches the tips.
const float STRAND_PAST_HORIZON = 0.3;

// Optical depth of the fur above a strand at `height` along the light. At the root, straight down, it is
// -ln(1 - occlusion); it falls linearly with height, and slanted light crosses more of it: the chord of a shell around a
// sphere, 2 / (cosine + sqrt(cosine^2 + 2 depth / radius)) times as much.
float strand_optical_depth(float height, float occlusion, float cosine_to_light) {
    float depth_at_root = -log(max(1.0 - occlusion, 1e-3));
    float horizon = sqrt(cosine_to_light * cosine_to_light + STRAND_PAST_HORIZON * STRAND_PAST_HORIZON);
    // Of two forms the one that does not cancel.
    float cosine = cosine_to_light > 0.0 ? 0.5 * (cosine_to_light + horizon)
                                         : 0.5 * STRAND_PAST_HORIZON * STRAND_PAST_HORIZON / (horizon - cosine_to_light);
    return depth_at_root * (1.0 - height) / cosine;
}

#endif
