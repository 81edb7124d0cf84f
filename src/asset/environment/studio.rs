//! The embedded studio, by formula: what a photographer of cloth and fur puts around the subject.

use super::{Environment, direction_of_texel};
use glam::Vec3;

/// Columns and rows.
const SIZE: [u32; 2] = [512, 256];

/// A rectangular light with soft edges, at a distance of 1 from the subject.
struct SoftBox {
    /// Towards its middle; any length above 0.
    direction: Vec3,
    /// Half of its width and height.
    half: [f32; 2],
    /// Width of its edge.
    edge: f32,
    /// Linear RGB in its middle.
    radiance: Vec3,
}

/// Key, fill, two rims, a panel above.
const LIGHTS: [SoftBox; 5] = [
    SoftBox {
        direction: Vec3::new(-0.62, 0.55, 0.60),
        half: [0.42, 0.36],
        edge: 0.10,
        radiance: Vec3::new(6.2, 5.95, 5.6),
    },
    SoftBox {
        direction: Vec3::new(0.85, 0.22, 0.50),
        half: [0.40, 0.60],
        edge: 0.25,
        radiance: Vec3::new(0.62, 0.65, 0.70),
    },
    SoftBox {
        direction: Vec3::new(-0.80, 0.18, -0.58),
        half: [0.10, 0.75],
        edge: 0.05,
        radiance: Vec3::new(5.2, 5.5, 6.0),
    },
    SoftBox {
        direction: Vec3::new(0.78, 0.28, -0.58),
        half: [0.14, 0.75],
        edge: 0.05,
        radiance: Vec3::new(6.2, 6.5, 7.0),
    },
    SoftBox { direction: Vec3::new(0.0, 1.0, -0.15), half: [0.55, 0.40], edge: 0.15, radiance: Vec3::splat(2.2) },
];

impl SoftBox {
    fn radiance_from(&self, direction: Vec3) -> Vec3 {
        let axis = self.direction.normalize();
        let right = axis.cross(Vec3::Y).normalize();
        let depth = direction.dot(axis);
        if depth <= 0.0 {
            return Vec3::ZERO;
        }
        let inside = |along: Vec3, half: f32| {
            let beyond = (direction.dot(along) / depth).abs() - half;
            1.0 - smooth_step((beyond / self.edge + 0.5).clamp(0.0, 1.0))
        };
        self.radiance * inside(right, self.half[0]) * inside(right.cross(axis), self.half[1])
    }
}

fn smooth_step(x: f32) -> f32 {
    x * x * (3.0 - 2.0 * x)
}

/// Walls that grow lighter upwards, and a warm floor that the key light brightens on its side.
fn room(direction: Vec3) -> Vec3 {
    let wall = Vec3::new(0.23, 0.24, 0.26) * (0.75 + 0.45 * smooth_step((direction.y * 0.8 + 0.4).clamp(0.0, 1.0)));
    let lit = 0.5 + 0.5 * direction.dot(Vec3::new(-0.5, 0.0, 0.6));
    let floor = Vec3::new(0.34, 0.325, 0.31) * (0.6 + 0.6 * lit.clamp(0.0, 1.0));
    wall.lerp(floor, smooth_step((-direction.y * 4.0 + 0.3).clamp(0.0, 1.0)))
}

pub(super) fn studio() -> Environment {
    let [width, height] = SIZE;
    let texel = |column, row| {
        let direction = direction_of_texel(SIZE, column, row);
        let light = LIGHTS.iter().map(|light| light.radiance_from(direction)).sum::<Vec3>();
        (room(direction) + light).to_array()
    };
    let texels = (0..height).flat_map(|row| (0..width).map(move |column| texel(column, row))).collect();
    Environment { name: "studio".to_owned(), size: SIZE, texels }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3Swizzles;
    use std::f32::consts::{PI, TAU};

    /// Mean over the channels of the radiance of a white matt surface of that normal.
    fn matt(environment: &Environment, normal: Vec3) -> f32 {
        let [width, height] = environment.size;
        let mut sum = 0.0;
        for (texel, index) in environment.texels.iter().zip(0..) {
            let direction = direction_of_texel(environment.size, index % width, index / width);
            let solid_angle = TAU * PI / (width * height) as f32 * direction.xz().length();
            sum += texel.iter().sum::<f32>() / 3.0 * direction.dot(normal).max(0.0) * solid_angle / PI;
        }
        sum
    }

    #[test]
    fn white_cloth_is_exposed_well() {
        let studio = studio();
        let front = matt(&studio, Vec3::Z);
        assert!((0.8..1.0).contains(&front), "{front}");
        let key = matt(&studio, LIGHTS[0].direction.normalize());
        let away = matt(&studio, Vec3::NEG_Y);
        assert!(key > 1.3 * front && away < 0.6 * front, "{key} {front} {away}");
    }
}
