//! Cotton as its shader reads it.

use super::{ClothShader, sheen};
use crate::material::Cotton;
use crate::render::map::Map;
use crate::render::material::transform;
use crate::shader::layout::CottonUniforms;
use glam::{Vec2, Vec3};

pub fn shader(cotton: &Cotton) -> ClothShader {
    let has_fibre = cotton.sheen_color != Vec3::ZERO;
    ClothShader {
        file: "cotton.frag",
        block: "CottonBlock",
        maps: vec![
            Map::color("sheen_color", "HAS_SHEEN_COLOR_MAP", cotton.sheen_color_texture).when(has_fibre),
            Map::data("sheen", "HAS_SHEEN_MAP", cotton.sheen_map).when(has_fibre),
            Map::data("sheen_roughness", "HAS_SHEEN_ROUGHNESS_MAP", cotton.sheen_roughness_map).when(has_fibre),
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

pub fn uniforms(cotton: &Cotton) -> CottonUniforms {
    let turn = Vec2::from_angle(cotton.env_rotation.to_radians());
    CottonUniforms {
        sheen_color: cotton.sheen_color.to_array(),
        sheen_roughness: cotton.sheen_roughness,
        environment_turn: turn.to_array(),
        _reserved_0: 0.0,
        _reserved_1: 0.0,
        sheen_color_transform: transform(cotton.sheen_color_texture),
        sheen_transform: transform(cotton.sheen_map),
        sheen_roughness_transform: transform(cotton.sheen_roughness_map),
    }
}
