//! Maps of materials, and what stands in where a shader has a map and the material has not.

use super::cloth::ClothShader;
use crate::asset::TextureRef;
use crate::material::{Fur, Standard};

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
    pub stand_in: StandIn,
}

/// A texel that changes nothing where it is sampled. Floats, so that it is exact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum StandIn {
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

impl StandIn {
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
        Self { name, constant, texture, srgb: false, stand_in: StandIn::White }
    }

    /// The same with another texel where a material has none.
    pub fn or(self, stand_in: StandIn) -> Self {
        Self { stand_in, ..self }
    }
}

/// Maps of a surface: those that every surface may have, and those of its family of cloth.
pub fn surface_maps(standard: &Standard, cloth: Option<&ClothShader>) -> Vec<Map> {
    let mut maps = standard_maps(standard).to_vec();
    maps.extend(cloth.into_iter().flat_map(|cloth| &cloth.maps));
    maps
}

/// Maps of the standard surface.
pub fn standard_maps(standard: &Standard) -> [Map; 7] {
    [
        Map::color("base_color", "HAS_BASE_COLOR_MAP", standard.base_color_texture),
        Map::data("metallic_roughness", "HAS_METALLIC_ROUGHNESS_MAP", standard.metallic_roughness_texture),
        Map::data("occlusion", "HAS_OCCLUSION_MAP", standard.occlusion_texture),
        Map::color("emissive", "HAS_EMISSIVE_MAP", standard.emissive_texture),
        Map::data("normal", "HAS_NORMAL_MAP", standard.normal_texture).or(StandIn::FlatNormal),
        Map::color("detail_albedo", "HAS_DETAIL_ALBEDO_MAP", standard.detail_albedo_texture).or(StandIn::DetailGrey),
        Map::data("detail_normal", "HAS_DETAIL_NORMAL_MAP", standard.detail_normal_texture).or(StandIn::FlatNormal),
    ]
}

/// Maps of a coat over a surface, whose base colour texture it takes where it has none of its own.
pub fn fur_maps(fur: &Fur, standard: &Standard) -> [Map; 5] {
    [
        Map::data("height", "HAS_HEIGHT_MAP", fur.height_map),
        Map::data("distribution", "HAS_DISTRIBUTION_MAP", fur.distribution_map),
        Map::color("base_color", "HAS_BASE_COLOR_MAP", fur.color_over(standard).1),
        Map::data("spot", "HAS_SPOT_MAP", fur.spot_map).or(StandIn::Black),
        Map::data("comb", "HAS_COMB_MAP", fur.comb_map).or(StandIn::NoDirection),
    ]
}
