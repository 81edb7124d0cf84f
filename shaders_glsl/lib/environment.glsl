// Light from all around: where a direction lies in an equirectangular picture and on a cube, spherical harmonics, and the
// lobes by which a cube of radiance is blurred and read. Functions only; directions are unit vectors.
//
// Sources: Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps" (harmonics); Karis
// 2013, "Real Shading in Unreal Engine 4" (prefiltered radiance); Krivanek & Colbert 2008, "Real-time Shading with Filtered
// Importance Sampling"; Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
#ifndef VAIR_ENVIRONMENT_GLSL
#define VAIR_ENVIRONMENT_GLSL
#include "ggx.glsl"
#include "sheen.glsl"

// Sheets of the table of lobes; a sheen model has the one of its number and 1.
const uint ENVIRONMENT_GGX = 0u;
// Sheets of that table.
const uint ENVIRONMENT_SHEETS = 4u;
// Coefficients of the harmonics: bands 0 to 4.
const uint ENVIRONMENT_IRRADIANCE = 25u;

// A direction of the world as the environment sees it, which is turned about +Y; rotation = cosine and sine, positive
// right-handed.
vec3 environment_from_world(vec3 direction_in_world, vec2 rotation) {
    return vec3(rotation.x * direction_in_world.x - rotation.y * direction_in_world.z, direction_in_world.y,
                rotation.y * direction_in_world.x + rotation.x * direction_in_world.z);
}

// Where an equirectangular picture has a direction: u around, 1/2 at +X and 3/4 at +Z; v from +Y down.
vec2 environment_uv(vec3 direction) {
    vec2 ground = direction.xz;
    float reach = length(ground);
    float u = reach > 0.0 ? atan(ground.y, ground.x) * 0.159154943 + 0.5 : 0.5;
    return vec2(u, atan(reach, direction.y) * 0.318309886);
}

// The direction at a place of a cube's face, in Vulkan's order and orientation (+X -X +Y -Y +Z -Z; "Cube Map Face
// Selection"); place in [-1, 1], x to the right and y down.
vec3 environment_face_direction(uint face, vec2 place) {
    vec3 toward = face == 0u   ? vec3(1.0, -place.y, -place.x)
                  : face == 1u ? vec3(-1.0, -place.y, place.x)
                  : face == 2u ? vec3(place.x, 1.0, place.y)
                  : face == 3u ? vec3(place.x, -1.0, -place.y)
                  : face == 4u ? vec3(place.x, -place.y, 1.0)
                               : vec3(-place.x, -place.y, -1.0);
    return toward * inversesqrt(dot(toward, toward));
}

// The inverse: place in x and y, face in z.
vec3 environment_face_place(vec3 direction) {
    vec3 size = abs(direction);
    if (size.x >= size.y && size.x >= size.z) {
        return vec3(vec2(direction.x > 0.0 ? -direction.z : direction.z, -direction.y) / size.x,
                    direction.x > 0.0 ? 0.0 : 1.0);
    }
    if (size.y >= size.z) {
        return vec3(vec2(direction.x, direction.y > 0.0 ? direction.z : -direction.z) / size.y,
                    direction.y > 0.0 ? 2.0 : 3.0);
    }
    return vec3(vec2(direction.z > 0.0 ? direction.x : -direction.x, -direction.y) / size.z,
                direction.z > 0.0 ? 4.0 : 5.0);
}

// Solid angle a unit of area of a face, whose place counts in [-1, 1].
float environment_face_density(vec2 place) {
    float squared = 1.0 + dot(place, place);
    return 1.0 / (squared * sqrt(squared));
}

