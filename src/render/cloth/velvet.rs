//! Velvet as its shader reads it.

use super::{ClothShader, sheen};
use crate::material::{Standard, Velvet};
use crate::shader::layout::VelvetUniforms;
use glam::Vec3;

pub fn shader(velvet: &Velvet, _: &Standard) -> ClothShader {
    let uniforms = VelvetUniforms {
        scatter_color: velvet.scatter_color.to_array(),
        scatter_roughness: velvet.scatter_roughness(),
        scatter_scale: velvet.scatter_scale,
        ..Default::default()
    };
    ClothShader {
        file: "velvet.frag",
        block: "VelvetBlock",
        uniforms: bytemuck::bytes_of(&uniforms).to_vec(),
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
