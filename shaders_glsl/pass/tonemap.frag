#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
// Linear HDR to the picture: exposure, tone curve, background, display encoding.
#include "color.glsl"
#include "tonemap.glsl"
#ifdef BACKDROP
#include "environment.glsl"
#endif

layout(constant_id = 0) const uint OPERATOR = 0;      // 0 none, 1 aces, 2 agx, 3 neutral
layout(constant_id = 1) const bool ENCODE_SRGB = true;   // 0: the target encodes by itself
layout(constant_id = 2) const bool HAS_ALPHA = true;     // 0: the HDR format has no alpha, everything is opaque

struct TonemapDraw {
    vec3 background;           // linear RGB shown where nothing was drawn, display light
    float exposure;            // factor on radiance
    float background_opacity;  // 0: the picture keeps its alpha (not premultiplied)
    float background_is_light; // 1: the background is radiance and goes through exposure and tone curve
    float backdrop_scale;      // BACKDROP: radiance of a texel of 1
    float _reserved_1;
    vec3 backdrop_corner;      // from the eye, in the environment's axes, through the picture's top left corner
    float _reserved_2;
    vec3 backdrop_right;       // to the next pixel
    float _reserved_3;
    vec3 backdrop_down;
    float _reserved_4;
};

layout(set = 0, binding = 0) uniform texture2D hdr;
#ifdef BACKDROP
layout(set = 0, binding = 1) uniform texture2D backdrop; // equirectangular
layout(set = 0, binding = 2) uniform sampler backdrop_sampler;
#endif
layout(push_constant) uniform TonemapBlock { TonemapDraw draw; };
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
#ifdef BACKDROP
    if (opacity < 1.0) {
        vec3 ray = draw.backdrop_corner + gl_FragCoord.x * draw.backdrop_right + gl_FragCoord.y * draw.backdrop_down;
        vec2 uv = environment_uv(ray * inversesqrt(dot(ray, ray)));
        behind = draw.backdrop_scale * textureLod(sampler2D(backdrop, backdrop_sampler), uv, 0.0).rgb;
    }
#endif
    vec3 background = draw.background_is_light > 0.5 ? display_from_radiance(behind * draw.exposure) : behind;
    vec3 over = mix(background, display, opacity);
    vec3 shown = draw.background_opacity > 0.5 ? over : display;
    float alpha = draw.background_opacity > 0.5 ? 1.0 : opacity;
    color = vec4(ENCODE_SRGB ? srgb_from_linear(shown) : shown, alpha);
}
