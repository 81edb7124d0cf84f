//! Satin as its shader reads it.

use super::map::{Map, transform};
use super::{FamilyShader, SurfaceFamily};
use crate::material::Satin;
use crate::shader::layout::SatinUniforms;
use crate::shader::{Defines, ShaderFile};
use glam::Vec3;

impl SurfaceFamily for Satin {
    type Uniforms = SatinUniforms;
    const BLOCK: &'static str = "SatinBlock";

    fn shader(&self) -> FamilyShader {
        let shines = |color: Vec3| u32::from(self.specular_strength > 0.0 && color != Vec3::ZERO);
        let is_shiny = shines(self.specular_color) + shines(self.secondary_color) > 0;
        FamilyShader {
            file: ShaderFile::SatinFrag,
            maps: vec![Map::data("specular_noise", "HAS_SPECULAR_NOISE_MAP", self.specular_noise).when(is_shiny)],
            constants: vec![
                ("NARROW", shines(self.specular_color)),
                ("SECONDARY", shines(self.secondary_color)),
                ("TWO_WAY", u32::from(self.two_way)),
                ("CLASSIC", u32::from(self.classic)),
            ],
            defines: Defines::NONE,
            tables: Vec::new(),
            blends: false,
            reads_rest: false,
            is_in_gbuffer: true,
            shadow: None,
        }
    }

    fn uniforms(&self) -> SatinUniforms {
        SatinUniforms {
            specular_color: self.specular_color.to_array(),
            specular_strength: self.specular_strength,
            secondary_color: self.secondary_color.to_array(),
            secondary_width: self.secondary_width,
            anisotropy: self.anisotropy,
            light_tint: self.light_tint,
            specular_noise_transform: transform(self.specular_noise),
            _reserved_0: 0.0,
            _reserved_1: 0.0,
        }
    }
}
