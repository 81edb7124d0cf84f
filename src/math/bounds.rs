//! Boxes and spheres around points.

use glam::{Mat4, Vec3};

/// Axis-aligned box; empty when `min` > `max` on an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    /// Smallest coordinates.
    pub min: Vec3,
    /// Largest coordinates.
    pub max: Vec3,
}

impl Default for Aabb {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl Aabb {
    /// Holds nothing; the neutral element of [`Aabb::union`].
    pub const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// Smallest box around all points; empty without any.
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |bounds, point| bounds.union(Self { min: point, max: point }))
    }

    /// Holds nothing.
    pub fn is_empty(&self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// Smallest box around both.
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Middle; the origin when empty.
    pub fn center(&self) -> Vec3 {
        // Halved first: the sum of two large coordinates may overflow.
        if self.is_empty() { Vec3::ZERO } else { self.min * 0.5 + self.max * 0.5 }
    }

    /// Half the size per axis; 0 when empty.
    pub fn half_extent(&self) -> Vec3 {
        if self.is_empty() { Vec3::ZERO } else { self.max * 0.5 - self.min * 0.5 }
    }

    /// The eight corners; all at the origin when empty.
    pub fn corners(&self) -> [Vec3; 8] {
        let (center, half) = (self.center(), self.half_extent());
        std::array::from_fn(|i| {
            let sign = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
            center + half * Vec3::new(sign(0), sign(1), sign(2))
        })
    }

    /// Box around the transformed box; empty stays empty.
    pub fn transformed(&self, matrix: Mat4) -> Self {
        if self.is_empty() { *self } else { Self::around(self.corners().map(|corner| matrix.transform_point3(corner))) }
    }

    /// Sphere through the corners.
    pub fn sphere(&self) -> Sphere {
        Sphere { center: self.center(), radius: self.half_extent().length() }
    }
}

/// A ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Middle.
    pub center: Vec3,
    /// >= 0.
    pub radius: f32,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_empty_box_is_neutral_and_harmless() {
        let unit = Aabb { min: Vec3::ZERO, max: Vec3::ONE };
        assert!(Aabb::EMPTY.is_empty() && !unit.is_empty());
        assert_eq!(unit.union(Aabb::EMPTY), unit);
        assert_eq!(Aabb::EMPTY.sphere(), Sphere { center: Vec3::ZERO, radius: 0.0 });
        assert!(Aabb::EMPTY.transformed(Mat4::from_translation(Vec3::ONE)).is_empty());
    }

    #[test]
    fn a_point_is_a_box_without_size() {
        let point = Aabb::around([Vec3::splat(3.0)]);
        assert!(!point.is_empty());
        assert_eq!(point.sphere(), Sphere { center: Vec3::splat(3.0), radius: 0.0 });
    }

    #[test]
    fn a_turned_box_grows_by_its_diagonal() {
        let unit = Aabb { min: -Vec3::ONE, max: Vec3::ONE };
        let turned = unit.transformed(Mat4::from_rotation_z(std::f32::consts::FRAC_PI_4));
        assert!((turned.max - Vec3::new(2f32.sqrt(), 2f32.sqrt(), 1.0)).length() < 1e-6);
        assert_eq!(unit.corners().len(), 8);
        assert!((unit.sphere().radius - 3f32.sqrt()).abs() < 1e-6);
    }
}
