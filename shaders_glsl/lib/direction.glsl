// Unit vectors from vectors that may be nothing: normalize(0) is NaN on some devices and poisons the picture.
#ifndef VAIR_DIRECTION_GLSL
#define VAIR_DIRECTION_GLSL

vec3 direction_or(vec3 vector, vec3 fallback) {
    // Squares of more than 1.8e19 are infinite.
    vector *= dot(vector, vector) < 1e30 ? 1.0 : 1e-20;
    float length_squared = dot(vector, vector);
    return length_squared > 1e-30 ? vector * inversesqrt(length_squared) : fallback;
}

// Tangent, bitangent and normal: some frame around the normal, which serves an isotropic lobe. Source: Duff et al.
// 2017, "Building an Orthonormal Basis, Revisited".
mat3 direction_frame(vec3 normal) {
    float side = normal.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (side + normal.z);
    float b = normal.x * normal.y * a;
    return mat3(vec3(1.0 + side * normal.x * normal.x * a, side * b, -side * normal.x),
                vec3(b, side + normal.y * normal.y * a, -normal.y), normal);
}

// Tangent, bitangent and normal with the tangent as near to the given one as the normal allows, or anywhere around the
// normal where that says nothing; side < 0 mirrors the bitangent.
mat3 direction_frame_along(vec3 normal, vec3 tangent, float side) {
    mat3 frame = direction_frame(normal);
    vec3 across = tangent - normal * dot(normal, tangent);
    if (dot(across, across) > 1e-8) {
        frame[0] = across * inversesqrt(dot(across, across));
        // Once more: after a subtraction that cancelled it is not yet perpendicular.
        frame[0] = direction_or(frame[0] - normal * dot(normal, frame[0]), frame[0]);
    }
    frame[1] = (side < 0.0 ? -1.0 : 1.0) * cross(normal, frame[0]);
    return frame;
}

#endif
