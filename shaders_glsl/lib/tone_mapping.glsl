// Tone mapping: scene-referred linear Rec. 709 to display-referred linear in [0, 1]; encode with srgb_from_linear.
// Functions only. Inputs are limited to [0, 65504], where every curve is flat, so that nothing overflows.
//
// Sources: Hill 2017, BakingLab (ACES fit); Sobotka's AgX in Wrensch's form (2023, "Minimal AgX Implementation");
// Khronos 2024, "PBR Neutral Tone Mapper".
#ifndef VAIR_TONE_MAPPING_GLSL
#define VAIR_TONE_MAPPING_GLSL

vec3 tonemap_limited(vec3 color) {
    return clamp(color, vec3(0.0), vec3(65504.0));
}

// No curve: clamped to [0, 1].
vec3 tonemap_none(vec3 color) {
    return clamp(color, vec3(0.0), vec3(1.0));
}

// ACES, Hill's fit with the usual exposure of 1 / 0.6.
vec3 tonemap_aces(vec3 color) {
    color = tonemap_limited(color) / 0.6;
    vec3 x = vec3(dot(vec3(0.59719, 0.35458, 0.04823), color),
                  dot(vec3(0.07600, 0.90834, 0.01566), color),
                  dot(vec3(0.02840, 0.13383, 0.83777), color));
    vec3 curve = (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.4329510) + 0.238081);
    vec3 shown = vec3(dot(vec3(1.60475, -0.53108, -0.07367), curve),
                      dot(vec3(-0.10208, 1.10813, -0.00605), curve),
                      dot(vec3(-0.00327, -0.07276, 1.07602), curve));
    return clamp(shown, vec3(0.0), vec3(1.0));
}

// AgX: inset, log2 encoding over 16.5 stops, sigmoid, outset; linear by the display's 2.2 power.
vec3 tonemap_agx(vec3 color) {
    color = tonemap_limited(color);
    vec3 inner = vec3(dot(vec3(0.842479062, 0.078433600, 0.079223745), color),
                      dot(vec3(0.042328242, 0.878468636, 0.079166127), color),
                      dot(vec3(0.042375655, 0.078433600, 0.879142974), color));
    vec3 x = clamp((log2(max(inner, vec3(1e-10))) + 12.47393) / (4.026069 + 12.47393), vec3(0.0), vec3(1.0));
    vec3 curve = x * (0.1191 + x * (0.4298 + x * (-6.868 + x * (31.96 + x * (-40.14 + x * 15.5))))) - 0.00232;
    vec3 shown = vec3(dot(vec3(1.196879005, -0.098020881, -0.099029744), curve),
                      dot(vec3(-0.052896852, 1.151903130, -0.098961177), curve),
                      dot(vec3(-0.052971636, -0.098043450, 1.151073673), curve));
    return pow(clamp(shown, vec3(0.0), vec3(1.0)), vec3(2.2));
}

// Khronos PBR Neutral: keeps colours whose peak stays below 0.8, compresses and desaturates the highlights above.
vec3 tonemap_neutral(vec3 color) {
    const float start = 0.8 - 0.04;
    const float desaturation = 0.15;
    color = tonemap_limited(color);
    float least = min(color.r, min(color.g, color.b));
    color -= least < 0.08 ? least - 6.25 * least * least : 0.04;
    float peak = max(color.r, max(color.g, color.b));
    if (peak < start) {
        return color;
    }
    const float room = 1.0 - start;
    float new_peak = 1.0 - room * room / (peak + room - start);
    float grey = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    return clamp(mix(color * (new_peak / peak), vec3(new_peak), grey), vec3(0.0), vec3(1.0));
}

#endif
