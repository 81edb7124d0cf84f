//! Lights of a scene in world space.
//!
//! KHR_lights_punctual: directional in lux, point and spot in candela, all times a linear colour. Reflected radiance of
//! a white Lambert surface is irradiance / pi, so pi lux show as 1.

use std::f32::consts::PI;

use glam::Vec3;

use super::{EnvironmentLight, Pose, nodes_of_scene};
use crate::asset::{self, Asset};

/// All light of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Lighting {
    /// Punctual lights.
    pub lights: Vec<Light>,
    /// Light from all around.
    pub environment: EnvironmentLight,
}

/// Kind of a light.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightKind {
    /// Infinitely far away.
    Directional,
    /// All directions.
    Point,
    /// A cone: its intensity is scaled by `saturate(cos * scale + offset)^2`, cos measured from the axis.
    Spot {
        /// `1 / max(0.001, cos(inner) - cos(outer))`.
        angle_scale: f32,
        /// `-cos(outer) * angle_scale`.
        angle_offset: f32,
    },
}

/// A punctual light in world space.
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Kind.
    pub kind: LightKind,
    /// Metres; unused by directional lights.
    pub position_in_world: Vec3,
    /// Unit length, from the scene to the light: the +Z of its node. The opposite of a spot's axis; unused by points.
    pub direction_to_light_in_world: Vec3,
    /// Linear RGB: lux for directional, candela otherwise.
    pub intensity: Vec3,
    /// Metres beyond which nothing arrives; `None` = no end. Not scaled by nodes.
    pub range_m: Option<f32>,
}

/// Light that arrives at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Incident {
    /// Unit length.
    pub direction_to_light_in_world: Vec3,
    /// Linear RGB, lux on a surface that faces the light.
    pub irradiance: Vec3,
}

impl Light {
    /// A key light for scenes that bring none: high, over the right shoulder of a viewer in front (+Z), and strong enough
    /// that a white Lambert face turned to it shows 1.
    pub fn key() -> Self {
        Self {
            kind: LightKind::Directional,
            position_in_world: Vec3::ZERO,
            direction_to_light_in_world: Vec3::new(0.4, 0.8, 0.45).normalize(),
            intensity: Vec3::splat(PI),
            range_m: None,
        }
    }

    /// Whether every number of it is.
    pub fn is_finite(&self) -> bool {
        let vectors = [self.position_in_world, self.direction_to_light_in_world, self.intensity];
        vectors.iter().all(|vector| vector.is_finite()) && self.range_m.is_none_or(f32::is_finite)
    }

    /// The twin of the shaders' light loop: inverse square, window by range `saturate(1 - (d / range)^4)`, spot cone.
    pub fn incident_at(&self, position_in_world: Vec3) -> Incident {
        let to_light = self.position_in_world - position_in_world;
        let (direction, falloff) = match self.kind {
            LightKind::Directional => (self.direction_to_light_in_world, 1.0),
            LightKind::Point | LightKind::Spot { .. } => {
                // A point on the light itself gets a bright but finite value.
                let distance_squared = to_light.length_squared().max(1e-8);
                let window = self
                    .range_m
                    .map_or(1.0, |range_m| (1.0 - (distance_squared / (range_m * range_m)).powi(2)).clamp(0.0, 1.0));
                (to_light.normalize_or(Vec3::Y), window / distance_squared)
            }
        };
        let cone = match self.kind {
            LightKind::Spot { angle_scale, angle_offset } => {
                let cosine = self.direction_to_light_in_world.dot(direction);
                (cosine * angle_scale + angle_offset).clamp(0.0, 1.0).powi(2)
            }
            LightKind::Directional | LightKind::Point => 1.0,
        };
        Incident { direction_to_light_in_world: direction, irradiance: self.intensity * (falloff * cone) }
    }
}

/// The scene's own lights.
pub fn lights(asset: &Asset, scene: usize, pose: &Pose) -> Vec<Light> {
    nodes_of_scene(asset, scene).into_iter().filter_map(|node| light_of_node(asset, node, pose)).collect()
}

