//! Gauze as its shader reads it.

use super::ClothShader;
use crate::asset::TextureRef;
use crate::material::reference::gauze as weave;
use crate::material::reference::standard::DIELECTRIC_F0;
use crate::material::{Gauze, Standard, Weave};
use crate::render::map::Map;
use crate::render::material::transform;
use crate::shader::layout::{GauzeUniforms, TextureTransform};
use glam::Vec3;

pub fn shader(gauze: &Gauze, _: &Standard) -> ClothShader {
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
    // Density 0 is opaque in every form, and stays so.
    let opaque = gauze.weave_density == 0.0;
    let tint = gauze.specular_strength * gauze.scatter_strength * gauze.scatter_color;
    let is_shiny = tint != Vec3::ZERO;
    let angle = gauze.thread_angle.to_radians();
    let uniforms = GauzeUniforms {
        specular: (DIELECTRIC_F0 as f32 * tint).to_array(),
        anisotropy: gauze.anisotropy,
        thread_turn: [angle.cos(), angle.sin()],
        thread_threshold: gauze.thread_threshold,
        cover: if opaque || gauze.classic { 1.0 } else { clearing.recip() },
        weave: if gauze.classic { gauze.weave_density * clearing } else { of_weave },
        mean_opacity: threads.mean_opacity() as f32,
        mesh_transform: denser(gauze.mesh_map, gauze.sampling_density),
        specular_noise_transform: denser(gauze.specular_noise, gauze.sampling_density),
        thread_pattern_transform: denser(gauze.thread_pattern, gauze.sampling_density),
        ..Default::default()
    };
    ClothShader {
        file: "gauze.frag",
        block: "GauzeBlock",
        uniforms: bytemuck::bytes_of(&uniforms).to_vec(),
        maps: vec![
            Map::data("mesh", "HAS_MESH_MAP", gauze.mesh_map),
            Map::data("specular_noise", "HAS_SPECULAR_NOISE_MAP", gauze.specular_noise.filter(|_| is_shiny)),
            Map::data("thread_pattern", "HAS_THREAD_PATTERN_MAP", gauze.thread_pattern.filter(|_| is_shiny)),
        ],
        constants: vec![
            ("CROSSED", u32::from(gauze.weave == Weave::Crossed)),
            ("HIGHLIGHT", u32::from(is_shiny)),
            ("CLASSIC", u32::from(gauze.classic)),
        ],
        defines: &[],
        tables: Vec::new(),
        blends: !opaque || gauze.mesh_map.is_some(),
        reads_rest: false,
    }
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
