//! Materials as the shaders read them.

use crate::asset::TextureRef;
use crate::material::{Fur, Length, Standard};
use crate::scene::Size;
use crate::shader::layout::{FurUniforms, StandardUniforms, TextureTransform};
use glam::Vec3;

/// The uniform block of a surface.
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
        base_color_transform: transform(standard.base_color_texture),
        metallic_roughness_transform: transform(standard.metallic_roughness_texture),
        normal_transform: transform(standard.normal_texture),
        occlusion_transform: transform(standard.occlusion_texture),
        emissive_transform: transform(standard.emissive_texture),
        detail_albedo_transform: transform(standard.detail_albedo_texture),
        detail_normal_transform: transform(standard.detail_normal_texture),
        ..Default::default()
    }
}

/// KHR_texture_transform as two rows: translation * rotation * scale.
pub fn transform(map: Option<TextureRef>) -> TextureTransform {
    let Some(map) = map else {
        return TextureTransform { row_u: [1.0, 0.0, 0.0], row_v: [0.0, 1.0, 0.0], ..Default::default() };
    };
    let (sine, cosine) = map.rotation.sin_cos();
    TextureTransform {
        row_u: [cosine * map.scale.x, sine * map.scale.y, map.offset.x],
        uv_set: map.uv_set,
        row_v: [-sine * map.scale.x, cosine * map.scale.y, map.offset.y],
        ..Default::default()
    }
}

/// The uniform block of a coat of `layers` shells on a mesh of that size; `force_in_world` is a unit direction times a
/// strength in [0, 1].
pub fn fur_uniforms(fur: &Fur, standard: &Standard, size: Size, layers: u32, force_in_world: Vec3) -> FurUniforms {
    let (color, texture) = fur.color_over(standard);
    let world = |length: Length| length.metres(size.world_radius_m());
    FurUniforms {
        base_color: color.to_array(),
        root_color: fur.root_color.to_array(),
        tip_color: fur.tip_color.to_array(),
        spot_color: fur.spot_color.to_array(),
        length_m: world(fur.length),
        // A spacing of nothing would make infinitely many strands.
        strand_spacing: (world(fur.strand_spacing) / size.world_from_rest).max(size.rest_radius * 1e-5),
        strand_radius: 0.5 * fur.thickness.max(1e-6),
        force: force_in_world.to_array(),
        color_variation: fur.color_variation,
        comb: fur.comb.to_array(),
        cutoff_start: fur.cutoff_start,
        cutoff_end: fur.cutoff_end,
        edge_fade: fur.edge_fade,
        tip_fade: fur.tip_fade,
        taper: fur.taper,
        occlusion: fur.occlusion,
        specular: fur.specular,
        transmission: fur.transmission,
        roughness: fur.roughness,
        height_strength: fur.height_strength,
        clump: fur.clump,
        curl: fur.curl,
        projection_scale: 1.0 / size.rest_radius,
        layers,
        distribution_transform: transform(fur.distribution_map),
        base_color_transform: transform(texture),
        comb_transform: transform(fur.comb_map),
        height_transform: transform(fur.height_map),
        spot_transform: transform(fur.spot_map),
        ..Default::default()
    }
}
