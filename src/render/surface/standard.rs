//! The standard surface as its shaders read it.

use super::map::{Fallback, Map, transform};
use crate::material::Standard;
use crate::shader::layout::StandardUniforms;

/// Its maps.
pub fn maps(standard: &Standard) -> [Map; 7] {
    [
        Map::color("base_color", "HAS_BASE_COLOR_MAP", standard.base_color_texture),
        Map::data("metallic_roughness", "HAS_METALLIC_ROUGHNESS_MAP", standard.metallic_roughness_texture),
        Map::data("occlusion", "HAS_OCCLUSION_MAP", standard.occlusion_texture),
        Map::color("emissive", "HAS_EMISSIVE_MAP", standard.emissive_texture),
        Map::data("normal", "HAS_NORMAL_MAP", standard.normal_texture).or(Fallback::FlatNormal),
        Map::color("detail_albedo", "HAS_DETAIL_ALBEDO_MAP", standard.detail_albedo_texture).or(Fallback::DetailGrey),
        Map::data("detail_normal", "HAS_DETAIL_NORMAL_MAP", standard.detail_normal_texture).or(Fallback::FlatNormal),
    ]
}

/// Its uniform block.
pub fn standard_uniforms(standard: &Standard) -> StandardUniforms {
    StandardUniforms {
        base_color: standard.base_color.to_array(),
        emissive: standard.emissive.to_array(),
        alpha_cutoff: standard.alpha_cutoff,
        metallic: standard.metallic,
        roughness: standard.roughness,
        normal_scale: standard.normal_scale,
        occlusion_strength: standard.occlusion_strength,
        detail_normal_scale: standard.detail_normal_scale,
        _reserved_0: 0.0,
        _reserved_1: 0.0,
        _reserved_2: 0.0,
        base_color_transform: transform(standard.base_color_texture),
        metallic_roughness_transform: transform(standard.metallic_roughness_texture),
        normal_transform: transform(standard.normal_texture),
        occlusion_transform: transform(standard.occlusion_texture),
        emissive_transform: transform(standard.emissive_texture),
        detail_albedo_transform: transform(standard.detail_albedo_texture),
        detail_normal_transform: transform(standard.detail_normal_texture),
    }
}
