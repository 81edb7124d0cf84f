//! The surface under a coat.

use super::{AlphaMode, Fur, Standard};
use crate::asset::TextureRef;

impl Fur {
    /// The skin: the coat's roots go on in it, so that gaps between strands show no foreign colour. It is closed and
    /// rough, and as dark as the coat above leaves it.
    pub fn skin(&self, surface: &Standard) -> Standard {
        let color = self.base_color.unwrap_or(surface.base_color.truncate());
        let texture: Option<TextureRef> = self.base_color_texture.or(surface.base_color_texture);
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
