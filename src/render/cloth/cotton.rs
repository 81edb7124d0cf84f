//! Cotton as its shader reads it.

use super::{ClothShader, sheen};
use crate::material::{Cotton, Standard};
use crate::render::map::Map;
use crate::render::material::transform;
use crate::shader::layout::CottonUniforms;
use glam::Vec3;

pub fn shader(cotton: &Cotton, _: &Standard) -> ClothShader {
    let uniforms = CottonUniforms {
        sheen_color: cotton.sheen_color.to_array(),
        sheen_roughness: cotton.sheen_roughness,
        sheen_color_transform: transform(cotton.sheen_color_texture),
        sheen_transform: transform(cotton.sheen_map),
        sheen_roughness_transform: transform(cotton.sheen_roughness_map),
    };
    let has_fibre = cotton.sheen_color != Vec3::ZERO;
    // Fibres that do not stand need no maps.
    let of_fibre = |texture| if has_fibre { texture } else { None };
    ClothShader {
        file: "cotton.frag",
        block: "CottonBlock",
        uniforms: bytemuck::bytes_of(&uniforms).to_vec(),
        maps: vec![
            Map::color("sheen_color", "HAS_SHEEN_COLOR_MAP", of_fibre(cotton.sheen_color_texture)),
            Map::data("sheen", "HAS_SHEEN_MAP", of_fibre(cotton.sheen_map)),
            Map::data("sheen_roughness", "HAS_SHEEN_ROUGHNESS_MAP", of_fibre(cotton.sheen_roughness_map)),
        ],
        constants: vec![
            ("SHEEN", cotton.sheen.sheet() as u32),
            ("CLASSIC", cotton.classic.into()),
            ("HAS_FIBRE", has_fibre.into()),
        ],
        defines: &[],
        tables: vec![&sheen::TABLE],
        blends: false,
        reads_rest: false,
    }
}
