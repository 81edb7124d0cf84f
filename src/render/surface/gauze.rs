//! Gauze as its shader reads it.

use super::map::{Map, transform};
use super::{FamilyShader, SurfaceFamily};
use crate::asset::TextureRef;
use crate::material::{Gauze, Weave};
use crate::shader::layout::{GauzeUniforms, TextureTransform};
use crate::shader::{Defines, ShaderFile};
use glam::Vec3;

/// Reflectance of threads at normal incidence: of plain plastic.
const DIELECTRIC_F0: f32 = 0.04;

impl SurfaceFamily for Gauze {
    type Uniforms = GauzeUniforms;
    const BLOCK: &'static str = "GauzeBlock";

    fn shader(&self) -> FamilyShader {
        let is_shiny = tint(self) != Vec3::ZERO;
        FamilyShader {
            file: ShaderFile::GauzeFrag,
            maps: vec![
                Map::data("mesh", "HAS_MESH_MAP", self.mesh_map),
                Map::data("specular_noise", "HAS_SPECULAR_NOISE_MAP", self.specular_noise).when(is_shiny),
                Map::data("thread_pattern", "HAS_THREAD_PATTERN_MAP", self.thread_pattern).when(is_shiny),
            ],
            constants: vec![
                ("CROSSED", u32::from(self.weave == Weave::Crossed)),
                ("HIGHLIGHT", u32::from(is_shiny)),
                ("CLASSIC", u32::from(self.classic)),
            ],
            defines: Defines::NONE,
            tables: Vec::new(),
            blends: !is_opaque(self) || self.mesh_map.is_some(),
            reads_rest: false,
            // It mostly shows what lies behind it.
            is_in_gbuffer: false,
            shadow: Some((
                ShaderFile::GauzeShadowFrag,
                Defines::UV | Defines::TANGENT | Defines::MAPS | Defines::COLOR,
            )),
        }
    }

    fn uniforms(&self) -> GauzeUniforms {
        let clearing = (1.0 + self.transmittance).log2();
        let threads = self.threads();
        let angle = self.thread_angle.to_radians();
        GauzeUniforms {
            specular: (DIELECTRIC_F0 * tint(self)).to_array(),
            anisotropy: self.anisotropy,
            thread_turn: [angle.cos(), angle.sin()],
            thread_threshold: self.thread_threshold,
            cover: if is_opaque(self) || self.classic { 1.0 } else { clearing.recip() },
            weave: if self.classic { self.weave_density * clearing } else { threads.density() as f32 },
            mean_opacity: threads.mean_opacity() as f32,
            mesh_transform: denser(self.mesh_map, self.sampling_density),
            specular_noise_transform: denser(self.specular_noise, self.sampling_density),
            thread_pattern_transform: denser(self.thread_pattern, self.sampling_density),
            _reserved_0: 0.0,
            _reserved_1: 0.0,
        }
    }
}

/// Colour and strength of the highlight.
fn tint(gauze: &Gauze) -> Vec3 {
    gauze.specular_strength * gauze.scatter_strength * gauze.scatter_color
}

/// Density 0 is opaque in every form, and stays so.
fn is_opaque(gauze: &Gauze) -> bool {
    gauze.weave_density == 0.0
}

/// The transform of a map, repeated `density` times more.
fn denser(map: Option<TextureRef>, density: f32) -> TextureTransform {
    let mut transform = transform(map);
    for row in [&mut transform.row_u, &mut transform.row_v] {
        row[0] *= density;
        row[1] *= density;
    }
    transform
}
