// Locks of strands.
#ifndef VAIR_LOCK_GLSL
#define VAIR_LOCK_GLSL
#include "hash.glsl"

// Strand spacings across a lock.
const float LOCK_SIZE = 9.0;
// Jitter of a lock's middle, in locks; less than a strand's, so that the nearest of eight is nearest of all.
const float LOCK_JITTER = 0.25;

// Locks: strands gather towards the middle of their lock and coil in step with it, more so at the tip. Gives the root
// that the strand passing here grew from.
vec3 lock_root(vec3 position_in_cells, vec3 normal, float height, float clump, float curl) {
    vec3 in_locks = position_in_cells / LOCK_SIZE;
    vec3 corner = floor(in_locks - 0.5);
    vec3 middle = vec3(0.0);
    float nearest = 1e9;
    float own_random = 0.0;
    for (int index = 0; index < 8; ++index) {
        vec3 cell = corner + vec3(float(index & 1), float((index >> 1) & 1), float(index >> 2));
        vec3 random = hash_cell(ivec3(cell) + 7919);
        vec3 offset = cell + 0.5 + (random * 2.0 - 1.0) * LOCK_JITTER - in_locks;
        float distance_squared = dot(offset, offset);
        if (distance_squared < nearest) {
            nearest = distance_squared;
            middle = offset;
            own_random = random.x;
        }
    }
    vec3 from_middle = -(middle - dot(middle, normal) * normal) * LOCK_SIZE;
    float gather = 1.0 / max(1.0 - 0.85 * clump * height, 0.1);
    vec3 root = position_in_cells + from_middle * (gather - 1.0);
    // A coil of two turns whose radius grows to a cell; at the skin it is nought, so roots hold still.
    vec3 side = normalize(abs(normal.y) < 0.9 ? cross(normal, vec3(0.0, 1.0, 0.0)) : cross(normal, vec3(1.0, 0.0, 0.0)));
    float turn = 12.5663706 * (own_random < 0.5 ? -height : height) + 6.28318531 * own_random;
    return root + curl * height * (cos(turn) * side + sin(turn) * cross(normal, side));
}

#endif
