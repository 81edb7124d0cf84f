//! Satin as its shader reads it.

use super::ClothShader;
use crate::material::{Satin, Standard};
use crate::render::map::Map;
use crate::render::material::transform;
use crate::shader::layout::SatinUniforms;

pub fn shader(satin: &Satin, _: &Standard) -> ClothShader {
    let uniforms = SatinUniforms {
        anisotropy: satin.anisotropy,
        specular_noise_transform: transform(satin.specular_noise),
        ..Default::default()
    };
    ClothShader {
        file: "satin.frag",
        block: "SatinBlock",
        uniforms: bytemuck::bytes_of(&uniforms).to_vec(),
        maps: vec![Map::data("specular_noise", "HAS_SPECULAR_NOISE_MAP", satin.specular_noise)],
        constants: Vec::new(),
        tables: Vec::new(),
        blends: false,
    }
}
