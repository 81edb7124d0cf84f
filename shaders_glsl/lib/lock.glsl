// Locks of strands.
#ifndef VAIR_LOCK_GLSL
#define VAIR_LOCK_GLSL
#include "hash.glsl"

// Strand spacings across a lock.
const float LOCK_SIZE = 9.0;
// Jitter of a lock's middle, in locks; less than a strand's, so that the nearest of eight is nearest of all.
const float LOCK_JITTER = 0.25;

// The lock that a strand belongs to.
struct Lock {
    vec3 from_middle; // from the lock's middle to the place, across the strands, in strand spacings
    float random;     // in [0, 1), one number a lock
};

// The lock at a place.
Lock lock_at(vec3 position_in_cells, vec3 normal) {
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
    return Lock((dot(middle, normal) * normal - middle) * LOCK_SIZE, own_random);
}

// Strands gather towards the middle of their lock and coil in step with it, more so at the tip. Gives the way from a
// place in the lock, `from_middle` off its middle, to the root that the strand passing there at `height` grew from.
vec3 lock_way_to_root(vec3 from_middle, float random, vec3 normal, float height, float clump, float curl) {
    float gather = 1.0 / max(1.0 - 0.85 * clump * height, 0.1);
    // A coil of two turns whose radius grows to a cell; at the skin it is nought, so roots hold still.
    vec3 side = normalize(abs(normal.y) < 0.9 ? cross(normal, vec3(0.0, 1.0, 0.0)) : cross(normal, vec3(1.0, 0.0, 0.0)));
    float turn = 12.5663706 * (random < 0.5 ? -height : height) + 6.28318531 * random;
    return from_middle * (gather - 1.0) + curl * height * (cos(turn) * side + sin(turn) * cross(normal, side));
}

#endif
