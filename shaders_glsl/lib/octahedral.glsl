// Unit vectors as two numbers. Source: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit
// Vectors" (oct: the sphere as an octahedron, its lower half folded out).
#ifndef VAIR_OCTAHEDRAL_GLSL
#define VAIR_OCTAHEDRAL_GLSL

vec2 octahedral_folded(vec2 p) {
    return (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
}

// In [-1, 1].
vec2 octahedral_from_direction(vec3 direction) {
    vec2 p = direction.xy / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    return direction.z >= 0.0 ? p : octahedral_folded(p);
}

vec3 octahedral_direction(vec2 p) {
    float z = 1.0 - abs(p.x) - abs(p.y);
    return normalize(vec3(z >= 0.0 ? p : octahedral_folded(p), z));
}

#endif
