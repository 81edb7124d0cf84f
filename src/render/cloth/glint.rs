//! Glint as its shader reads it.

use super::ClothShader;
use crate::material::Glint;
use crate::render::map::Map;
use crate::render::material::transform;
use crate::shader::layout::GlintUniforms;

pub fn shader(glint: &Glint) -> ClothShader {
    ClothShader {
        file: "glint.frag",
        block: "GlintBlock",
        maps: vec![Map::data("mask", "HAS_MASK_MAP", glint.mask_map)],
        constants: Vec::new(),
        defines: &[],
        tables: Vec::new(),
        blends: false,
        reads_rest: true,
    }
}

pub fn uniforms(glint: &Glint) -> GlintUniforms {
    let flakes = glint.flakes();
    GlintUniforms {
        flake_color: glint.flake_color.to_array(),
        coverage: glint.coverage,
        intensity: glint.intensity,
        flake_roughness: glint.flake_roughness,
        cells_per_metre: flakes.cells_per_metre,
        radius: flakes.radius,
        jitter: flakes.jitter,
        lobe: flakes.lobe,
        variation: flakes.variation,
        fineness: flakes.fineness,
        mask_transform: transform(glint.mask_map),
    }
}
