//! Satin as its shader reads it.

use super::ClothShader;
use crate::material::Satin;
use crate::render::map::Map;
use crate::render::material::transform;
use crate::shader::layout::SatinUniforms;
use glam::Vec3;

pub fn shader(satin: &Satin) -> ClothShader {
    let shines = |color: Vec3| u32::from(satin.specular_strength > 0.0 && color != Vec3::ZERO);
    let is_shiny = shines(satin.specular_color) + shines(satin.secondary_color) > 0;
    ClothShader {
        file: "satin.frag",
        block: "SatinBlock",
        maps: vec![Map::data("specular_noise", "HAS_SPECULAR_NOISE_MAP", satin.specular_noise).when(is_shiny)],
        constants: vec![
            ("NARROW", shines(satin.specular_color)),
            ("SECONDARY", shines(satin.secondary_color)),
            ("TWO_WAY", u32::from(satin.two_way)),
            ("CLASSIC", u32::from(satin.classic)),
        ],
        defines: &[],
        tables: Vec::new(),
        blends: false,
        reads_rest: false,
    }
}

pub fn uniforms(satin: &Satin) -> SatinUniforms {
    SatinUniforms {
        specular_color: satin.specular_color.to_array(),
        specular_strength: satin.specular_strength,
        secondary_color: satin.secondary_color.to_array(),
        secondary_width: satin.secondary_width,
        anisotropy: satin.anisotropy,
        light_tint: satin.light_tint,
        specular_noise_transform: transform(satin.specular_noise),
        ..Default::default()
    }
}
