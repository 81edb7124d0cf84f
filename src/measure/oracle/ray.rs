//! Rays, and the frame in which a ray is a point.

use crate::measure::twin::direction;
use crate::scene::Camera;
use glam::{DMat4, DVec2, DVec3};

/// A ray from a picture's near plane to its far one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where it starts, metres.
    pub origin: DVec3,
    /// Unit vector.
    pub direction: DVec3,
    /// Where it ends, metres from the origin; may be infinite.
    pub length_m: f64,
    across: [DVec3; 2],
}

impl Ray {
    /// A ray with a unit `direction`.
    pub fn new(origin: DVec3, direction: DVec3, length_m: f64) -> Self {
        Self { origin, direction, length_m, across: direction::frame(direction) }
    }

    /// The place at a distance from the origin.
    pub fn at(&self, distance_m: f64) -> DVec3 {
        self.origin + self.direction * distance_m
    }

    /// A place as the ray sees it: across the ray, where the ray itself is the origin, and metres along it.
    pub fn seen(&self, place: DVec3) -> (DVec2, f64) {
        let offset = place - self.origin;
        let [right, up] = self.across;
        (DVec2::new(offset.dot(right), offset.dot(up)), offset.dot(self.direction))
    }
}

/// A camera's rays.
#[derive(Debug, Clone, Copy)]
pub struct Eye {
    world_from_clip: DMat4,
    /// Metres.
    position_in_world: DVec3,
    backwards_in_world: DVec3,
    is_orthographic: bool,
}

impl Eye {
    pub fn new(camera: &Camera) -> Self {
        let clip_from_world = camera.clip_from_camera.as_dmat4() * camera.camera_from_world.as_dmat4();
        Self {
            world_from_clip: clip_from_world.inverse(),
            position_in_world: camera.eye_in_world().as_dvec3(),
            backwards_in_world: camera.backwards_in_world().as_dvec3(),
            is_orthographic: camera.is_orthographic,
        }
    }

    /// The ray through a place of the picture: clip space, Y up.
    pub fn ray(&self, place: DVec2) -> Ray {
        // Reversed depth: 1 is the near plane; 0 is the far one, which may lie at infinity.
        let at = |depth: f64| self.world_from_clip * place.extend(depth).extend(1.0);
        let [near, between, far] = [1.0, 0.5, 0.0].map(at);
        let origin = near.truncate() / near.w;
        let direction = (between.truncate() / between.w - origin).normalize();
        let end = far.truncate() / far.w;
        let length_m = if end.is_finite() { (end - origin).length() } else { f64::INFINITY };
        Ray::new(origin, direction, length_m)
    }

    /// Unit vector from a place towards the eye.
    pub fn direction_to(&self, place_in_world: DVec3, fallback: DVec3) -> DVec3 {
        if self.is_orthographic {
            return self.backwards_in_world;
        }
        direction::or(self.position_in_world - place_in_world, fallback)
    }
}
