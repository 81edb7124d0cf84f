//! Which lights reach which object: a draw loops over its own lights and no others.

use super::{Light, LightKind};
use crate::math::Sphere;
use std::ops::Range;

/// The lights of every object. Objects of the same lights share their list.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LightLists {
    /// Indices of lights, list after list. A light that reaches nothing is in none.
    pub lights: Vec<usize>,
    /// Part of `lights`, by object.
    pub ranges: Vec<Range<u32>>,
}

impl LightLists {
    /// The lists of objects with these spheres around them.
    pub fn new(lights: &[Light], objects: impl IntoIterator<Item = Sphere>) -> Self {
        let mut lists = Self::default();
        lists.set(lights, objects);
        lists
    }

    /// Becomes [`Self::new`], in the memory that it has.
    pub fn set(&mut self, lights: &[Light], objects: impl IntoIterator<Item = Sphere>) {
        self.lights.clear();
        self.ranges.clear();
        for object in objects {
            // The object's own list is written behind all others, and taken back where one of them is the same.
            let start = self.lights.len();
            self.lights.extend((0..lights.len()).filter(|&index| lights[index].reaches(object)));
            let (others, own) = self.lights.split_at(start);
            let is_own = |range: &&Range<u32>| others[range.start as usize..range.end as usize] == *own;
            let range = match self.ranges.iter().find(is_own) {
                Some(range) => {
                    let range = range.clone();
                    self.lights.truncate(start);
                    range
                }
                None => start as u32..self.lights.len() as u32,
            };
            self.ranges.push(range);
        }
    }

    /// The lights of an object.
    pub fn of(&self, object: usize) -> &[usize] {
        let range = &self.ranges[object];
        &self.lights[range.start as usize..range.end as usize]
    }

    /// Whether a light reaches any object.
    pub fn is_used(&self, light: usize) -> bool {
        self.lights.contains(&light)
    }
}

impl Light {
    /// Whether any of its light can arrive within a sphere. Never says no where some does.
    pub fn reaches(&self, object: Sphere) -> bool {
        let to_object = object.center - self.position_in_world;
        let distance_m = to_object.length();
        // What cannot be told is reached.
        let is_in_range = !self.range_m.is_some_and(|range_m| distance_m - object.radius >= range_m);
        let is_in_cone = match self.kind {
            LightKind::Spot { angle_scale, angle_offset } => {
                let cosine = (-angle_offset / angle_scale).clamp(-1.0, 1.0);
                let along_m = -to_object.dot(self.direction_to_light_in_world);
                let across_m = (distance_m * distance_m - along_m * along_m).max(0.0).sqrt();
                // How far the sphere's middle is outside the cone, by the distance to its side where that is nearest.
                let outside_m = across_m * cosine - along_m * (1.0 - cosine * cosine).sqrt();
                distance_m <= object.radius * (1.0 + SLACK) || outside_m <= object.radius + SLACK * distance_m
            }
            LightKind::Directional | LightKind::Point => true,
        };
        self.intensity.max_element() > 0.0 && (self.kind == LightKind::Directional || is_in_range && is_in_cone)
    }
}

/// Rounding must not cut off a cone's edge.
const SLACK: f32 = 1e-4;

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use proptest::prelude::*;

    fn light(kind: LightKind, range_m: Option<f32>) -> Light {
        Light { kind, range_m, position_in_world: Vec3::Y * 2.0, direction_to_light_in_world: Vec3::Y, ..Light::key() }
    }

    fn spot(outer: f32) -> LightKind {
        let angle_scale = 1.0 / (1.0 - outer.cos()).max(1e-3);
        LightKind::Spot { angle_scale, angle_offset: -outer.cos() * angle_scale }
    }

    proptest! {
        #[test]
        fn where_light_arrives_it_is_said_to(
            x in -4f32..4.0, y in -4f32..4.0, z in -4f32..4.0, radius in 0f32..2.0, outer in 0.01f32..1.57,
            range_m in 0.1f32..8.0, is_spot: bool,
        ) {
            let object = Sphere { center: Vec3::new(x, y, z), radius };
            let light = light(if is_spot { spot(outer) } else { LightKind::Point }, Some(range_m));
            for towards in [Vec3::ZERO, Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z] {
                let arrives = light.incident_at(object.center + towards * radius).irradiance.max_element() > 1e-6;
                prop_assert!(!arrives || light.reaches(object));
            }
        }
    }

    #[test]
    fn ranges_cones_and_darkness_keep_lights_away() {
        let below = Sphere { center: Vec3::NEG_Y, radius: 0.5 };
        let aside = Sphere { center: Vec3::new(3.0, 0.0, 0.0), radius: 0.5 };
        assert!(light(LightKind::Point, None).reaches(aside));
        assert!(!light(LightKind::Point, Some(2.4)).reaches(below));
        assert!(light(LightKind::Point, Some(2.6)).reaches(below));
        assert!(light(spot(0.4), None).reaches(below) && !light(spot(0.4), None).reaches(aside));
        let above = Sphere { center: Vec3::Y * 9.0, radius: 0.5 };
        assert!(!light(spot(1.5), None).reaches(above) && light(LightKind::Directional, None).reaches(above));
        assert!(!Light { intensity: Vec3::ZERO, ..Light::key() }.reaches(below));
    }

    #[test]
    fn objects_of_the_same_lights_share_a_list() {
        let lights = [light(spot(0.4), None), Light { intensity: Vec3::ZERO, ..Light::key() }, Light::key()];
        let at = |x: f32| Sphere { center: Vec3::X * x, radius: 0.1 };
        let lists = LightLists::new(&lights, [at(0.0), at(5.0), at(0.1), at(6.0)]);
        assert_eq!(lists.lights, [0, 2, 2]);
        assert_eq!(lists.ranges, [0..2, 2..3, 0..2, 2..3]);
        assert!(lists.is_used(0) && !lists.is_used(1));
    }
}
