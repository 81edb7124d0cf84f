//! Twin of `glint.glsl`: flakes as points spread evenly over cloth and normals.
//!
//! Deliot & Belcour 2023, "Real-Time Rendering of Glinty Appearances using Distributed Binomial Laws on Anisotropic
//! Grids"; Kemppinen et al. 2025, "Glinty NDFs in Constant Time"; Shirley & Chiu 1997, "A Low Distortion Map Between Disk
//! and Square".

use super::albedo::Fit;
use super::{ggx, hash, standard};
use crate::material::Flakes;
use glam::{DMat2, DVec2, DVec3, IVec2, Vec2Swizzles};
use std::f64::consts::PI;

/// Variance along an axis, in squared pixels, of the light that a pixel sees: of a Gaussian that is a pixel wide.
const PIXEL_VARIANCE: f64 = 0.25;
/// Variance along an axis of the profile `1 - u^n` at the `n = 1` that small flakes have: u is the squared distance over a
/// squared radius of 1.
const PROFILE_VARIANCE: f64 = 1.0 / 6.0;
/// Level at which single flakes are left out.
pub const LAST_LEVEL: f64 = 8.0;

/// `1 - (1 - p)^n`, where neither p nor its complement may vanish in a sum.
pub fn chance(p: f64, n: f64) -> f64 {
    if n == 0.0 { 0.0 } else { -(n * (-p).ln_1p()).exp_m1() }
}

/// Where a normal lies in the square [-1, 1]^2 that the normals of GGX of that width fill evenly.
pub fn square(normal: DVec3, alpha: f64) -> DVec2 {
    let stretched = DVec3::new(normal.x / alpha, normal.y / alpha, normal.z);
    if stretched.x == 0.0 && stretched.y == 0.0 {
        return DVec2::ZERO;
    }
    let disc = (stretched / stretched.length()).truncate();
    // In the quarter around the x axis, x is the radius, and y the angle's share of that quarter.
    let quarter = |along: f64, aside: f64| {
        disc.length() * DVec2::new(1f64.copysign(along), (aside / along.abs()).atan() / (0.25 * PI))
    };
    if disc.x.abs() >= disc.y.abs() { quarter(disc.x, disc.y) } else { quarter(disc.y, disc.x).yx() }
}

/// The normal that lies there: the inverse of [`square`].
pub fn normal(square: DVec2, alpha: f64) -> DVec3 {
    let of_quarter = |along: f64, aside: f64| {
        let (sine, cosine) = if along == 0.0 { (0.0, 1.0) } else { (0.25 * PI * aside / along).sin_cos() };
        along * DVec2::new(cosine, sine)
    };
    let disc = if square.x.abs() >= square.y.abs() {
        of_quarter(square.x, square.y)
    } else {
        of_quarter(square.y, square.x).yx()
    };
    DVec3::new(alpha * disc.x, alpha * disc.y, (1.0f64 - disc.length_squared()).max(0.0).sqrt()).normalize()
}

/// A permutation of the numbers below 4^fineness for each key.
pub fn shuffle(number: u32, fineness: u32, key: u32) -> u32 {
    let mask = (1 << (2 * fineness)) - 1;
    let first = ((number ^ key) & mask).wrapping_mul(0x9e37_79b1).wrapping_add(key >> 8) & mask;
    let second = (first ^ first >> fineness).wrapping_mul(0x85eb_ca6b).wrapping_add(key >> 16) & mask;
    (second ^ second >> fineness).wrapping_mul(0xc2b2_ae35) & mask
}

/// Which number [`shuffle`] made this of.
pub fn unshuffle(shuffled: u32, fineness: u32, key: u32) -> u32 {
    let mask = (1 << (2 * fineness)) - 1;
    // Newton's iteration doubles the bits that are right, of which an odd number by itself has three.
    let inverse = |factor: u32| (0..4).fold(factor, |x, _| x.wrapping_mul(2u32.wrapping_sub(factor.wrapping_mul(x))));
    let third = shuffled.wrapping_mul(inverse(0xc2b2_ae35)) & mask;
    let second = (third ^ third >> fineness).wrapping_sub(key >> 16).wrapping_mul(inverse(0x85eb_ca6b)) & mask;
    let first = (second ^ second >> fineness).wrapping_sub(key >> 8).wrapping_mul(inverse(0x9e37_79b1)) & mask;
    (first ^ key) & mask
}

