// Where an object stands. Mirrored to Rust by build.rs.

struct ObjectUniforms {
    mat4 world_from_object;    // identity for skinned objects: the deform pass already wrote world space
    mat4 normal_from_object;   // cofactor matrix of world_from_object, for normals; w unused
};

struct ObjectDraw {
    uint object_index;         // entry of the object list
};
