//! Light from all around, as a frame uses it.

use crate::asset::Environment;
use glam::Vec3;
use std::sync::{Arc, LazyLock};

/// An environment, turned and scaled.
#[derive(Debug, Clone, PartialEq)]
pub struct EnvironmentLight {
    /// What is all around; frames that share it share what is made of it.
    pub map: Arc<Environment>,
    /// Degrees by which it turns around +Y, counter-clockwise seen from above.
    pub rotation_deg: f32,
    /// Factor on its radiance, finite and >= 0.
    pub strength: f32,
}

impl EnvironmentLight {
    /// An environment as it is.
    pub fn new(map: Arc<Environment>) -> Self {
        Self { map, rotation_deg: 0.0, strength: 1.0 }
    }

    /// The same linear RGB radiance (>= 0) from everywhere.
    pub fn constant(radiance: Vec3) -> Self {
        Self::new(Arc::new(Environment::constant(radiance)))
    }

    /// The embedded studio.
    pub fn studio() -> Self {
        static STUDIO: LazyLock<Arc<Environment>> = LazyLock::new(|| Arc::new(Environment::studio()));
        Self::new(STUDIO.clone())
    }

    /// The radiance where it is the same from everywhere.
    pub fn constant_radiance(&self) -> Option<Vec3> {
        Some(self.map.constant_radiance()? * self.strength)
    }
}

impl Default for EnvironmentLight {
    fn default() -> Self {
        Self::studio()
    }
}
