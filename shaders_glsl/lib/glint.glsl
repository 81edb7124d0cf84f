// Flakes that glint: sequins, glitter and lurex. Functions only.
//
// A flake has a place on the cloth and a normal. Stretched by the width of GGX and projected, the normals of GGX fill a
// disc evenly; mapped to a square, as evenly. So flakes are points spread evenly over cloth times square, and what they
// do to the smooth GGX lobe is a factor whose mean is 1 by construction: how many flakes of the pixel have the half
// vector in their own lobe, over how many should.
//
// The cloth is a lattice of rhombi with one flake each; 2^f x 2^f of them are a tile, and the square has as many cells.
// In every tile a shuffle pairs cells with normals, so that a flake is found by its place (is there a disc here?) and by
// its normal (which flake of this tile can flash?), the same flake both times, at any zoom, in constant time. Only where
// a pixel covers more than half a tile do larger tiles take over, whose flakes each stand for 4^level and are averaged
// with as many: the mean stays, the variance is that of so many flakes.
//
// Sources: Deliot & Belcour 2023, "Real-Time Rendering of Glinty Appearances using Distributed Binomial Laws on
// Anisotropic Grids"; Kemppinen et al. 2025, "Glinty NDFs in Constant Time" (bins of place and normal); Zirr & Kaplanyan
// 2016, "Real-Time Rendering of Procedural Multiscale Materials"; Shirley & Chiu 1997, "A Low Distortion Map Between Disk
// and Square". The shuffled tile is our own.
#ifndef VAIR_GLINT_GLSL
#define VAIR_GLINT_GLSL
#include "ggx.glsl"
#include "hash.glsl"

// Variance along an axis of what a pixel sees, 1/4 pixel^2 as of a Gaussian, over that of a flake's profile, 1/6.
const float GLINT_PIXEL = 1.5;
// Level at which single flakes are left out: the factor then strays from 1 by less than a hundredth or so.
const float GLINT_LAST_LEVEL = 8.0;

// What all flakes of a material share.
struct GlintFlakes {
    float radius;    // of a disc over the edge of a rhombus, [0, 0.5]
    float jitter;    // how far discs stray from the middle of their rhombus: share of its edge, [0, 1]
    float lobe;      // radius of a flake's lobe, in cells of the square of normals, (0, 0.5]
    float variation; // of the flakes' colour, [0, 1]
    uint fineness;   // log2 of the rhombi along a tile, and of the cells along the square, 2 to 8
};

// What a pixel covers of the lattice; lengths are edges of a rhombus, vectors are along its edges.
struct GlintFootprint {
    ivec2 cell;              // rhombus of the pixel's middle
    vec2 within;             // the middle in it, [0, 1]
    vec2 across;             // one pixel to the right, widened
    vec2 down;               // one pixel down, widened
    float disc;              // squared radius of a disc with its soft edge
    float sharpness;         // of that edge, at least 1
    float inverse_squared;   // 1 over the squared area of the kernel, in pi times areas of a rhombus
    float reach;             // half of what the kernel spans along either edge
    float blur;              // the same of the pixel alone
};

// The four tiles of one level around a pixel.
struct GlintTiles {
    ivec2 first;
    uint stream; // of random numbers: level and chart
    uint level;
    uvec2 seed_0; // of first, one right, one up, both
    uvec2 seed_1;
    uvec2 seed_2;
    uvec2 seed_3;
};

// A flake that a pixel may show as a disc.
struct GlintDisc {
    vec4 tinted; // tint and weight, as of glint_flake
    vec2 square; // its normal
};

// Those around a pixel.
struct GlintDiscs {
    GlintDisc first;
    GlintDisc right;
    GlintDisc up;
    GlintDisc both;
    float apart; // how well the pixel tells them apart, [0, 1]
};

// How much of the single flakes of two levels is seen.
struct GlintLevels {
    uint first;
    float near; // share of the first level
    float far;  // share of the next one
};

