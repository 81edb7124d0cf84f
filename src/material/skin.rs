//! The surface under fur.

use super::{AlphaMode, Fur, Standard};
use crate::asset::TextureRef;
use glam::Vec3;

impl Fur {
    /// Colour factor and texture of the strands: their own, or the surface's where they have none. Fur with a colour of
    /// its own does not take the surface's texture.
    pub fn color_over(&self, surface: &Standard) -> (Vec3, Option<TextureRef>) {
        match self.base_color {
            Some(color) => (color, self.base_color_texture),
            None => (surface.base_color.truncate(), self.base_color_texture.or(surface.base_color_texture)),
        }
    }

    /// The skin: the fur's base colour goes on in it, so that gaps between strands show no foreign colour (spots are
    /// the strands' alone). It is closed and rough, and as dark as the fur above leaves it.
    pub fn skin(&self, surface: &Standard) -> Standard {
        let (color, texture) = self.color_over(surface);
        Standard {
            base_color: (color * self.root_color * (1.0 - self.occlusion)).extend(1.0),
            base_color_texture: texture,
            alpha_mode: AlphaMode::Opaque,
            roughness: 1.0,
            double_sided: surface.double_sided,
            ..Standard::default()
        }
    }
}
