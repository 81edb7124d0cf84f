// Texture coordinates: KHR_texture_transform, and a projection for meshes that have none.
#ifndef VAIR_UV_GLSL
#define VAIR_UV_GLSL
#include "standard_material.glsl"

vec2 uv_transformed(TextureTransform transform, vec2 uv_0, vec2 uv_1) {
    vec3 uv = vec3(transform.uv_set == 0u ? uv_0 : uv_1, 1.0);
    return vec2(dot(transform.row_u, uv), dot(transform.row_v, uv));
}

// Change of the transformed coordinates, for a change of both sets.
vec2 uv_gradient(TextureTransform transform, vec4 change) {
    vec2 uv = transform.uv_set == 0u ? change.xy : change.zw;
    return vec2(dot(transform.row_u.xy, uv), dot(transform.row_v.xy, uv));
}

// Box projection: the two coordinates across the normal's largest axis.
vec2 uv_projected(vec3 position, vec3 normal) {
    vec3 size = abs(normal);
    if (size.x >= size.y && size.x >= size.z) { return position.zy; }
    if (size.y >= size.z) { return position.xz; }
    return position.xy;
}

#endif