/// Axes of the plane that the lattice lies in, by the surface's normal in the rest pose.
pub fn chart(normal: DVec3) -> u32 {
    let size = normal.abs();
    if size.x > size.y.max(size.z) {
        0
    } else if size.y > size.z {
        1
    } else {
        2
    }
}

/// A vector in that plane.
pub fn in_chart(vector: DVec3, chart: u32) -> DVec2 {
    let following = [DVec3::Y, DVec3::Z, DVec3::X];
    let after = [DVec3::Z, DVec3::X, DVec3::Y];
    DVec2::new(vector.dot(following[chart as usize]), vector.dot(after[chart as usize]))
}

/// The edges of a rhombus, in a plane.
pub fn edges() -> DMat2 {
    DMat2::from_cols(DVec2::X, DVec2::new(0.5, 0.75f64.sqrt()))
}

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

/// First level whose single flakes are seen by a kernel that reaches so far, and their share and that of the next level.
pub fn levels(reach: f64, fineness: u32) -> (u32, f64, f64) {
    let level = (2.0 * reach).max(1e-6).log2() - f64::from(fineness);
    let first = level.ceil().clamp(0.0, LAST_LEVEL);
    // The next level takes over within the last half octave. a + b / 2 <= 1, so that nothing is negative, and a^2 + b^2,
    // the variance, is 1 where that allows.
    let b = (2.0 * (level - first) + 1.0).clamp(0.0, 1.0);
    let a = (1.0 - 0.5 * b).min((1.0 - b * b).sqrt());
    let share = 0.5f64.powf(first) * (LAST_LEVEL - level).clamp(0.0, 1.0);
    (first as u32, a * share, 0.5 * b * share)
}

/// What chooses a tile's shuffle (second) and moves its normals (first: two halves of a word).
pub fn seed(tile: IVec2, stream: u32) -> [u32; 2] {
    let [x, y, z] = hash::pcg3d([tile.x as u32, tile.y as u32, stream + 128]);
    [x & 0xffff_0000 | y >> 16, z]
}

/// The four tiles of one level around a pixel.
#[derive(Debug, Clone, Copy)]
pub struct Tiles {
    /// Of them the lowest along both edges.
    pub first: IVec2,
    /// Of random numbers: level and chart.
    pub stream: u32,
    /// Each flake stands for 4^level.
    pub level: u32,
    /// Of the first, one right, one up, both.
    pub seeds: [[u32; 2]; 4],
}

/// From the first tile to each.
const STEPS: [IVec2; 4] = [IVec2::ZERO, IVec2::X, IVec2::Y, IVec2::ONE];

impl Tiles {
    /// Those that a kernel in that rhombus may reach.
    pub fn new(cell: IVec2, fineness: u32, level: u32, chart: u32) -> Self {
        let size = f64::from(1u32 << (fineness + level));
        let first = (cell.as_dvec2() / size - 0.5).floor().as_ivec2();
        let stream = chart * 16 + level;
        Self { first, stream, level, seeds: STEPS.map(|step| seed(first + step, stream)) }
    }
}

/// How far a tile's normals are moved, in sides of the square.
pub fn shift(seed: [u32; 2]) -> DVec2 {
    DVec2::new(f64::from(seed[0] >> 16), f64::from(seed[0] & 0xffff)) / 65536.0
}

/// The profile of a lobe, of squared distance u; its mean over the disc u <= 1 is 1.
pub fn lobe_profile(u: f64) -> f64 {
    3.0 * (1.0 - u).max(0.0).powi(2)
}

/// Tint times weight of the flake of one tile whose lobe may hold the half vector at `square`.
pub fn tile(
    flakes: &Flakes,
    footprint: &Footprint,
    tile: IVec2,
    (level, stream): (u32, u32),
    seed: [u32; 2],
    square: DVec2,
    lobe: f64,
) -> DVec3 {
    let cells = f64::from(1u32 << flakes.fineness);
    let place = (0.5 * square + shift(seed)).fract_gl() * cells;
    let cell = place.floor().min(DVec2::splat(cells - 1.0));
    let u = (place - cell - 0.5).length_squared() / (lobe * lobe);
    let number = shuffle(cell.x as u32 + ((cell.y as u32) << flakes.fineness), flakes.fineness, seed[1]);
    let in_tile = IVec2::new((number % (1 << flakes.fineness)) as i32, (number >> flakes.fineness) as i32);
    let (tint, weight) = flake(flakes, footprint, (tile << flakes.fineness) + in_tile, level, stream);
    let area = 4f64.powi((flakes.fineness + level) as i32);
    tint * weight * area * lobe_profile(u) / (PI * lobe * lobe)
}