// Real spherical harmonic, orthonormal over the sphere and without the Condon-Shortley sign; index = l * l + l + m, below
// ENVIRONMENT_IRRADIANCE.
float environment_sh(uint index, vec3 d) {
    float x2 = d.x * d.x;
    float y2 = d.y * d.y;
    float z2 = d.z * d.z;
    switch (index) {
        case 0u: return 0.282094792;
        case 1u: return 0.488602512 * d.y;
        case 2u: return 0.488602512 * d.z;
        case 3u: return 0.488602512 * d.x;
        case 4u: return 1.09254843 * d.x * d.y;
        case 5u: return 1.09254843 * d.y * d.z;
        case 6u: return 0.315391565 * (3.0 * z2 - 1.0);
        case 7u: return 1.09254843 * d.x * d.z;
        case 8u: return 0.546274215 * (d.x - d.y) * (d.x + d.y);
        case 9u: return 0.590043589 * d.y * (3.0 * x2 - y2);
        case 10u: return 2.89061144 * d.x * d.y * d.z;
        case 11u: return 0.457045799 * d.y * (5.0 * z2 - 1.0);
        case 12u: return 0.373176333 * d.z * (5.0 * z2 - 3.0);
        case 13u: return 0.457045799 * d.x * (5.0 * z2 - 1.0);
        case 14u: return 1.44530572 * d.z * (d.x - d.y) * (d.x + d.y);
        case 15u: return 0.590043589 * d.x * (x2 - 3.0 * y2);
        case 16u: return 2.50334294 * d.x * d.y * (d.x - d.y) * (d.x + d.y);
        case 17u: return 1.77013077 * d.y * d.z * (3.0 * x2 - y2);
        case 18u: return 0.946174696 * d.x * d.y * (7.0 * z2 - 1.0);
        case 19u: return 0.669046544 * d.y * d.z * (7.0 * z2 - 3.0);
        case 20u: return 0.105785547 * (z2 * (35.0 * z2 - 30.0) + 3.0);
        case 21u: return 0.669046544 * d.x * d.z * (7.0 * z2 - 3.0);
        case 22u: return 0.473087348 * (d.x - d.y) * (d.x + d.y) * (7.0 * z2 - 1.0);
        case 23u: return 1.77013077 * d.x * d.z * (x2 - 3.0 * y2);
        default: return 0.625835735 * (x2 * x2 - 6.0 * x2 * y2 + y2 * y2);
    }
}

// What the clamped cosine, which integrates to 1, makes of a band of harmonics; band below 5.
float environment_cosine_band(uint band) {
    return band == 0u ? 1.0 : band == 1u ? 0.666666667 : band == 2u ? 0.25 : band == 3u ? 0.0 : -0.0416666667;
}

// Point of `count` evenly spread ones in the open unit square (Hammersley, with the radical inverse of base 2).
vec2 environment_hammersley(uint index, uint count) {
    // The top 24 bits, which a float holds; half a step further both are the middles of as many strips.
    float inverse = float(bitfieldReverse(index) >> 8u) * 5.96046448e-8;
    return vec2((float(index) + 0.5) / float(count), min(inverse + 0.5 / float(count), 0.99999994));
}

// The facet that v sees, by the square's point u; its density is D(h) max(v.h, 0) G1(v) / v.z. v.z >= 0.
vec3 environment_visible_facet(vec2 u, vec3 v, float alpha) {
    vec3 stretched = vec3(v.xy * alpha, v.z);
    stretched *= inversesqrt(max(dot(stretched, stretched), 1e-30));
    // The cap above -stretched.z; its top stands as it is, since z + stretched.z would cancel.
    float top = (1.0 - u.y) * (1.0 + stretched.z);
    float z = top - stretched.z;
    float around = 6.28318531 * u.x;
    vec2 cap = sqrt(max((1.0 - z) * (1.0 + z), 0.0)) * vec2(cos(around), sin(around));
    vec3 facet = vec3((cap + stretched.xy) * alpha, max(top, 1e-7));
    return facet * inversesqrt(dot(facet, facet));
}

// Smith's G1; mu in [0, 1].
float environment_masking(float mu, float alpha) {
    float a2 = alpha * alpha;
    return 2.0 * mu / max(mu + sqrt(a2 + (1.0 - a2) * mu * mu), 1e-30);
}

// Which level of the cube holds a perceptual roughness, in [0, last_level]: level k that of alpha (2^k - 1) / (2^last - 1),
// so that every lobe is as many texels wide. Level 0 is a mirror.
float environment_level(float roughness, float last_level) {
    return log2(1.0 + clamp(roughness * roughness, 0.0, 1.0) * (exp2(last_level) - 1.0));
}

// The inverse of environment_level, alpha of a level; last_level > 0.
float environment_alpha_of_level(float level, float last_level) {
    return (exp2(level) - 1.0) / (exp2(last_level) - 1.0);
}

// Where the table of lobes has a cosine and a perceptual roughness; nodes = its width.
vec2 environment_table_uv(uint sheet, float mu, float roughness, float nodes) {
    vec2 place = clamp(vec2(sqrt(max(mu, 0.0)), roughness), 0.0, 1.0) * (nodes - 1.0) + 0.5;
    return vec2(place.x, place.y + nodes * float(sheet)) / (nodes * vec2(1.0, float(ENVIRONMENT_SHEETS)));
}

// Mean direction of a lobe in the plane of normal and eye; mirror = the table's, the ratio of its sine to the eye's, 1
// where it is the mirror direction. v unit, tangent frame.
vec3 environment_lobe_axis(vec3 v, float mirror) {
    vec2 across = -mirror * v.xy;
    return vec3(across, sqrt(max(1.0 - dot(across, across), 0.0)));
}

#endif
