//! Lights of the host's.

use crate::result::Failure;
use glam::Vec3;
use vair::scene::{Light, LightKind};

/// Infinitely far away.
pub const VAIR_LIGHT_DIRECTIONAL: u32 = 0;
/// Shines in all directions.
pub const VAIR_LIGHT_POINT: u32 = 1;
/// A cone.
pub const VAIR_LIGHT_SPOT: u32 = 2;

/// A light in world space.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct VairLight {
    /// VAIR_LIGHT_DIRECTIONAL, VAIR_LIGHT_POINT or VAIR_LIGHT_SPOT.
    pub kind: u32,
    /// Metres; not of directional lights.
    pub position: [f32; 3],
    /// From the scene to the light, of any length; the opposite of a spot's axis. Not of points.
    pub direction_to_light: [f32; 3],
    /// Linear RGB: lux of directional lights, candela of others. Pi lux on a white matt surface show as 1.
    pub intensity: [f32; 3],
    /// Metres beyond which nothing arrives; 0 is no end.
    pub range_m: f32,
    /// Of spots, radians from the axis: full intensity inside.
    pub inner_angle: f32,
    /// Of spots, radians from the axis: nothing outside; greater than `inner_angle`.
    pub outer_angle: f32,
}

impl VairLight {
    pub(crate) fn light(&self, index: usize) -> Result<Light, Failure> {
        let wrong = |problem: &str| Failure::argument(format!("lights[{index}]: {problem}"));
        let kind = match self.kind {
            VAIR_LIGHT_DIRECTIONAL => LightKind::Directional,
            VAIR_LIGHT_POINT => LightKind::Point,
            VAIR_LIGHT_SPOT => {
                let (inner, outer) = (self.inner_angle, self.outer_angle);
                if !(0.0 <= inner && inner < outer && outer <= std::f32::consts::PI) {
                    return Err(wrong("the angles of a spot are 0 <= inner < outer <= pi"));
                }
                let angle_scale = 1.0 / (inner.cos() - outer.cos()).max(1e-3);
                LightKind::Spot { angle_scale, angle_offset: -outer.cos() * angle_scale }
            }
            other => return Err(wrong(&format!("there is no kind {other} of light"))),
        };
        let direction = Vec3::from_array(self.direction_to_light).try_normalize();
        let direction_to_light_in_world = match (kind, direction) {
            (_, Some(direction)) => direction,
            (LightKind::Point, None) => Vec3::Y,
            (_, None) => return Err(wrong("direction_to_light has no direction")),
        };
        if self.range_m.is_nan() || self.range_m < 0.0 {
            return Err(wrong("range_m is metres, or 0 for no end"));
        }
        Ok(Light {
            kind,
            position_in_world: Vec3::from_array(self.position),
            direction_to_light_in_world,
            intensity: Vec3::from_array(self.intensity),
            range_m: (self.range_m > 0.0 && self.range_m.is_finite()).then_some(self.range_m),
        })
    }
}