/// Radius of the lobe, in cells, where the half vector's place in the square varies within the pixel.
pub fn lobe(flakes: &Flakes, spread: f64) -> f64 {
    let cells = 0.5 * f64::from(1u32 << flakes.fineness);
    (f64::from(flakes.lobe).powi(2) + spread.min(8.0) * cells * cells).sqrt()
}

/// Mean tint.
pub fn mean_tint(flakes: &Flakes) -> f64 {
    1.0 - 0.5 * f64::from(flakes.variation)
}

/// The factor on the smooth lobe, of the flakes of one level alone.
pub fn level(flakes: &Flakes, footprint: &Footprint, tiles: &Tiles, square: DVec2, lobe: f64) -> DVec3 {
    let streams = (tiles.level, tiles.stream);
    let all = STEPS.iter().zip(tiles.seeds);
    all.map(|(step, seed)| tile(flakes, footprint, tiles.first + *step, streams, seed, square, lobe)).sum()
}

/// A flake that a pixel may show as a disc.
#[derive(Debug, Clone, Copy)]
pub struct Disc {
    /// Tint times weight.
    pub tinted: DVec3,
    /// Share of area over the mean share.
    pub weight: f64,
    /// Where its normal lies.
    pub square: DVec2,
}

/// The flake at a place of the lattice.
pub fn disc(flakes: &Flakes, footprint: &Footprint, place: IVec2, chart: u32) -> Disc {
    let (tint, weight) = flake(flakes, footprint, place, 0, chart * 16);
    let side = 1 << flakes.fineness;
    let (tile, at) = (place.div_euclid(IVec2::splat(side)), place.rem_euclid(IVec2::splat(side)).as_uvec2());
    let seed = seed(tile, chart * 16);
    let number = unshuffle(at.x + at.y * side as u32, flakes.fineness, seed[1]);
    let cell = DVec2::new(f64::from(number % side as u32), f64::from(number / side as u32)) + 0.5;
    let moved = cell / f64::from(side) - shift(seed);
    let square = 2.0 * (moved - (moved + 0.5).floor());
    Disc { tinted: tint * weight, weight, square }
}

/// The flakes that a pixel may show as discs.
pub fn discs(flakes: &Flakes, footprint: &Footprint, chart: u32) -> [Disc; 4] {
    let first = footprint.cell + (footprint.within - 0.5).floor().as_ivec2();
    STEPS.map(|step| disc(flakes, footprint, first + step, chart))
}

/// How well a pixel tells discs apart, [0, 1].
pub fn apart(footprint: &Footprint) -> f64 {
    ((0.45 - footprint.blur) * 4.0).clamp(0.0, 1.0)
}

/// Tint and share of area of the flakes in a pixel over their mean share; no more than all of it.
pub fn cover(flakes: &Flakes, discs: &[Disc; 4], apart: f64) -> (DVec3, f64) {
    let weight: f64 = discs.iter().map(|disc| disc.weight).sum();
    let mean_share = PI * f64::from(flakes.radius).powi(2) / edges().determinant();
    let left = 1.0 / (mean_share * weight).max(1.0);
    let tinted = discs.iter().map(|disc| disc.tinted).sum::<DVec3>() * left;
    (DVec3::splat(mean_tint(flakes)).lerp(tinted, apart), 1.0 + (weight * left - 1.0) * apart)
}

/// Tint times weight of a disc whose lobe holds the half vector.
pub fn disc_flash(flakes: &Flakes, disc: &Disc, square: DVec2, lobe: f64) -> DVec3 {
    let cells = f64::from(1u32 << flakes.fineness);
    let way = 0.5 * (square - disc.square);
    let u = ((way - (way + 0.5).floor()) * cells / lobe).length_squared();
    disc.tinted * lobe_profile(u) * cells * cells / (PI * lobe * lobe)
}

/// The factor on the smooth lobe in a pixel that tells discs apart.
pub fn discs_flash(flakes: &Flakes, discs: &[Disc; 4], square: DVec2, lobe: f64) -> DVec3 {
    let seen = lobe.min(0.5 * f64::from(1u32 << flakes.fineness));
    let sum = discs.iter().map(|disc| disc_flash(flakes, disc, square, seen)).sum();
    DVec3::splat(mean_tint(flakes)).lerp(sum, seen / lobe)
}

