//! Textures at their finest level, bilinear.

use crate::asset::{Asset, TextureRef, Wrap};
use crate::measure::twin::{color, uv};
use glam::{DVec2, DVec4};

/// A texture as a material reads it.
pub struct Map {
    size: [i64; 2],
    wrap: [Wrap; 2],
    is_linear: bool,
    /// Linear colour, or data as it is.
    texels: Vec<DVec4>,
    reference: TextureRef,
}

impl Map {
    pub fn new(asset: &Asset, reference: TextureRef, is_color: bool) -> Self {
        let texture = &asset.textures[reference.texture];
        let image = &asset.images[texture.image];
        let texel = |rgba: &[u8]| {
            let value = |channel: usize| {
                let stored = f64::from(rgba[channel]) / 255.0;
                if is_color && channel < 3 { color::linear_from_srgb(stored) } else { stored }
            };
            DVec4::new(value(0), value(1), value(2), value(3))
        };
        Self {
            size: [image.width, image.height].map(i64::from),
            wrap: texture.sampler.wrap,
            is_linear: texture.sampler.mag_linear,
            texels: image.rgba.chunks_exact(4).map(texel).collect(),
            reference,
        }
    }

    /// The UV set that it reads.
    pub fn uv_set(&self) -> usize {
        self.reference.uv_set as usize
    }

    /// The value at coordinates before their transform; white for an image without texels.
    pub fn sample(&self, coordinates: DVec2) -> DVec4 {
        if self.texels.is_empty() {
            return DVec4::ONE;
        }
        let TextureRef { offset, rotation, scale, .. } = self.reference;
        let transformed = uv::transformed(coordinates, offset.as_dvec2(), f64::from(rotation), scale.as_dvec2());
        let place = transformed * DVec2::new(self.size[0] as f64, self.size[1] as f64);
        if !self.is_linear {
            return self.texel(place.floor());
        }
        let corner = (place - 0.5).floor();
        let share = place - 0.5 - corner;
        let row = |y: f64| {
            let left = self.texel(corner + DVec2::new(0.0, y));
            left.lerp(self.texel(corner + DVec2::new(1.0, y)), share.x)
        };
        row(0.0).lerp(row(1.0), share.y)
    }

    fn texel(&self, place: DVec2) -> DVec4 {
        let along = |axis: usize| {
            let (at, size) = (place[axis] as i64, self.size[axis]);
            match self.wrap[axis] {
                Wrap::Repeat => at.rem_euclid(size),
                Wrap::Clamp => at.clamp(0, size - 1),
                Wrap::Mirror => {
                    let twice = at.rem_euclid(2 * size);
                    twice.min(2 * size - 1 - twice)
                }
            }
        };
        self.texels[(along(1) * self.size[0] + along(0)) as usize]
    }
}