// 1 - (1 - p)^n for p in [0, 1], n >= 0: the chance that one of n has what each has with chance p. By log(1 - p) =
// -2 atanh(p / (2 - p)) and the series of exp(x) - 1 where the difference would cancel.
float glint_chance(float p, float n) {
    if (p >= 1.0) {
        return n > 0.0 ? 1.0 : 0.0;
    }
    float z = p / (2.0 - p);
    float z2 = z * z;
    float series = 1.0 / 9.0 + z2 * (1.0 / 11.0 + z2 * (1.0 / 13.0));
    series = 1.0 + z2 * (1.0 / 3.0 + z2 * (1.0 / 5.0 + z2 * (1.0 / 7.0 + z2 * series)));
    float x = n * (p < 0.5 ? -2.0 * z * series : log(1.0 - p));
    float small = 1.0 + x * (1.0 / 5.0) * (1.0 + x * (1.0 / 6.0) * (1.0 + x * (1.0 / 7.0)));
    small = 1.0 + x * 0.5 * (1.0 + x * (1.0 / 3.0) * (1.0 + x * 0.25 * small));
    return x > -0.5 ? -x * small : 1.0 - exp(x);
}

// Where a normal lies in the square [-1, 1]^2 that normals of GGX of width alpha fill evenly; z >= 0.
vec2 glint_square(vec3 normal, float alpha) {
    vec2 across = normal.xy;
    vec2 disc = across * inversesqrt(max(dot(across, across) + alpha * alpha * normal.z * normal.z, 1e-20));
    float radius = length(disc);
    vec2 size = abs(disc);
    float large = max(size.x, size.y);
    float z = large > 0.0 ? min(size.x, size.y) / large : 0.0;
    float z2 = z * z;
    // 4 / pi atan(z) on [0, 1]. Source: Hastings 1955, "Approximations for Digital Computers", sheet 13.
    float turn = 0.0429096138 + z2 * (-0.0161657367 + z2 * 0.0028662257);
    turn = -0.1420889944 + z2 * (0.1065626393 + z2 * (-0.0752896400 + z2 * turn));
    turn = z * (1.0 + z2 * (-0.3333314528 + z2 * (0.1999355085 + z2 * turn))) * 1.27323954;
    vec2 square = size.x >= size.y ? vec2(radius, radius * turn) : vec2(radius * turn, radius);
    return vec2(disc.x < 0.0 ? -square.x : square.x, disc.y < 0.0 ? -square.y : square.y);
}

// A permutation of the numbers below 4^fineness, one for each key: odd factors and halves laid over halves undo.
uint glint_shuffle(uint number, uint fineness, uint key) {
    uint mask = (1u << (2u * fineness)) - 1u;
    uint shuffled = (number ^ key) & mask;
    shuffled = (shuffled * 0x9e3779b1u + (key >> 8u)) & mask;
    shuffled ^= shuffled >> fineness;
    shuffled = (shuffled * 0x85ebca6bu + (key >> 16u)) & mask;
    shuffled ^= shuffled >> fineness;
    return (shuffled * 0xc2b2ae35u) & mask;
}

// Which number glint_shuffle made this of: the same steps backwards, with the inverses of the factors modulo 2^32.
uint glint_unshuffle(uint shuffled, uint fineness, uint key) {
    uint mask = (1u << (2u * fineness)) - 1u;
    uint number = (shuffled * 0x7ed1b41du) & mask;
    number ^= number >> fineness;
    number = ((number - (key >> 16u)) * 0xa5cb9243u) & mask;
    number ^= number >> fineness;
    number = ((number - (key >> 8u)) * 0xe8b2f51u) & mask;
    return (number ^ key) & mask;
}

// The plane of the lattice for a surface with that normal in the rest pose: 0 yz, 1 zx, 2 xy, the one that it faces most.
uint glint_chart(vec3 normal) {
    vec3 size = abs(normal);
    if (size.x > size.y && size.x > size.z) {
        return 0u;
    }
    return size.y > size.z ? 1u : 2u;
}

// A vector in that plane.
vec2 glint_in_chart(vec3 vector, uint chart) {
    return chart == 0u ? vector.yz : chart == 1u ? vector.zx : vector.xy;
}

// x^2 + x y + y^2: the squared length of a vector along the edges of a rhombus of 60 degrees.
float glint_length_squared(vec2 vector) {
    return dot(vector, vector) + vector.x * vector.y;
}

// Twice the area between two such vectors, in rhombi.
float glint_cross(vec2 a, vec2 b) {
    return a.x * b.y - a.y * b.x;
}

