//! What a pixel covers of the lattice, and the weight of a flake in it.

use super::inputs::{FLAKES, FOOTPRINT, KERNEL, NEAR, ivec2, join, read_flakes, words2};
use super::lattice::{chance, edges};
use crate::material::Flakes;
use crate::measure::twin::domain::Domain;
use crate::measure::twin::{Rule, TestInputs, Twin, ULP, hash};
use glam::{DMat2, DVec2, DVec3, IVec2};
use std::f64::consts::PI;

/// Variance along an axis, in squared pixels, of the light that a pixel sees: of a Gaussian that is a pixel wide.
const PIXEL_VARIANCE: f64 = 0.25;
/// Variance along an axis of the profile `1 - u^n` at the `n = 1` that small flakes have: u is the squared distance over a
/// squared radius of 1.
const PROFILE_VARIANCE: f64 = 1.0 / 6.0;

/// What a pixel covers of the lattice.
#[derive(Debug, Clone, Copy)]
pub struct Footprint {
    /// Rhombus of the pixel's middle.
    pub cell: IVec2,
    /// The middle in it, [0, 1].
    pub within: DVec2,
    /// One pixel to the right and one down, widened to what a pixel sees.
    pub pixel: DMat2,
    /// Squared radius of a disc with its soft edge.
    pub disc: f64,
    /// Of that edge, at least 1.
    pub sharpness: f64,
    /// One over the squared area of the kernel, in pi times areas of a rhombus.
    pub inverse_squared: f64,
    /// Half of what the kernel spans along either edge.
    pub reach: f64,
    /// The same of the pixel alone.
    pub blur: f64,
}

impl Footprint {
    /// Of a pixel at a place, with what changes from pixel to pixel; in a plane, in edges of a rhombus.
    pub fn new(flakes: &Flakes, position: DVec2, to_right: DVec2, to_below: DVec2) -> Self {
        let to_lattice = edges().inverse();
        let place = (to_lattice * position).clamp(DVec2::splat(-1e8), DVec2::splat(1e8));
        let bounded = |vector: DVec2| (to_lattice * vector).clamp(DVec2::splat(-1e6), DVec2::splat(1e6));
        let pixel = DMat2::from_cols(bounded(to_right), bounded(to_below));
        let width = (edges() * pixel.x_axis).length().max((edges() * pixel.y_axis).length()).max(1e-4);
        let radius = f64::from(flakes.radius);
        let sharpness = 1.0 + radius / width;
        let disc = radius * radius * (1.0 + 1.0 / sharpness);
        let pixel = pixel * (PIXEL_VARIANCE / PROFILE_VARIANCE).sqrt();
        let half = |covariance: DMat2| covariance.x_axis.x.max(covariance.y_axis.y).sqrt();
        Self {
            cell: place.floor().as_ivec2(),
            within: place - place.floor(),
            pixel,
            disc,
            sharpness,
            inverse_squared: 1.0 / determinant(disc, pixel).max(1e-12),
            reach: half(covariance(disc, pixel)),
            blur: half(pixel * pixel.transpose()),
        }
    }

    /// Weight of a flake at an offset along the edges. Its integral is 1.
    pub fn weight(&self, offset: DVec2) -> f64 {
        let covariance = covariance(self.disc, self.pixel);
        let (x, y) = (covariance.x_axis, covariance.y_axis);
        let adjugate = DMat2::from_cols(DVec2::new(y.y, -x.y), DVec2::new(-y.x, x.x));
        // Never negative, whatever a matrix of nearly a line is rounded to.
        let u = (offset.dot(adjugate * offset) * self.inverse_squared).max(0.0);
        if u >= 1.0 {
            return 0.0;
        }
        let n = self.sharpness;
        chance(1.0 - u, n) * (1.0 + 1.0 / n) * self.inverse_squared.sqrt() / PI
    }
}

/// Covariance of a disc and a pixel, along the edges.
fn covariance(disc: f64, pixel: DMat2) -> DMat2 {
    round() * disc + pixel * pixel.transpose()
}

/// Covariance of a disc of radius 1.
fn round() -> DMat2 {
    let plane = edges().inverse();
    plane * plane.transpose()
}

