#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
// Linear HDR to the picture: exposure, tone curve, background, display encoding.
#include "color.glsl"
#include "tonemap.glsl"

layout(constant_id = 0) const uint OPERATOR = 0;      // 0 none, 1 aces, 2 agx, 3 neutral
layout(constant_id = 1) const bool ENCODE_SRGB = true;   // 0: the target encodes by itself
layout(constant_id = 2) const bool HAS_ALPHA = true;     // 0: the HDR format has no alpha, everything is opaque

struct TonemapDraw {
    vec3 background;           // linear RGB shown where nothing was drawn, display light
    float exposure;            // factor on radiance
    float background_opacity;  // 0: the picture keeps its alpha (not premultiplied)
    float background_is_light; // 1: the background is radiance and goes through exposure and tone curve
    float _reserved_1;
    float _reserved_2;
};

layout(set = 0, binding = 0) uniform texture2D hdr;
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
    vec3 background = draw.background_is_light > 0.5 ? display_from_radiance(draw.background * draw.exposure) : draw.background;
    vec3 over = mix(background, display, opacity);
    vec3 shown = draw.background_opacity > 0.5 ? over : display;
    float alpha = draw.background_opacity > 0.5 ? 1.0 : opacity;
    color = vec4(ENCODE_SRGB ? srgb_from_linear(shown) : shown, alpha);
}