// position, and what it changes by from pixel to pixel, in a plane, in edges of a rhombus.
GlintFootprint glint_footprint(GlintFlakes flakes, vec2 position, vec2 to_right, vec2 to_below) {
    const float up = 1.15470054; // 1 / sin 60 degrees
    vec2 place = clamp(vec2(position.x - 0.5 * up * position.y, up * position.y), -1e8, 1e8);
    vec2 right = clamp(vec2(to_right.x - 0.5 * up * to_right.y, up * to_right.y), -1e6, 1e6);
    vec2 below = clamp(vec2(to_below.x - 0.5 * up * to_below.y, up * to_below.y), -1e6, 1e6);
    GlintFootprint result;
    vec2 corner = floor(place);
    result.cell = ivec2(corner);
    result.within = place - corner;
    // The kernel's covariance is that of the disc and that of the pixel; its profile is 1 - u^n of the squared distance u
    // in it, whose edge is about a pixel wide.
    float pixel = sqrt(max(max(glint_length_squared(right), glint_length_squared(below)), 1e-8));
    result.sharpness = 1.0 + flakes.radius / pixel;
    result.disc = flakes.radius * flakes.radius * (1.0 + 1.0 / result.sharpness);
    result.across = right * sqrt(GLINT_PIXEL);
    result.down = below * sqrt(GLINT_PIXEL);
    // Sums of what is never negative, so that nothing cancels where a grazing view stretches the pixel.
    float area = glint_cross(result.across, result.down);
    float both = result.disc + glint_length_squared(result.across) + glint_length_squared(result.down);
    result.inverse_squared = 1.0 / max(4.0 / 3.0 * result.disc * both + area * area, 1e-12);
    vec2 spans = result.across * result.across + result.down * result.down;
    result.blur = sqrt(max(spans.x, spans.y));
    result.reach = sqrt(4.0 / 3.0 * result.disc + max(spans.x, spans.y));
    return result;
}

// Tint and weight of one flake of a level in a pixel; the weights of a lattice of flakes have the mean 1.
vec4 glint_flake(GlintFlakes flakes, GlintFootprint footprint, ivec2 place, uint level, uint stream) {
    uvec3 random = hash_pcg3d(uvec3(uvec2(place), stream));
    float scale = float(1u << level);
    vec2 stray = (vec2(random.xy >> 16u) + 0.5) * (1.0 / 65536.0) - 0.5;
    vec2 offset = vec2((place << level) - footprint.cell) - footprint.within + (0.5 + flakes.jitter * stray) * scale;
    float right = glint_cross(footprint.across, offset);
    float below = glint_cross(footprint.down, offset);
    float u = 4.0 / 3.0 * footprint.disc * glint_length_squared(offset) + right * right + below * below;
    u *= footprint.inverse_squared;
    if (u >= 1.0) {
        return vec4(0.0);
    }
    float n = footprint.sharpness;
    float weight = 0.318309886 * sqrt(footprint.inverse_squared) * (1.0 + 1.0 / n) * glint_chance(1.0 - u, n);
    vec3 shade = (vec3((uvec3(random.z) >> uvec3(2u, 12u, 22u)) & 1023u) + 0.5) * (1.0 / 1024.0);
    return vec4(1.0 - flakes.variation * shade, 1.0) * weight;
}

// Which levels show single flakes, where a kernel reaches so far: the first whose tiles are at least twice as wide, and,
// as the kernel nears that, the next one. Either alone has the variance of all the flakes that are there. Between them,
// with the shares a of the one and b / 2 of the other, a^2 + b^2 is 1, or as near (0.8 and more) as flakes that never
// subtract light allow: a + b / 2 <= 1.
GlintLevels glint_levels(float reach, uint fineness) {
    float level = log2(max(2.0 * reach, 1e-6)) - float(fineness);
    float first = clamp(ceil(level), 0.0, GLINT_LAST_LEVEL);
    float b = clamp(2.0 * (level - first) + 1.0, 0.0, 1.0);
    float a = min(1.0 - 0.5 * b, sqrt(1.0 - b * b));
    float share = exp2(-first) * clamp(GLINT_LAST_LEVEL - level, 0.0, 1.0);
    return GlintLevels(uint(first), a * share, 0.5 * b * share);
}

// What chooses a tile's shuffle and moves its normals.
uvec2 glint_seed(ivec2 tile, uint stream) {
    uvec3 random = hash_pcg3d(uvec3(uvec2(tile), stream + 128u));
    return uvec2((random.x & 0xffff0000u) | random.y >> 16u, random.z);
}

