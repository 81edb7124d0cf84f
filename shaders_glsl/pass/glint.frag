#version 460
#extension GL_GOOGLE_include_directive : require
// Glint: flakes over the standard surface, for sequins, lurex and glitter yarn. The flakes' lattice lies on the rest pose,
// in metres: they need no UVs, do not stretch with them, and stay where they are on the cloth as it moves.
#define CLOTH
#include "surface.glsl"
#include "glint_material.glsl"
#include "standard_environment.glsl"
#include "glint.glsl"

layout(constant_id = 20) const bool HAS_MASK_MAP = false;

layout(set = 1, binding = 20, std140) uniform GlintBlock { GlintUniforms glint; };
#ifdef MAPS
layout(set = 1, binding = 21) uniform texture2D mask_map;
layout(set = 1, binding = 22) uniform sampler mask_sampler;
#endif

layout(location = 5) in vec3 rest_position_m;
layout(location = 6) in vec3 normal_in_rest;

void main() {
    vec4 color = surface_color();
    int mask = surface_mask(color.a);
    SurfaceFragment f = surface_fragment(color);
    float share = glint.coverage;
#ifdef MAPS
    if (HAS_MASK_MAP) {
        vec2 uv = uv_transformed(glint.mask_transform, uv_sets.xy, uv_sets.zw);
        share *= texture(sampler2D(mask_map, mask_sampler), uv).r;
    }
#endif
    GlintFlakes flakes = GlintFlakes(glint.radius, glint.jitter, glint.lobe, glint.variation, glint.fineness);
    uint chart = glint_chart(normal_in_rest);
    vec3 place = rest_position_m * glint.cells_per_metre;
    GlintFootprint footprint = glint_footprint(flakes, glint_in_chart(place, chart),
        glint_in_chart(dFdx(place), chart), glint_in_chart(dFdy(place), chart));
    GlintDiscs discs;
    discs.apart = 0.0;
    vec4 cover = vec4(vec3(glint_mean_tint(flakes)), 1.0);
    if (footprint.blur < 0.45) {
        discs = glint_discs(flakes, footprint, chart);
        cover = glint_cover(flakes, discs);
    }
    GlintLevels flat_levels = glint_levels(footprint.reach, flakes.fineness);
    GlintTiles flat_near;
    GlintTiles flat_far;
    if (discs.apart <= 0.0) {
        flat_near = glint_tiles(footprint, flakes.fineness, flat_levels.first, chart);
        if (flat_levels.far > 0.0) { flat_far = glint_tiles(footprint, flakes.fineness, flat_levels.first + 1u, chart); }
    }
    // The half vectors of the next pixels are made of these. Taken of the half vector itself, among the lights, derivatives
    // would miss the pixels that the triangle does not cover: lavapipe leaves them out of loops.
    mat3 frame_right = mat3(dFdx(f.world_from_tangent[0]), dFdx(f.world_from_tangent[1]), dFdx(f.world_from_tangent[2]));
    mat3 frame_below = mat3(dFdy(f.world_from_tangent[0]), dFdy(f.world_from_tangent[1]), dFdy(f.world_from_tangent[2]));
    vec3 eye_right = f.eye_in_tangent + dFdx(f.eye_in_tangent);
    vec3 eye_below = f.eye_in_tangent + dFdy(f.eye_in_tangent);

    StandardSurface cloth = standard_surface(f.base_color, f.metallic, f.roughness, f.eye_in_tangent.z);
    vec2 terms = ggx_albedo_terms(f.eye_in_tangent.z, glint.flake_roughness);
    vec3 compensation = standard_specular_compensation(glint.flake_color, terms.x);
    float alpha = ggx_alpha(glint.flake_roughness);
    float bare = 1.0 - min(share * cover.w, 1.0);
    float metal = share * glint.intensity;

    vec3 flakes_ambient = compensated_albedo(glint.flake_color, 1.0, terms) * cover.rgb;
    vec3 flakes_light = mirrored_light(f, f.world_from_tangent, f.eye_in_tangent, glint.flake_roughness, glint.flake_color);
    vec3 sum = bare * standard_environment(f, cloth) + metal * flakes_ambient * flakes_light;
    for (uint index = 0u; index < light_count(); ++index) {
        LightSample light = light_at(index, position_in_world);
        vec3 light_in_tangent = light.direction_in_world * f.world_from_tangent;
        vec3 reflected = bare * standard_brdf_times_cosine(cloth, f.eye_in_tangent, light_in_tangent);
        vec3 smooth_lobe = glint_smooth_times_cosine(glint.flake_color, compensation, alpha, f.eye_in_tangent, light_in_tangent);
        if (metal > 0.0 && light_in_tangent.z > 0.0) {
            vec2 square = glint_square(ggx_half_vector(f.eye_in_tangent, light_in_tangent), alpha);
            vec3 light_right = light_in_tangent + light.direction_in_world * frame_right;
            vec3 light_below = light_in_tangent + light.direction_in_world * frame_below;
            vec2 right = glint_square(ggx_half_vector(eye_right, light_right), alpha) - square;
            vec2 below = glint_square(ggx_half_vector(eye_below, light_below), alpha) - square;
            float lobe = glint_lobe(flakes, dot(right, right) + dot(below, below));
            vec3 flash;
            if (discs.apart > 0.0) {
                flash = glint_discs_flash(flakes, discs, square, lobe);
            } else {
                GlintFlakes seen = flakes;
                GlintLevels levels = flat_levels;
                GlintTiles near = flat_near;
                GlintTiles far = flat_far;
                seen.fineness = glint_fineness(flakes, lobe);
                if (seen.fineness < flakes.fineness) {
                    // The cloth bends within the pixel: what it shows of normals is coarse, and tiles are others.
                    lobe *= exp2(float(seen.fineness) - float(flakes.fineness));
                    levels = glint_levels(footprint.reach, seen.fineness);
                    near = glint_tiles(footprint, seen.fineness, levels.first, chart);
                    if (levels.far > 0.0) { far = glint_tiles(footprint, seen.fineness, levels.first + 1u, chart); }
                }
                flash = glint_tiles_flash(seen, footprint, levels, near, far, square, lobe);
            }
            reflected += metal * smooth_lobe * flash;
        }
        sum += light.irradiance * reflected;
    }
    surface_write(f, sum, surface_opacity(color.a));
    surface_cover(mask);
}
