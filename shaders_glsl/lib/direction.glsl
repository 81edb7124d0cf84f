// Unit vectors from vectors that may be nothing: normalize(0) is NaN on some devices and poisons the picture.

vec3 direction_or(vec3 vector, vec3 fallback) {
    float length_squared = dot(vector, vector);
    return length_squared > 1e-30 ? vector * inversesqrt(length_squared) : fallback;
}