/// The factor on the smooth lobe in a pixel that sees levels of tiles, each with its share.
pub fn tiles_flash(flakes: &Flakes, footprint: &Footprint, levels: &[(f64, Tiles)], square: DVec2, lobe: f64) -> DVec3 {
    let seen = lobe.min(0.5);
    let mean = DVec3::splat(mean_tint(flakes));
    let off_mean = |tiles: &Tiles| level(flakes, footprint, tiles, square, seen) - mean;
    mean + seen / lobe * levels.iter().map(|(share, tiles)| *share * off_mean(tiles)).sum::<DVec3>()
}

/// log2 of the cells along the square of normals, so few that a lobe of that radius, in cells of the finest, fits in one.
pub fn fineness(flakes: &Flakes, lobe: f64) -> u32 {
    // Rounding must not halve a square whose lobe just fits.
    (0..=flakes.fineness)
        .rev()
        .find(|fineness| lobe * 0.5f64.powi((flakes.fineness - fineness) as i32) <= 0.50004)
        .unwrap_or(0)
}

/// The factor on the smooth lobe in a pixel; `spread` as in [`lobe`].
pub fn flash(flakes: &Flakes, footprint: &Footprint, chart: u32, square: DVec2, spread: f64) -> DVec3 {
    let lobe = lobe(flakes, spread);
    if apart(footprint) > 0.0 {
        return discs_flash(flakes, &discs(flakes, footprint, chart), square, lobe);
    }
    let seen = Flakes { fineness: fineness(flakes, lobe), ..*flakes };
    let (first, near, far) = levels(footprint.reach, seen.fineness);
    let tiles = |level| Tiles::new(footprint.cell, seen.fineness, level, chart);
    let in_cells = lobe * 0.5f64.powi((flakes.fineness - seen.fineness) as i32);
    tiles_flash(&seen, footprint, &[(near, tiles(first)), (far, tiles(first + 1))], square, in_cells)
}

/// The smooth lobe times the cosine of `l`: compensated GGX of metal of that colour.
pub fn smooth_times_cosine(color: DVec3, compensation: DVec3, alpha: f64, v: DVec3, l: DVec3) -> DVec3 {
    let h = ggx::half_vector(v, l);
    let lobe = ggx::ndf(h, alpha, alpha) * ggx::masking_shadowing_times_cosine(v, l, alpha, alpha);
    color.map(|f0| ggx::schlick(f0, v.dot(h))) * compensation * lobe
}

/// Flakes over a standard surface.
#[derive(Debug, Clone, Copy)]
pub struct Covered {
    /// The cloth under them.
    pub cloth: standard::Surface,
    /// Linear reflectance of the flakes' metal.
    pub color: DVec3,
    /// Perceptual, of the lobe that all flakes make up.
    pub roughness: f64,
    /// Mean share of the cloth that they cover.
    pub coverage: f64,
    /// Share of its light that a flake gives back.
    pub intensity: f64,
}

impl Covered {
    /// Share of the cloth that shows, where flakes cover that share of their mean.
    fn bare(&self, cover: f64) -> f64 {
        1.0 - (self.coverage * cover).min(1.0)
    }

    /// BRDF times `mu_l` in a pixel of that cover and flash; 0 where a direction is at or below the horizon.
    pub fn brdf_times_cosine(&self, fit: &Fit, v: DVec3, l: DVec3, cover: f64, flash: DVec3) -> DVec3 {
        let metal = standard::Surface { base_color: self.color, metallic: 1.0, roughness: self.roughness };
        let compensation = metal.specular_compensation(fit, v.z);
        let lobe = smooth_times_cosine(self.color, compensation, ggx::alpha_of_roughness(self.roughness), v, l);
        self.cloth.brdf_times_cosine(fit, v, l) * self.bare(cover) + lobe * flash * self.coverage * self.intensity
    }

    /// Radiance under constant white radiance 1, of a pixel that flakes cover so and with that tint.
    pub fn ambient(&self, fit: &Fit, mu_v: f64, (tint, cover): (DVec3, f64)) -> DVec3 {
        let metal = self.color.map(|f0| fit.compensated_albedo(f0, mu_v, self.roughness));
        self.cloth.ambient(fit, mu_v) * self.bare(cover) + metal * tint * self.coverage * self.intensity
    }
}
