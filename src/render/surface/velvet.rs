//! Velvet as its shader reads it.

use super::{FamilyShader, SurfaceFamily, sheen};
use crate::material::Velvet;
use crate::shader::layout::VelvetUniforms;
use crate::shader::{Defines, ShaderFile};
use glam::Vec3;

impl SurfaceFamily for Velvet {
    type Uniforms = VelvetUniforms;
    const BLOCK: &'static str = "VelvetBlock";

    fn shader(&self) -> FamilyShader {
        FamilyShader {
            file: ShaderFile::VelvetFrag,
            maps: Vec::new(),
            constants: vec![
                ("SHEEN", self.sheen.sheet() as u32),
                ("CLASSIC", self.classic.into()),
                ("HAS_FIBRE", (self.scatter_color != Vec3::ZERO).into()),
            ],
            defines: Defines::NONE,
            tables: vec![&sheen::TABLE],
            blends: false,
            reads_rest: false,
            is_in_gbuffer: true,
            shadow: None,
        }
    }

    fn uniforms(&self) -> VelvetUniforms {
        VelvetUniforms {
            scatter_color: self.scatter_color.to_array(),
            scatter_roughness: self.scatter_roughness(),
            scatter_scale: self.scatter_scale,
            _reserved_0: 0.0,
            _reserved_1: 0.0,
            _reserved_2: 0.0,
        }
    }
}
