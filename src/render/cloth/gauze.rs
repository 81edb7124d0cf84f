//! Gauze as its shader reads it.

use super::ClothShader;
use crate::asset::TextureRef;
use crate::material::reference::gauze as weave;
use crate::material::reference::standard::DIELECTRIC_F0;
use crate::material::{Gauze, Weave};
use crate::render::map::Map;
use crate::render::material::transform;
use crate::shader::layout::{GauzeUniforms, TextureTransform};
use glam::Vec3;

pub fn shader(gauze: &Gauze) -> ClothShader {
    let is_shiny = tint(gauze) != Vec3::ZERO;
    ClothShader {
        file: "gauze.frag",
        block: "GauzeBlock",
        maps: vec![
            Map::data("mesh", "HAS_MESH_MAP", gauze.mesh_map),
            Map::data("specular_noise", "HAS_SPECULAR_NOISE_MAP", gauze.specular_noise).when(is_shiny),
            Map::data("thread_pattern", "HAS_THREAD_PATTERN_MAP", gauze.thread_pattern).when(is_shiny),
        ],
        constants: vec![
            ("CROSSED", u32::from(gauze.weave == Weave::Crossed)),
            ("HIGHLIGHT", u32::from(is_shiny)),
            ("CLASSIC", u32::from(gauze.classic)),
        ],
        defines: &[],
        tables: Vec::new(),
        blends: !is_opaque(gauze) || gauze.mesh_map.is_some(),
        reads_rest: false,
    }
}

pub fn uniforms(gauze: &Gauze) -> GauzeUniforms {
    let density = f64::from(gauze.weave_density);
    let clearing = (1.0 + gauze.transmittance).log2();
    let threads = match gauze.weave {
        Weave::Matted => weave::Weave::matted(density),
        Weave::Crossed => weave::Weave::crossed(density),
    };
    let of_weave = match threads {
        weave::Weave::Matted(depth) => depth as f32,
        weave::Weave::Crossed(cover) => cover as f32,
    };
    let angle = gauze.thread_angle.to_radians();
    GauzeUniforms {
        specular: (DIELECTRIC_F0 as f32 * tint(gauze)).to_array(),
        anisotropy: gauze.anisotropy,
        thread_turn: [angle.cos(), angle.sin()],
        thread_threshold: gauze.thread_threshold,
        cover: if is_opaque(gauze) || gauze.classic { 1.0 } else { clearing.recip() },
        weave: if gauze.classic { gauze.weave_density * clearing } else { of_weave },
        mean_opacity: threads.mean_opacity() as f32,
        mesh_transform: denser(gauze.mesh_map, gauze.sampling_density),
        specular_noise_transform: denser(gauze.specular_noise, gauze.sampling_density),
        thread_pattern_transform: denser(gauze.thread_pattern, gauze.sampling_density),
        ..Default::default()
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
