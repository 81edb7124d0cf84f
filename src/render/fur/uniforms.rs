//! Fur as its shaders read it.

use crate::material::{Fur, Length, Standard};
use crate::render::surface::transform;
use crate::scene::Size;
use crate::shader::layout::FurUniforms;
use glam::Vec3;

/// The uniform block of the fur of `layers` shells on a mesh of that size; `force_in_world` is a unit direction times a
/// strength in [0, 1].
pub fn fur_uniforms(fur: &Fur, standard: &Standard, size: Size, layers: u32, force_in_world: Vec3) -> FurUniforms {
    let (color, texture) = fur.color_over(standard);
    let world = |length: Length| length.metres(size.world_radius_m());
    FurUniforms {
        base_color: color.to_array(),
        _reserved_3: 0.0,
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
        _reserved_1: 0.0,
        _reserved_2: 0.0,
        _padding_0: [0; 2],
        distribution_transform: transform(fur.distribution_map),
        base_color_transform: transform(texture),
        comb_transform: transform(fur.comb_map),
        height_transform: transform(fur.height_map),
        spot_transform: transform(fur.spot_map),
    }
}
