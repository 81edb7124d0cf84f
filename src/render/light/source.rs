//! Punctual lights as shaders read them.

use crate::scene::{Light, LightKind, ShadowMap};
use crate::shader::layout::LightSource;

/// The first map of a light, and how many it has.
pub fn first_shadows(maps: &[ShadowMap], light: usize) -> (u32, u32) {
    let first = maps.iter().position(|map| map.light == light).unwrap_or(0);
    (first as u32, maps.iter().filter(|map| map.light == light).count() as u32)
}

/// A light whose shadow maps are those from `first_shadow` on.
pub fn light_source(light: &Light, first_shadow: u32, shadow_count: u32) -> LightSource {
    let (kind, spot_scale, spot_offset) = match light.kind {
        LightKind::Directional => (0, 0.0, 0.0),
        LightKind::Point => (1, 0.0, 0.0),
        LightKind::Spot { angle_scale, angle_offset } => (2, angle_scale, angle_offset),
    };
    LightSource {
        position_in_world: light.position_in_world.to_array(),
        range_m: light.range_m.unwrap_or(0.0),
        direction_to_light: light.direction_to_light_in_world.to_array(),
        kind,
        intensity: light.intensity.to_array(),
        spot_scale,
        spot_offset,
        first_shadow,
        shadow_count,
        _reserved_0: 0.0,
    }
}
