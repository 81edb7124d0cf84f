//! The outline of a point cloud, seen from anywhere.

use super::Aabb;
use glam::Vec3;
use std::f32::consts::PI;
use std::sync::LazyLock;

/// Directions besides the six axes; their spacing is about 18 degrees, so an outline is short by at most 1.3 %.
const DIRECTIONS: usize = 128;

/// The farthest points of a cloud in evenly spread directions: a small stand-in for its convex hull. The six axes are
/// among the directions, so that the box around it is exact.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Hull {
    /// Empty, or one point a direction; points repeat.
    points: Vec<Vec3>,
}

impl Hull {
    /// The hull of a box.
    pub fn of_box(bounds: Aabb) -> Self {
        let mut hull = Self::default();
        if !bounds.is_empty() {
            hull.extend(&bounds.corners());
        }
        hull
    }

    /// Takes more points in.
    pub fn extend(&mut self, points: &[Vec3]) {
        let Some(&first) = points.first() else { return };
        if self.points.is_empty() {
            self.points = vec![first; directions().len()];
        }
        for (extreme, &direction) in self.points.iter_mut().zip(directions()) {
            let mut farthest = extreme.dot(direction);
            for &point in points {
                let distance = point.dot(direction);
                if distance > farthest {
                    (farthest, *extreme) = (distance, point);
                }
            }
        }
    }

    /// The hull of everything within `margin` of this one.
    pub fn grown(&self, margin: f32) -> Self {
        let outward = self.points.iter().zip(directions());
        Self { points: outward.map(|(&point, &direction)| point + direction * margin).collect() }
    }

    /// The extreme points; empty without any.
    pub fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// The box around all points.
    pub fn bounds(&self) -> Aabb {
        Aabb::around(self.points.iter().copied())
    }
}

/// The axes and a Fibonacci lattice on the sphere.
fn directions() -> &'static [Vec3] {
    static ALL: LazyLock<Vec<Vec3>> = LazyLock::new(|| {
        let golden_angle = PI * (3.0 - 5f32.sqrt());
        let lattice = (0..DIRECTIONS).map(|index| {
            let y = 1.0 - (2.0 * index as f32 + 1.0) / DIRECTIONS as f32;
            let (sine, cosine) = (golden_angle * index as f32).sin_cos();
            let radius = (1.0 - y * y).sqrt();
            Vec3::new(radius * cosine, y, radius * sine)
        });
        [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z].into_iter().chain(lattice).collect()
    });
    &ALL
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_box_is_exact_and_the_outline_nearly() {
        let cloud: Vec<Vec3> = (0..5000)
            .map(|index| {
                let angle = index as f32 * 2.399_963;
                let y = 1.0 - 2.0 * (index as f32 + 0.5) / 5000.0;
                Vec3::new(angle.cos(), 0.0, angle.sin()) * (1.0 - y * y).sqrt() + Vec3::Y * y
            })
            .collect();
        let mut hull = Hull::default();
        for part in cloud.chunks(700) {
            hull.extend(part);
        }
        assert_eq!(hull.bounds(), Aabb::around(cloud.iter().copied()));
        for direction in [Vec3::new(1.0, 2.0, -0.5).normalize(), Vec3::new(-0.3, 0.1, 0.9).normalize()] {
            let reach = |points: &[Vec3]| points.iter().map(|point| point.dot(direction)).fold(f32::MIN, f32::max);
            assert!(reach(hull.points()) > 0.987 * reach(&cloud));
        }
        let grown = hull.grown(0.5).bounds();
        assert!((grown.max - hull.bounds().max - 0.5).length() < 1e-6);
        assert!(Hull::default().grown(1.0).bounds().is_empty() && Hull::of_box(Aabb::EMPTY).points().is_empty());
    }
}
