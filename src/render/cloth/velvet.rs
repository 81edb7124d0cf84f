//! Velvet as its shader reads it.

use super::{ClothShader, sheen};
use crate::material::Velvet;
use crate::shader::layout::VelvetUniforms;
use glam::Vec3;

pub fn shader(velvet: &Velvet) -> ClothShader {
    ClothShader {
        file: "velvet.frag",
        block: "VelvetBlock",
        maps: Vec::new(),
        constants: vec![
            ("SHEEN", velvet.sheen.sheet() as u32),
            ("CLASSIC", velvet.classic.into()),
            ("HAS_FIBRE", (velvet.scatter_color != Vec3::ZERO).into()),
        ],
        defines: &[],
        tables: vec![&sheen::TABLE],
        blends: false,
        reads_rest: false,
    }
}

pub fn uniforms(velvet: &Velvet) -> VelvetUniforms {
    VelvetUniforms {
        scatter_color: velvet.scatter_color.to_array(),
        scatter_roughness: velvet.scatter_roughness(),
        scatter_scale: velvet.scatter_scale,
        ..Default::default()
    }
}
