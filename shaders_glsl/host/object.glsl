// Where an object stands. Mirrored to Rust by build.rs.
#ifndef VAIR_OBJECT_GLSL
#define VAIR_OBJECT_GLSL

struct ObjectUniforms {
    mat4 world_from_object;    // identity for skinned objects: the deform pass already wrote world space
    mat4 normal_from_object;   // cofactor matrix of world_from_object, for normals
    float handedness;          // -1 where world_from_object mirrors, otherwise 1
    float world_from_rest;     // metres per unit of the rest pose
    float _reserved_1;
    float _reserved_2;
};

struct ObjectDraw {
    uint object_index;         // entry of the object list
    uint previous_object_index; // entry of the previous frame's object list
    uint shell;                // number of the shell, where every shell is a draw of its own
    uint vertices_per_shell;   // where the mesh holds its vertices once a shell
    uint first_light;          // entry of the light list
    uint light_count;          // entries from there on: the lights that reach the object
    uint rank;                 // of what blends, which lies over which where they are equally far: the higher
    float metres_per_unit;     // of the mesh
};

#endif
