//! Twin of `strand.glsl`: where strands stand and how they scatter light.

use super::hash;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Share of a cell by which a strand is jittered to either side.
pub const JITTER: f64 = 0.5;
/// Farthest distance, in cells, of a strand's point from the surface.
pub const REACH: f64 = 0.5;

/// A procedural strand, if a surface passes close by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strand {
    /// Where it roots, in cells.
    pub point: DVec3,
    /// Its own number in [0, 1).
    pub random: f64,
}

impl Strand {
    /// The one of a lattice cell, given by its lower corner.
    pub fn of_cell(cell: DVec3) -> Self {
        let random = hash::cell(cell.to_array().map(|coordinate| coordinate as i32));
        let point = cell + 0.5 + (DVec3::from_array(random) * 2.0 - 1.0) * JITTER;
        Self { point, random: (random[0] * 97.0 + random[1] * 57.0).fract() }
    }

    /// Profile on its axis: how far up the thresholds it reaches.
    pub fn full_length(&self) -> f64 {
        0.75 + 0.25 * self.random
    }

    /// Its point seen from a place on the surface: the offset along the surface, and the share of the root radius that
    /// its height off the surface leaves; the share is not positive where it is out of reach.
    pub fn offset(&self, position: DVec3, normal: DVec3) -> (DVec3, f64) {
        let offset = self.point - position;
        let height = offset.dot(normal);
        (offset - height * normal, 1.0 - (height / REACH).powi(2))
    }

    /// Its profile over a slab of the view ray; `None` where it is out of reach. See [`field`].
    pub fn profile(&self, position: DVec3, normal: DVec3, radius: f64, half_segment: DVec3) -> Option<f64> {
        let (in_plane, shrink) = self.offset(position, normal);
        let distance = segment_distance(in_plane, half_segment);
        (shrink > 0.0).then(|| self.full_length() * (1.0 - distance / (radius * shrink)))
    }
}

/// Profile and random number of the strongest procedural strand over a slab of the view ray.
///
/// `position` and `half_segment` are in cells, `normal` is a unit vector, `radius` is in cells. Looks at every cell
/// that can matter, not at the shader's eight.
pub fn field(position: DVec3, normal: DVec3, radius: f64, half_segment: DVec3) -> (f64, f64) {
    let mut nearest = (-1e3, 0.0);
    let middle = position.floor();
    for x in -2..=2 {
        for y in -2..=2 {
            for z in -2..=2 {
                let cell = middle + DVec3::new(f64::from(x), f64::from(y), f64::from(z));
                let strand = Strand::of_cell(cell);
                let Some(profile) = strand.profile(position, normal, radius, half_segment) else { continue };
                if profile > nearest.0 {
                    nearest = (profile, strand.random);
                }
            }
        }
    }
    nearest
}

fn segment_distance(point: DVec3, half_segment: DVec3) -> f64 {
    let length_squared = half_segment.length_squared();
    let along = if length_squared > 0.0 { (point.dot(half_segment) / length_squared).clamp(-1.0, 1.0) } else { 0.0 };
    (point - along * half_segment).length()
}

/// Closed form of the mean coverage at a threshold, swept over a segment of that half length (in cells).
pub fn mean_coverage(threshold: f64, radius: f64, half_length: f64) -> f64 {
    let radius = radius * (1.0 - threshold / 0.875).max(0.0);
    let area = PI * radius * radius * (8.0 / 15.0) + 2.0 * radius * (2.0 / 3.0) * 2.0 * half_length;
    1.0 - (-area).exp()
}

