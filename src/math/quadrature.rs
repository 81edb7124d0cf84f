//! Quadrature.

use std::f64::consts::PI;

/// Newton's iteration takes about five; more only where rounding keeps it from settling.
const MOST_STEPS: u32 = 100;

/// Nodes and weights of Gauss-Legendre quadrature on [0, 1] with `count` points: exact for polynomials of degrees below
/// `2 count`. Newton's iteration on the Legendre polynomial from Tricomi's estimate of its roots.
pub fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    let n = count as f64;
    // The polynomial and its slope, by Bonnet's recurrence.
    let legendre = |x: f64| {
        let step = |(p, previous): (f64, f64), j: usize| {
            let j = j as f64;
            (((2.0 * j + 1.0) * x * p - j * previous) / (j + 1.0), p)
        };
        let (p, previous) = (0..count).fold((1.0, 0.0), step);
        (p, n * (x * p - previous) / (x * x - 1.0))
    };
    let point = |index: usize| {
        let (mut x, mut slope) = ((PI * (index as f64 + 0.75) / (n + 0.5)).cos(), 1.0);
        for _ in 0..MOST_STEPS {
            let p;
            (p, slope) = legendre(x);
            let step = p / slope;
            x -= step;
            if step.abs() < 1e-15 {
                break;
            }
        }
        (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..count).map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_integrated_exactly() {
        for (count, power) in [(1, 1), (4, 7), (64, 127), (128, 200)] {
            let integral: f64 = gauss_legendre(count).iter().map(|&(x, weight)| weight * x.powi(power)).sum();
            assert!((integral * f64::from(power + 1) - 1.0).abs() < 1e-13, "{count} points, power {power}");
        }
    }
}
