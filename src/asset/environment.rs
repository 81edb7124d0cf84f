//! Environments: light from every direction, as an equirectangular picture of linear radiance.

use glam::Vec3;

/// An environment.
#[derive(Debug, Clone, PartialEq)]
pub struct Environment {
    /// What reports call it.
    pub name: String,
    /// Columns and rows.
    pub size: [u32; 2],
    /// Linear RGB radiance, finite and not negative, rows from the top (+Y).
    pub texels: Vec<[f32; 3]>,
}

impl Environment {
    /// The same from everywhere; linear RGB radiance >= 0.
    pub fn constant(radiance: Vec3) -> Self {
        Self { name: "constant".to_owned(), size: [1, 1], texels: vec![radiance.to_array()] }
    }

    /// The radiance where it is the same from everywhere.
    pub fn constant_radiance(&self) -> Option<Vec3> {
        let first = self.texels.first()?;
        self.texels.iter().all(|texel| texel == first).then_some(Vec3::from_array(*first))
    }
}