// The tiles of a level that a kernel may reach.
GlintTiles glint_tiles(GlintFootprint footprint, uint fineness, uint level, uint chart) {
    GlintTiles tiles;
    tiles.level = level;
    tiles.stream = chart * 16u + level;
    uint size = fineness + level;
    tiles.first = (footprint.cell - (1 << (size - 1u))) >> size;
    tiles.seed_0 = glint_seed(tiles.first, tiles.stream);
    tiles.seed_1 = glint_seed(tiles.first + ivec2(1, 0), tiles.stream);
    tiles.seed_2 = glint_seed(tiles.first + ivec2(0, 1), tiles.stream);
    tiles.seed_3 = glint_seed(tiles.first + ivec2(1, 1), tiles.stream);
    return tiles;
}

// Tint times weight of the flake in one tile whose lobe may hold the half vector; `lobe` as in the flakes, or wider.
vec3 glint_tile(GlintFlakes flakes, GlintFootprint footprint, ivec2 tile, uint level, uint stream, uvec2 seed, vec2 square, float lobe) {
    float cells = float(1u << flakes.fineness);
    // The square of normals is moved, and goes on at the opposite side: each flake's normal is uniform.
    vec2 place = fract(square * 0.5 + vec2(seed.x >> 16u, seed.x & 0xffffu) * (1.0 / 65536.0)) * cells;
    vec2 cell = min(floor(place), cells - 1.0);
    vec2 offset = place - cell - 0.5;
    float u = dot(offset, offset) / (lobe * lobe);
    if (u >= 1.0) {
        return vec3(0.0);
    }
    float angular = 3.0 * 0.318309886 / (lobe * lobe) * (1.0 - u) * (1.0 - u);
    uint number = glint_shuffle(uint(cell.x) | uint(cell.y) << flakes.fineness, flakes.fineness, seed.y);
    ivec2 flake = (tile << flakes.fineness) + ivec2(number & uint(cells - 1.0), number >> flakes.fineness);
    float area = exp2(2.0 * float(flakes.fineness + level));
    return glint_flake(flakes, footprint, flake, level, stream).rgb * (angular * area);
}

// The factor on the smooth lobe, were only the flakes of those tiles there. Its mean is 1 times the mean tint.
vec3 glint_level(GlintFlakes flakes, GlintFootprint footprint, GlintTiles tiles, vec2 square, float lobe) {
    ivec2 first = tiles.first;
    uint level = tiles.level;
    uint stream = tiles.stream;
    return glint_tile(flakes, footprint, first, level, stream, tiles.seed_0, square, lobe)
        + glint_tile(flakes, footprint, first + ivec2(1, 0), level, stream, tiles.seed_1, square, lobe)
        + glint_tile(flakes, footprint, first + ivec2(0, 1), level, stream, tiles.seed_2, square, lobe)
        + glint_tile(flakes, footprint, first + ivec2(1, 1), level, stream, tiles.seed_3, square, lobe);
}

// Mean tint of flakes.
float glint_mean_tint(GlintFlakes flakes) {
    return 1.0 - 0.5 * flakes.variation;
}

// Radius of the lobe, in cells of the square, as a pixel sees it in which the half vector's place in the square varies by
// `spread`: the sum of its squared changes to the next pixels.
float glint_lobe(GlintFlakes flakes, float spread) {
    float cells = 0.5 * float(1u << flakes.fineness);
    return sqrt(flakes.lobe * flakes.lobe + min(spread, 8.0) * cells * cells);
}

// log2 of the cells along the square of normals when a lobe of that radius, in cells of the finest square, is wider than
// half a cell: so few cells that it fits in one. Tiles shrink with it, and still hold one flake that can flash.
uint glint_fineness(GlintFlakes flakes, float lobe) {
    float finer = max(ceil(log2(lobe) + 0.9999), 0.0);
    return flakes.fineness - min(uint(finer), flakes.fineness);
}

// One flake that a pixel may show as a disc, with its normal.
GlintDisc glint_disc(GlintFlakes flakes, GlintFootprint footprint, ivec2 place, uint chart) {
    GlintDisc disc;
    disc.tinted = glint_flake(flakes, footprint, place, 0u, chart * 16u);
    uvec2 seed = glint_seed(place >> flakes.fineness, chart * 16u);
    uint last = (1u << flakes.fineness) - 1u;
    uvec2 in_tile = uvec2(place) & last;
    uint number = glint_unshuffle(in_tile.x | in_tile.y << flakes.fineness, flakes.fineness, seed.y);
    vec2 cell = vec2(number & last, number >> flakes.fineness) + 0.5;
    vec2 moved = cell / float(last + 1u) - vec2(seed.x >> 16u, seed.x & 0xffffu) * (1.0 / 65536.0);
    disc.square = 2.0 * (moved - floor(moved + 0.5));
    return disc;
}