/// Determinant of that covariance, by Cauchy and Binet: grazing views stretch pixels so far that the matrix forgets it.
fn determinant(disc: f64, pixel: DMat2) -> f64 {
    let across = |vector: DVec2| vector.perp().dot(round() * vector.perp());
    disc * disc * round().determinant()
        + disc * (across(pixel.x_axis) + across(pixel.y_axis))
        + pixel.determinant().powi(2)
}

/// Tint and weight of one flake of a level in a pixel.
pub fn flake(flakes: &Flakes, footprint: &Footprint, place: IVec2, level: u32, stream: u32) -> (DVec3, f64) {
    let (middle, tint) = flake_at(flakes, place, level, stream);
    let whole = (place << level) - footprint.cell;
    (tint, footprint.weight(whole.as_dvec2() + middle - footprint.within))
}

/// Middle of a flake in its place, in rhombi, and its tint.
pub fn flake_at(flakes: &Flakes, place: IVec2, level: u32, stream: u32) -> (DVec2, DVec3) {
    let [x, y, z] = hash::pcg3d([place.x as u32, place.y as u32, stream]);
    let share = |bits: u32| (f64::from(bits >> 16) + 0.5) / 65536.0 - 0.5;
    let middle = 0.5 + f64::from(flakes.jitter) * DVec2::new(share(x), share(y));
    let shade = |shift: u32| (f64::from(z >> shift & 1023) + 0.5) / 1024.0;
    let tint = 1.0 - f64::from(flakes.variation) * DVec3::new(shade(2), shade(12), shade(22));
    (middle * f64::from(1u32 << level), tint)
}

pub(super) fn read_footprint(inputs: &mut TestInputs<'_>) -> Footprint {
    Footprint {
        cell: ivec2(inputs),
        within: inputs.vec2(),
        pixel: DMat2::from_cols(inputs.vec2(), inputs.vec2()),
        disc: inputs.number(),
        sharpness: inputs.number(),
        inverse_squared: inputs.number(),
        reach: inputs.number(),
        blur: inputs.number(),
    }
}

fn tinted((tint, weight): (DVec3, f64)) -> Vec<f64> {
    (tint * weight).extend(weight).to_array().to_vec()
}

/// What the shader's functions are held to.
pub(in crate::measure::twin) const TWINS: &[Twin] = &[
    Twin::new(
        "glint_footprint",
        &join::<8>(&[
            &FLAKES,
            &[
                Domain::Uniform(-8.0, 8.0, &[-8.0, 0.0, 1e-40, 8.0]),
                Domain::Uniform(-2.0, 2.0, &[-1e30, 0.0, 1e-40, 2.0]),
                Domain::Uniform(-2.0, 2.0, &[0.0, 1e-3, 1e30]),
            ],
        ]),
        |inputs| {
            let flakes = read_flakes(inputs);
            let f = Footprint::new(&flakes, inputs.vec2(), inputs.vec2(), inputs.vec2());
            let (cell, within, across, down) = (f.cell.as_dvec2(), f.within, f.pixel.x_axis, f.pixel.y_axis);
            let mut words = [cell, within, across, down].map(words2).concat();
            words.extend([f.disc, f.sharpness, f.inverse_squared, f.reach, f.blur]);
            words
        },
    )
    .allowance(|inputs| {
        let flakes = read_flakes(inputs);
        let f = Footprint::new(&flakes, inputs.vec2(), inputs.vec2(), inputs.vec2());
        // Where a grazing view stretches the pixel to nearly a line, its area is the difference of two products, each of
        // six roundings; the kernel's is at least that.
        let (x, y) = (f.pixel.x_axis, f.pixel.y_axis);
        let rounding = 6.0 * ULP * ((x.x * y.y).abs() + (x.y * y.x).abs());
        let mut allowed = vec![0.0; 13];
        allowed[10] = 2.0 * rounding * f.inverse_squared.powf(1.5);
        allowed
    })
    .rule(Rule::Stepped(4)),
    Twin::new(
        "glint_flake",
        &join::<17>(&[&FLAKES, &FOOTPRINT, &[NEAR, Domain::Choice(&[0, 1, 2]), Domain::Bits]]),
        |inputs| {
            let (flakes, footprint) = (read_flakes(inputs), read_footprint(inputs));
            let (place, level, stream) = (ivec2(inputs), inputs.uint(), inputs.uint());
            tinted(flake(&flakes, &footprint, place, level, stream))
        },
    )
    .rule(KERNEL),
];
