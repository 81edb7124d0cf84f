//! Fits the bands by which a thin film's colour is evaluated and prints the text that stands between `// fit: begin` and
//! `// fit: end` in `shaders_glsl/lib/film.glsl`: `cargo run --example fit_film`.
//!
//! What a channel answers to a difference of path is the cosine transform of its sensitivity over wavenumbers (Belcour &
//! Barla 2017). Four Gaussians that all channels share stand for it: their weights follow by linear least squares, their
//! centres and widths by pattern search (Hooke & Jeeves 1961).

use glam::{DMat4, DVec3, DVec4};
use std::f64::consts::TAU;
use vair::measure::twin::film::{BANDS, color_of};

/// Costs as much as this error at one path for a weight of 1: without, two equal bands grow apart and cancel.
const WEIGHT_COST: f64 = 0.02;
/// Paths that the fit knows: beyond, nothing interferes any more.
const LONGEST_PATH_UM: f64 = 5.0;
const PATHS: u32 = 500;

/// Centres, then widths, 1 / um.
type Bands = [f64; 2 * BANDS];

fn main() {
    let path_um = |step| LONGEST_PATH_UM * f64::from(step) / f64::from(PATHS);
    let answer = |path_um: f64| (path_um, color_of(|wavelength_nm| (TAU * path_um * 1e3 / wavelength_nm).cos()));
    let truth: Vec<_> = (0..=PATHS).map(path_um).map(answer).collect();

    // 606, 571, 541 and 455 nm, as wide as the matching functions are.
    let mut bands: Bands = [1.65, 1.75, 1.85, 2.20, 0.08, 0.08, 0.08, 0.08];
    let (mut cost, mut step) = (fitted(&bands, &truth).1, 0.02);
    while step > 1e-6 {
        let before = cost;
        for at in 0..bands.len() {
            for sign in [1.0, -1.0] {
                let mut moved = bands;
                moved[at] += sign * step;
                let moved_cost = fitted(&moved, &truth).1;
                if moved_cost < cost {
                    (bands, cost) = (moved, moved_cost);
                }
            }
        }
        // A step that gains little is too coarse, or done.
        if cost > before * (1.0 - 1e-6) {
            step *= 0.5;
        }
    }
    print(&bands, fitted(&bands, &truth).0);
    eprintln!("root mean square error {:.4}", (cost / f64::from(3 * PATHS)).sqrt());
}

fn answers(bands: &Bands, path_um: f64) -> DVec4 {
    let answer = |band: usize| {
        let spread = TAU * path_um * bands[BANDS + band];
        (-0.5 * spread * spread).exp() * (TAU * path_um * bands[band]).cos()
    };
    DVec4::new(answer(0), answer(1), answer(2), answer(3))
}

/// Weights of each channel, and the sum of squared errors with the cost of the weights.
fn fitted(bands: &Bands, truth: &[(f64, DVec3)]) -> ([DVec4; 3], f64) {
    let outer = |a: DVec4, b: DVec4| DMat4::from_cols(a * b.x, a * b.y, a * b.z, a * b.w);
    let rows: Vec<_> = truth.iter().map(|&(path_um, color)| (answers(bands, path_um), color)).collect();
    let (mut matrix, mut right) = (DMat4::from_diagonal(DVec4::splat(WEIGHT_COST * WEIGHT_COST)), [DVec4::ZERO; 3]);
    // Without a path all bands answer 1: a heavy row, so that white stays white.
    for (row, color, weight) in
        rows.iter().map(|&(row, color)| (row, color, 1.0)).chain([(DVec4::ONE, DVec3::ONE, 1e6)])
    {
        matrix += outer(row, row) * weight;
        (0..3).for_each(|channel| right[channel] += row * (weight * color[channel]));
    }
    let inverse = matrix.inverse();
    let weights = right.map(|right| inverse * right);
    let error = |(row, color): &(DVec4, DVec3)| -> f64 {
        (0..3).map(|channel| (row.dot(weights[channel]) - color[channel]).powi(2)).sum()
    };
    let cost = weights.iter().map(|weights| WEIGHT_COST * WEIGHT_COST * weights.length_squared()).sum::<f64>();
    (weights, rows.iter().map(error).sum::<f64>() + cost)
}

fn print(bands: &Bands, weights: [DVec4; 3]) {
    let list = |numbers: &[f64]| numbers.iter().map(|number| format!("{number:.5}")).collect::<Vec<_>>().join(", ");
    println!("const vec4 FILM_WAVENUMBER = vec4({}); // 1 / um", list(&bands[..BANDS]));
    println!("const vec4 FILM_WIDTH = vec4({});      // standard deviation, 1 / um", list(&bands[BANDS..]));
    for (name, weights) in ["RED", "GREEN", "BLUE"].into_iter().zip(weights) {
        let mut digits = weights.to_array().map(|weight| (weight * 1e5).round() / 1e5);
        // What rounding took, so that the sum is 1 to the last digit.
        digits[0] += 1.0 - digits.iter().sum::<f64>();
        println!("const vec4 FILM_{name} = vec4({});", list(&digits));
    }
}