/// The light that a node holds, if it holds one.
pub fn light_of_node(asset: &Asset, node: usize, pose: &Pose) -> Option<Light> {
    let light = &asset.lights[asset.nodes[node].light?];
    let world_from_node = pose.world_from_node[node];
    let (kind, range_m) = match light.kind {
        asset::LightKind::Directional => (LightKind::Directional, None),
        asset::LightKind::Point { range_m } => (LightKind::Point, range_m),
        asset::LightKind::Spot { range_m, inner_angle, outer_angle } => {
            let angle_scale = 1.0 / (inner_angle.cos() - outer_angle.cos()).max(1e-3);
            (LightKind::Spot { angle_scale, angle_offset: -outer_angle.cos() * angle_scale }, range_m)
        }
    };
    Some(Light {
        kind,
        position_in_world: world_from_node.w_axis.truncate(),
        direction_to_light_in_world: world_from_node.z_axis.truncate().normalize_or(Vec3::Z),
        intensity: light.color * light.intensity,
        range_m,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::{AssetScene, Node, Transform};
    use crate::scene::pose;
    use glam::Quat;

    fn lit_by(kind: asset::LightKind) -> Vec<Light> {
        let transform = Transform::Trs {
            translation: Vec3::new(0.0, 3.0, 0.0),
            // The light's -Z turns to -Y: it shines down.
            rotation: Quat::from_rotation_x(-PI / 2.0),
            scale: Vec3::splat(7.0),
        };
        let asset = Asset {
            scenes: vec![AssetScene { name: None, roots: vec![0] }],
            nodes: vec![Node { light: Some(0), transform, ..Node::default() }],
            lights: vec![asset::Light { name: None, color: Vec3::new(1.0, 0.5, 0.25), intensity: 18.0, kind }],
            ..Asset::default()
        };
        lights(&asset, 0, &pose(&asset, None, 0.0))
    }

    #[test]
    fn a_point_light_falls_off_by_the_square_and_ends_at_its_range() {
        let lights = lit_by(asset::LightKind::Point { range_m: None });
        let incident = lights[0].incident_at(Vec3::ZERO);
        assert!((incident.irradiance - Vec3::new(2.0, 1.0, 0.5)).length() < 1e-6);
        assert_eq!(incident.direction_to_light_in_world, Vec3::Y);
        let short = lit_by(asset::LightKind::Point { range_m: Some(3.0) });
        assert_eq!(short[0].incident_at(Vec3::ZERO).irradiance, Vec3::ZERO);
        assert!(short[0].incident_at(Vec3::Y * 3.0).irradiance.is_finite());
    }

    #[test]
    fn a_spot_is_full_inside_its_inner_cone_and_dark_outside_the_outer_one() {
        let spot = asset::LightKind::Spot { range_m: None, inner_angle: 0.2, outer_angle: 0.4 };
        let light = &lit_by(spot)[0];
        let at = |angle: f32| light.incident_at(Vec3::new(3.0 * angle.tan(), 0.0, 0.0)).irradiance.x;
        let unwindowed = |angle: f32| 18.0 * (angle.cos() / 3.0).powi(2);
        assert!((at(0.0) - unwindowed(0.0)).abs() < 1e-5);
        assert!((at(0.19) - unwindowed(0.19)).abs() < 1e-4);
        assert_eq!(at(0.41), 0.0);
        assert!(at(0.3) > 0.0 && at(0.3) < unwindowed(0.3));
    }

    #[test]
    fn directional_lights_ignore_place_and_scale() {
        let light = &lit_by(asset::LightKind::Directional)[0];
        let incident = light.incident_at(Vec3::splat(100.0));
        assert!((incident.direction_to_light_in_world - Vec3::Y).length() < 1e-6);
        assert_eq!(incident.irradiance, Vec3::new(18.0, 9.0, 4.5));
    }

    #[test]
    fn a_key_light_shows_white_as_one() {
        let incident = Light::key().incident_at(Vec3::ZERO);
        assert_eq!(incident.irradiance / PI, Vec3::ONE);
        assert!((incident.direction_to_light_in_world.length() - 1.0).abs() < 1e-6);
    }
}
