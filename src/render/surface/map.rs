//! Maps of materials, and the fallback textures where a shader has a map and the material has not.

use super::FamilyShader;
use crate::asset::TextureRef;
use crate::material::Standard;
use crate::shader::layout::TextureTransform;

/// A map of a material: its shaders call the texture `<name>_map` and the sampler `<name>_sampler`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Map {
    /// Stem of the GLSL names.
    pub name: &'static str,
    /// The shaders' constant that says whether it is sampled.
    pub constant: &'static str,
    /// What the material says.
    pub texture: Option<TextureRef>,
    /// Colour, which is decoded when sampled; everything else is data and never is.
    pub srgb: bool,
    /// What leaves the material as it is without the map.
    pub fallback: Fallback,
}

/// A fallback (dummy) texture: one texel that changes nothing where it is sampled. Floats, so that it is exact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Fallback {
    /// One, for factors.
    White,
    /// Zero, for shares of something else.
    Black,
    /// A vector along the normal, for normal maps.
    FlatNormal,
    /// No vector, for maps of directions in a plane.
    NoDirection,
    /// One over the detail map's factor of 4.6716 (`standard.frag`).
    DetailGrey,
}

impl Fallback {
    /// The texel.
    pub fn texel(self) -> [f32; 4] {
        match self {
            Self::White => [1.0; 4],
            Self::Black => [0.0; 4],
            Self::FlatNormal => [0.5, 0.5, 1.0, 1.0],
            Self::NoDirection => [0.5; 4],
            Self::DetailGrey => [1.0 / 4.6716; 4],
        }
    }
}

impl Map {
    /// Name of its texture in the shaders.
    pub fn texture_name(&self) -> String {
        format!("{}_map", self.name)
    }

    /// Name of its sampler in the shaders.
    pub fn sampler_name(&self) -> String {
        format!("{}_sampler", self.name)
    }

    /// The same, or without its texture where nothing of the material asks for it: then it is neither bound nor fetched.
    pub fn when(self, is_used: bool) -> Self {
        Self { texture: self.texture.filter(|_| is_used), ..self }
    }

    /// A map of colours.
    pub fn color(name: &'static str, constant: &'static str, texture: Option<TextureRef>) -> Self {
        Self { srgb: true, ..Self::data(name, constant, texture) }
    }

    /// A map of numbers.
    pub fn data(name: &'static str, constant: &'static str, texture: Option<TextureRef>) -> Self {
        Self { name, constant, texture, srgb: false, fallback: Fallback::White }
    }

    /// The same with another texel where a material has none.
    pub fn or(self, fallback: Fallback) -> Self {
        Self { fallback, ..self }
    }
}

/// Maps of a surface: those that every surface may have, and those of its family.
pub fn surface_maps(standard: &Standard, family: Option<&FamilyShader>) -> Vec<Map> {
    let mut maps = super::standard::maps(standard).to_vec();
    maps.extend(family.into_iter().flat_map(|family| &family.maps));
    maps
}

/// KHR_texture_transform as two rows: translation * rotation * scale.
pub fn transform(map: Option<TextureRef>) -> TextureTransform {
    let Some(map) = map else {
        return TextureTransform { row_u: [1.0, 0.0, 0.0], uv_set: 0, row_v: [0.0, 1.0, 0.0], _reserved: 0.0 };
    };
    let (sine, cosine) = map.rotation.sin_cos();
    TextureTransform {
        row_u: [cosine * map.scale.x, sine * map.scale.y, map.offset.x],
        uv_set: map.uv_set,
        row_v: [-sine * map.scale.x, cosine * map.scale.y, map.offset.y],
        _reserved: 0.0,
    }
}
