#version 460
#extension GL_GOOGLE_include_directive : require
// Skinning and morphing of one vertex stream, once a frame. One dispatch a stream: positions, directions that
// turn like normals, tangents. Order: morph, then skin (glTF 2.0, section 3.7.3).

layout(constant_id = 0) const uint STREAM = 0; // 0 position, 1 normal or shell direction, 2 tangent (four floats)

layout(local_size_x = 64) in;

struct SkinningDraw {
    uint vertex_count;
    uint influences_per_vertex; // joints a vertex; a multiple of 4
    uint target_count;          // morph targets
    uint first_joint;           // entry of the joint list
    uint first_weight;          // entry of the morph weights
};
layout(push_constant) uniform SkinningBlock { SkinningDraw draw; };

layout(set = 0, binding = 0, std430) readonly buffer SourceStream { float source[]; };
layout(set = 0, binding = 1, std430) writeonly buffer TargetStream { float target[]; };
#ifdef SKIN
layout(set = 0, binding = 2, std430) readonly buffer JointList { mat4 world_from_bind[]; };
// One word a joint influence: the joint's index; weights in a second list.
layout(set = 0, binding = 3, std430) readonly buffer InfluenceList { uint influence_joint[]; };
layout(set = 0, binding = 4, std430) readonly buffer InfluenceWeightList { float influence_weight[]; };
#endif
#ifdef MORPH
layout(set = 0, binding = 5, std430) readonly buffer MorphDeltas { float deltas[]; }; // [target][vertex][3]
layout(set = 0, binding = 6, std430) readonly buffer MorphWeights { float weights[]; };
#endif

// The inverse transpose times |determinant|: defined for singular matrices, and right for mirrored ones.
mat3 normal_matrix(mat3 m) {
    mat3 cofactors = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    return dot(m[0], cofactors[0]) < 0.0 ? -1.0 * cofactors : cofactors;
}

void main() {
    uint vertex = gl_GlobalInvocationID.x;
    if (vertex >= draw.vertex_count) { return; }
    uint stream = STREAM;
    uint stride = stream == 2u ? 4u : 3u;
    uint first = vertex * stride;
    vec3 value = vec3(source[first], source[first + 1u], source[first + 2u]);
#ifdef MORPH
    for (uint index = 0u; index < draw.target_count; ++index) {
        uint delta = (index * draw.vertex_count + vertex) * 3u;
        value += weights[draw.first_weight + index] * vec3(deltas[delta], deltas[delta + 1u], deltas[delta + 2u]);
    }
#endif
    vec3 fallback = value;
    float handedness = 1.0;
#ifdef SKIN
    mat4 blended = mat4(0.0);
    uint influence = vertex * draw.influences_per_vertex;
    for (uint index = 0u; index < draw.influences_per_vertex; ++index) {
        float weight = influence_weight[influence + index];
        if (weight > 0.0) { blended += weight * world_from_bind[draw.first_joint + influence_joint[influence + index]]; }
    }
    if (stream == 0u) { value = (blended * vec4(value, 1.0)).xyz; }
    else if (stream == 1u) { value = normal_matrix(mat3(blended)) * value; }
    else {
        value = mat3(blended) * value;
        if (determinant(mat3(blended)) < 0.0) { handedness = -1.0; }
    }
#endif
    if (stream != 0u) {
        // A direction that a morph or a squashed joint brings to zero keeps its source direction.
        float largest = max(max(abs(value.x), abs(value.y)), abs(value.z));
        vec3 scaled = largest > 0.0 ? value / largest : fallback;
        float length_squared = dot(scaled, scaled);
        value = length_squared > 0.0 ? scaled * inversesqrt(length_squared) : vec3(0.0, 1.0, 0.0);
    }
    uint out_first = vertex * stride;
    target[out_first] = value.x;
    target[out_first + 1u] = value.y;
    target[out_first + 2u] = value.z;
    if (stream == 2u) { target[out_first + 3u] = handedness * source[first + 3u]; }
}
