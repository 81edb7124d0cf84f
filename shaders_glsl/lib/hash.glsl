// Integer hashes: the same bits on every device.
// Source: Jarzynski & Olano 2020, "Hash Functions for GPU Rendering", pcg3d.
#ifndef VAIR_HASH_GLSL
#define VAIR_HASH_GLSL

uvec3 hash_pcg3d(uvec3 key) {
    key = key * 1664525u + 1013904223u;
    key.x += key.y * key.z;
    key.y += key.z * key.x;
    key.z += key.x * key.y;
    key ^= key >> 16u;
    key.x += key.y * key.z;
    key.y += key.z * key.x;
    key.z += key.x * key.y;
    return key;
}

// Three uniform numbers in [0, 1) from a lattice cell: the top 24 bits, so that every value is exact.
vec3 hash_cell(ivec3 cell) {
    uvec3 bits = hash_pcg3d(uvec3(cell));
    return vec3(bits >> 8u) * (1.0 / 16777216.0);
}

#endif
