//! Cotton as its shader reads it.

use super::map::{Map, transform};
use super::{FamilyShader, SurfaceFamily, sheen};
use crate::material::Cotton;
use crate::shader::layout::CottonUniforms;
use crate::shader::{Defines, ShaderFile};
use glam::{Vec2, Vec3};

impl SurfaceFamily for Cotton {
    type Uniforms = CottonUniforms;
    const BLOCK: &'static str = "CottonBlock";

    fn shader(&self) -> FamilyShader {
        let has_fibre = self.sheen_color != Vec3::ZERO;
        FamilyShader {
            file: ShaderFile::CottonFrag,
            maps: vec![
                Map::color("sheen_color", "HAS_SHEEN_COLOR_MAP", self.sheen_color_texture).when(has_fibre),
                Map::data("sheen", "HAS_SHEEN_MAP", self.sheen_map).when(has_fibre),
                Map::data("sheen_roughness", "HAS_SHEEN_ROUGHNESS_MAP", self.sheen_roughness_map).when(has_fibre),
            ],
            constants: vec![
                ("SHEEN", self.sheen.sheet() as u32),
                ("CLASSIC", self.classic.into()),
                ("HAS_FIBRE", has_fibre.into()),
            ],
            defines: Defines::NONE,
            tables: vec![&sheen::TABLE],
            blends: false,
            reads_rest: false,
            is_in_gbuffer: true,
            shadow: None,
        }
    }

    fn uniforms(&self) -> CottonUniforms {
        let turn = Vec2::from_angle(self.env_rotation.to_radians());
        CottonUniforms {
            sheen_color: self.sheen_color.to_array(),
            sheen_roughness: self.sheen_roughness,
            environment_turn: turn.to_array(),
            _reserved_0: 0.0,
            _reserved_1: 0.0,
            sheen_color_transform: transform(self.sheen_color_texture),
            sheen_transform: transform(self.sheen_map),
            sheen_roughness_transform: transform(self.sheen_roughness_map),
        }
    }
}