// All of them.
GlintDiscs glint_discs(GlintFlakes flakes, GlintFootprint footprint, uint chart) {
    GlintDiscs discs;
    discs.apart = clamp((0.45 - footprint.blur) * 4.0, 0.0, 1.0);
    ivec2 first = footprint.cell + ivec2(floor(footprint.within - 0.5));
    discs.first = glint_disc(flakes, footprint, first, chart);
    discs.right = glint_disc(flakes, footprint, first + ivec2(1, 0), chart);
    discs.up = glint_disc(flakes, footprint, first + ivec2(0, 1), chart);
    discs.both = glint_disc(flakes, footprint, first + ivec2(1, 1), chart);
    return discs;
}

// Tint and share of area of the flakes in a pixel over their mean share: 1 in the mean. Where the pixel no longer tells
// discs apart, just that. Where soft edges meet they cover no more than all, 1 over the discs' share of a rhombus.
vec4 glint_cover(GlintFlakes flakes, GlintDiscs discs) {
    vec4 mean = vec4(vec3(glint_mean_tint(flakes)), 1.0);
    vec4 sum = discs.first.tinted + discs.right.tinted + discs.up.tinted + discs.both.tinted;
    float covered = 3.62759873 * flakes.radius * flakes.radius * sum.w; // pi / sin 60 degrees
    return mix(mean, sum / max(covered, 1.0), discs.apart);
}

// Tint times weight of a disc whose lobe holds the half vector; `lobe` in cells, at most half the square.
vec3 glint_disc_flash(GlintFlakes flakes, GlintDisc disc, vec2 square, float lobe) {
    float cells = float(1u << flakes.fineness);
    vec2 offset = 0.5 * (square - disc.square);
    offset = (offset - floor(offset + 0.5)) * cells;
    float u = dot(offset, offset) / (lobe * lobe);
    float left = max(1.0 - u, 0.0);
    return disc.tinted.rgb * (3.0 * 0.318309886 * cells * cells / (lobe * lobe) * left * left);
}

// The factor on the smooth lobe in a pixel that tells discs apart. Lobes wider than all normals make no difference.
vec3 glint_discs_flash(GlintFlakes flakes, GlintDiscs discs, vec2 square, float lobe) {
    float seen = min(lobe, 0.5 * float(1u << flakes.fineness));
    vec3 sum = glint_disc_flash(flakes, discs.first, square, seen) + glint_disc_flash(flakes, discs.right, square, seen)
        + glint_disc_flash(flakes, discs.up, square, seen) + glint_disc_flash(flakes, discs.both, square, seen);
    return mix(vec3(glint_mean_tint(flakes)), sum, seen / lobe);
}

// The factor on the smooth lobe in a pixel that sees levels of tiles: 1 times the mean tint in the mean. Lobes wider than
// all normals make no difference.
vec3 glint_tiles_flash(GlintFlakes flakes, GlintFootprint footprint, GlintLevels levels, GlintTiles near, GlintTiles far, vec2 square, float lobe) {
    float seen = min(lobe, 0.5);
    float share = seen / lobe;
    vec3 flash = vec3(glint_mean_tint(flakes) * (1.0 - share * (levels.near + levels.far)));
    if (levels.near > 0.0) {
        flash += share * levels.near * glint_level(flakes, footprint, near, square, seen);
    }
    if (levels.far > 0.0) {
        flash += share * levels.far * glint_level(flakes, footprint, far, square, seen);
    }
    return flash;
}

// The smooth lobe times the cosine of l: GGX of flakes of that colour with the compensation of standard.glsl.
vec3 glint_smooth_times_cosine(vec3 color, vec3 compensation, float alpha, vec3 v, vec3 l) {
    if (v.z <= 0.0 || l.z <= 0.0) {
        return vec3(0.0);
    }
    vec3 h = ggx_half_vector(v, l);
    float lobe = ggx_ndf(h, alpha, alpha) * ggx_masking_shadowing_times_cosine(v, l, alpha, alpha);
    return schlick(color, dot(v, h)) * compensation * lobe;
}

#endif
