// What every pass of one frame shares. Mirrored to Rust by build.rs.
#ifndef VAIR_FRAME_GLSL
#define VAIR_FRAME_GLSL

const uint LIGHT_DIRECTIONAL = 0;
const uint LIGHT_POINT = 1;
const uint LIGHT_SPOT = 2;

// Largest radiance that every HDR format holds (the ten-bit blue of B10G11R11).
const float RADIANCE_LIMIT = 64512.0;

struct FrameUniforms {
    mat4 clip_from_world;      // of our own views reversed Z, Y up; of a host's views as the host has it
    vec3 eye_in_world;         // metres
    float pre_exposure;        // factor on all radiance that is written
    vec3 view_in_world;        // unit vector against the view direction; the view vector of a parallel camera
    float orthographic;        // 1 for a parallel camera, 0 for perspective
    vec3 environment_scale;    // linear RGB radiance of a texel of 1 in the environment's map
    float environment_levels;  // number of the map's last level
    vec2 environment_turn;     // cosine and sine of the environment's rotation around +Y
    float _reserved_0;
    float _reserved_1;
    // Linear RGB radiance of the environment as real spherical harmonics of bands 0 to 4, orthonormal, coefficient
    // l * l + l + m; in the environment's own axes, z the polar one.
    vec4 environment_harmonics[25];
};

struct LightSource {
    vec3 position_in_world;    // metres; point and spot
    float range_m;             // metres; 0 = infinite
    vec3 direction_to_light;   // unit vector; directional: towards the light, spot: against its axis
    uint kind;                 // LIGHT_*
    vec3 intensity;            // linear RGB: lux (directional) or candela (point, spot)
    float spot_scale;          // 1 / (cos inner - cos outer)
    float spot_offset;         // -cos outer * spot_scale
    uint first_shadow;         // entry of the shadow list
    uint shadow_count;         // entries from there on, the finest map first
    float _reserved_0;
};

#endif
