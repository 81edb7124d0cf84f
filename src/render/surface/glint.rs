//! Glint as its shader reads it.

use super::map::{Map, transform};
use super::{FamilyShader, SurfaceFamily};
use crate::material::Glint;
use crate::shader::layout::GlintUniforms;
use crate::shader::{Defines, ShaderFile};

impl SurfaceFamily for Glint {
    type Uniforms = GlintUniforms;
    const BLOCK: &'static str = "GlintBlock";

    fn shader(&self) -> FamilyShader {
        FamilyShader {
            file: ShaderFile::GlintFrag,
            maps: vec![Map::data("mask", "HAS_MASK_MAP", self.mask_map)],
            constants: Vec::new(),
            defines: Defines::NONE,
            tables: Vec::new(),
            blends: false,
            reads_rest: true,
            is_in_gbuffer: true,
            shadow: None,
        }
    }

    fn uniforms(&self) -> GlintUniforms {
        let flakes = self.flakes();
        GlintUniforms {
            flake_color: self.flake_color.to_array(),
            coverage: self.coverage,
            intensity: self.intensity,
            flake_roughness: self.flake_roughness,
            cells_per_metre: flakes.cells_per_metre,
            radius: flakes.radius,
            jitter: flakes.jitter,
            lobe: flakes.lobe,
            variation: flakes.variation,
            fineness: flakes.fineness,
            mask_transform: transform(self.mask_map),
        }
    }
}