/// How far strands are below the eye's resolution; `slope` is the change of the profile over a pixel.
pub fn unresolved(slope: f64) -> f64 {
    let x = ((slope - 0.75) / 1.25).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// Opacity of a profile at a threshold, one pixel wide at the edge.
pub fn opacity(profile: f64, threshold: f64, slope: f64, mean_coverage: f64) -> f64 {
    let edge = ((profile - threshold) / slope.max(1e-6) + 0.5).clamp(0.0, 1.0);
    edge + (mean_coverage - edge) * unresolved(slope)
}

/// Threshold of the profile at a height in the coat.
pub fn threshold(height: f64, cutoff_start: f64, cutoff_end: f64, paraboloid: bool) -> f64 {
    cutoff_start + (cutoff_end - cutoff_start) * if paraboloid { height * height } else { height }
}

/// Circular arc of a strand of length 1: sideways and along the root direction at `height`, for a turn of `angle`
/// radians from root to tip.
pub fn arc(height: f64, angle: f64) -> [f64; 2] {
    let turn = angle * height;
    if turn.abs() < 1e-9 {
        return [0.5 * angle * height * height, height];
    }
    // The half-angle form of 1 - cos, which would cancel.
    [2.0 * (0.5 * turn).sin().powi(2) / angle, turn.sin() / angle]
}

/// Turn from root to tip under a force of unit direction times strength.
pub fn bend_angle(root_direction: DVec3, force: DVec3) -> f64 {
    let along = root_direction.dot(force);
    let sideways = (force - along * root_direction).length();
    if sideways < 1e-6 {
        return 0.0;
    }
    (force.length() * sideways.atan2(along)).min(FRAC_PI_2 * sideways)
}

/// Light through the coat above a height.
pub fn light_through_coat(height: f64, occlusion: f64, cosine_to_light: f64) -> f64 {
    ((1.0 - occlusion).max(1e-3).ln() * (1.0 - height) / cosine_to_light.max(0.05)).exp()
}

/// One scattering lobe of a fibre; its integral over all directions is at most 1.
pub fn lobe(tangent: DVec3, to_eye: DVec3, to_light: DVec3, shift: f64, variance: f64) -> f64 {
    let (sine_eye, sine_light) = (tangent.dot(to_eye), tangent.dot(to_light));
    let along = (-(sine_eye + sine_light - shift).powi(2) / (2.0 * variance)).exp() / (2.0 * PI * variance).sqrt();
    let (eye, light) = (to_eye - sine_eye * tangent, to_light - sine_light * tangent);
    let lengths = eye.length_squared() * light.length_squared();
    let cosine = if lengths > 1e-12 { eye.dot(light) / lengths.sqrt() } else { 1.0 };
    along * 0.25 * (0.5 + 0.5 * cosine).max(0.0).sqrt()
}

/// Variance of a lobe from longitudinal roughness (Chiang et al. 2016, equation 7).
pub fn variance(roughness: f64) -> f64 {
    let b = roughness.clamp(0.1, 1.0);
    (0.726 * b + 0.812 * b * b + 3.7 * b.powi(20)).powi(2)
}

/// Radiance per unit irradiance of a strand, one colour channel.
#[allow(clippy::too_many_arguments)] // the shader's own list
pub fn scattering(
    color: f64,
    normal: DVec3,
    tangent: DVec3,
    to_eye: DVec3,
    to_light: DVec3,
    specular: f64,
    variance: f64,
) -> f64 {
    let wrap = 0.3;
    let (reflected, returned, tilt) = (0.10 * specular, 0.30 * specular, 0.08);
    let across = (1.0 - tangent.dot(to_light).powi(2)).max(0.0).sqrt();
    let wrapped = (normal.dot(to_light) + wrap).max(0.0) / (1.0f64 + wrap).powi(2);
    let diffuse = color * (1.0 - reflected - returned) / PI * wrapped * (0.7 + 0.35 * across);
    let white = reflected * lobe(tangent, to_eye, to_light, -tilt, variance);
    let colored = returned * color * lobe(tangent, to_eye, to_light, 1.5 * tilt, 4.0 * variance);
    diffuse + (4.0 * wrapped).clamp(0.0, 1.0) * (white + colored)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Directions spread evenly over the sphere (Fibonacci lattice), each standing for 4 pi / count.
    fn sphere(count: usize) -> impl Iterator<Item = DVec3> {
        (0..count).map(move |index| {
            let z = 1.0 - (2.0 * index as f64 + 1.0) / count as f64;
            let (sine, cosine) = (index as f64 * PI * (3.0 - 5f64.sqrt())).sin_cos();
            let radius = (1.0 - z * z).sqrt();
            DVec3::new(radius * cosine, radius * sine, z)
        })
    }

    #[test]
    fn a_strand_never_reflects_more_than_it_gets() {
        let count = 20_000;
        for eye in [DVec3::Z, DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.0, 0.995, 0.0998).normalize()] {
            for tangent in [DVec3::Z, DVec3::X, DVec3::new(0.3, 0.4, 0.866).normalize()] {
                for (specular, roughness) in [(0.0, 0.3), (1.0, 0.1), (1.0, 0.35), (1.0, 1.0)] {
                    let sum: f64 = sphere(count)
                        .map(|light| scattering(1.0, DVec3::Z, tangent, eye, light, specular, variance(roughness)))
                        .sum();
                    let albedo = sum * 4.0 * PI / count as f64;
                    assert!(albedo <= 1.0 + 1e-3, "albedo {albedo} at specular {specular}, roughness {roughness}");
                    assert!(albedo > 0.25, "a white strand in white light looks dark: {albedo}");
                }
            }
        }
    }

    #[test]
    fn the_arc_keeps_its_length_and_rises_steadily() {
        for angle in [0.0, 1e-8, 1e-3, 0.3, 1.0, FRAC_PI_2] {
            let steps = 4000;
            let (mut length, mut before) = (0.0, arc(0.0, angle));
            assert_eq!(before, [0.0, 0.0], "the root stays where it is");
            for step in 1..=steps {
                let now = arc(f64::from(step) / f64::from(steps), angle);
                assert!(now[1] >= before[1], "height falls at angle {angle}");
                length += (now[0] - before[0]).hypot(now[1] - before[1]);
                before = now;
            }
            assert!((length - 1.0).abs() < 1e-5, "length {length} at angle {angle}");
        }
    }

    #[test]
    fn a_force_bends_towards_itself_and_never_past() {
        let root = DVec3::Y;
        assert_eq!(bend_angle(root, DVec3::ZERO), 0.0);
        assert_eq!(bend_angle(root, -DVec3::Y), 0.0);
        assert_eq!(bend_angle(root, DVec3::Y), 0.0);
        assert!((bend_angle(root, DVec3::X) - FRAC_PI_2).abs() < 1e-12);
        for degrees in 1..180 {
            let (sine, cosine) = f64::from(degrees).to_radians().sin_cos();
            let angle = bend_angle(root, DVec3::new(sine, cosine, 0.0));
            assert!(angle <= f64::from(degrees).to_radians() + 1e-12 && angle <= FRAC_PI_2 + 1e-12);
        }
    }

    #[test]
    fn mean_coverage_is_that_of_the_field() {
        for (normal, tangent) in [(DVec3::Z, DVec3::X), (DVec3::new(0.48, 0.6, 0.64), DVec3::new(0.8, 0.0, -0.6))] {
            let bitangent = normal.cross(tangent);
            for (threshold, half_length) in [(0.0, 0.0), (0.25, 0.0), (0.5, 0.0), (0.0, 0.5), (0.5, 0.5), (0.25, 1.0)] {
                let side = 220;
                let covered = (0..side * side)
                    .filter(|index| {
                        let (x, y) = (f64::from(index % side) * 0.137, f64::from(index / side) * 0.137);
                        field(tangent * x + bitangent * y, normal, 0.35, tangent * half_length).0 > threshold
                    })
                    .count();
                let measured = covered as f64 / f64::from(side * side);
                let expected = mean_coverage(threshold, 0.35, half_length);
                // Sampling noise over about 900 strands is 0.01; points stratified by cell overlap less than chance.
                assert!((measured - expected).abs() < 0.04, "{measured} for {expected} at {threshold}, {half_length}");
            }
        }
    }

    #[test]
    fn opacity_keeps_its_mean_at_every_distance() {
        for threshold in [0.025, 0.125, 0.4] {
            let mean = mean_coverage(threshold, 0.35, 0.0);
            for slope in [0.05, 0.1, 0.3, 0.6, 0.75, 1.0, 1.5, 2.0, 4.0] {
                let side = 200;
                let sum: f64 = (0..side * side)
                    .map(|index| {
                        let place = DVec3::new(f64::from(index % side) * 0.137, f64::from(index / side) * 0.137, 0.3);
                        opacity(field(place, DVec3::Z, 0.35, DVec3::ZERO).0, threshold, slope, mean)
                    })
                    .sum();
                let found = sum / f64::from(side * side);
                // The edge is filtered where strands end in all directions, so a slope of one reaches half a radius out.
                assert!((found - mean).abs() < 0.06, "{found} for {mean} at threshold {threshold}, slope {slope}");
            }
        }
    }

    #[test]
    fn light_falls_with_depth_and_slant() {
        assert_eq!(light_through_coat(1.0, 0.9, 0.2), 1.0);
        assert!((light_through_coat(0.0, 0.7, 1.0) - 0.3).abs() < 1e-12);
        assert!(light_through_coat(0.0, 1.0, 1e-9) > 0.0 - 1e-300);
        assert!(light_through_coat(0.5, 0.7, 0.5) < light_through_coat(0.5, 0.7, 1.0));
    }
}
