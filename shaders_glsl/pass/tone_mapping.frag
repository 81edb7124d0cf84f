#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
// Linear HDR to the picture: exposure, tone curve, background, display encoding.
#include "color.glsl"
#include "tone_mapping.glsl"
#ifdef SKYBOX
#include "environment.glsl"
#endif

layout(constant_id = 0) const uint OPERATOR = 0;      // 0 none, 1 aces, 2 agx, 3 neutral
layout(constant_id = 1) const bool ENCODE_SRGB = true;   // 0: the target encodes by itself
layout(constant_id = 2) const bool HAS_ALPHA = true;     // 0: the HDR format has no alpha, everything is opaque

struct ToneMappingDraw {
    vec3 background;           // linear RGB shown where nothing was drawn, display light
    float exposure;            // factor on radiance
    float background_opacity;  // 0: the picture keeps its alpha (not premultiplied)
    float background_is_light; // 1: the background is radiance and goes through exposure and tone curve
    float skybox_scale;      // SKYBOX: radiance of a texel of 1
    float _reserved_1;
    vec3 skybox_corner;      // from the eye, in the environment's axes, through the picture's top left corner
    float _reserved_2;
    vec3 skybox_right;       // to the next pixel
    float _reserved_3;
    vec3 skybox_down;
    float _reserved_4;
};

layout(set = 0, binding = 0) uniform texture2D hdr;
#ifdef SKYBOX
layout(set = 0, binding = 1) uniform texture2D skybox; // equirectangular
layout(set = 0, binding = 2) uniform sampler skybox_sampler;
#endif
layout(push_constant) uniform ToneMappingBlock { ToneMappingDraw draw; };
layout(location = 0) out vec4 color;

vec3 display_from_radiance(vec3 radiance) {
    uint operator = OPERATOR;
    if (operator == 1u) { return tonemap_aces(radiance); }
    if (operator == 2u) { return tonemap_agx(radiance); }
    if (operator == 3u) { return tonemap_neutral(radiance); }
    return clamp(radiance, 0.0, 1.0);
}

void main() {
    vec4 premultiplied = texelFetch(hdr, ivec2(gl_FragCoord.xy), 0);
    float opacity = HAS_ALPHA ? clamp(premultiplied.a, 0.0, 1.0) : 1.0;
    // The curve bends radiance, not coverage: divide before it, multiply after it.
    vec3 radiance = max(premultiplied.rgb, vec3(0.0)) * draw.exposure;
    if (opacity > 0.0) { radiance /= opacity; }
    vec3 display = display_from_radiance(radiance);
    vec3 behind = draw.background;
#ifdef SKYBOX
    if (opacity < 1.0) {
        vec3 ray = draw.skybox_corner + gl_FragCoord.x * draw.skybox_right + gl_FragCoord.y * draw.skybox_down;
        vec2 uv = environment_uv(ray * inversesqrt(dot(ray, ray)));
        behind = draw.skybox_scale * textureLod(sampler2D(skybox, skybox_sampler), uv, 0.0).rgb;
    }
#endif
    vec3 background = draw.background_is_light > 0.5 ? display_from_radiance(behind * draw.exposure) : behind;
    vec3 over = mix(background, display, opacity);
    vec3 shown = draw.background_opacity > 0.5 ? over : display;
    float alpha = draw.background_opacity > 0.5 ? 1.0 : opacity;
    color = vec4(ENCODE_SRGB ? srgb_from_linear(shown) : shown, alpha);
}
