//! Twin of `coverage.glsl`: opacity to samples.

/// Threshold of a pixel in [0, 1) (Jimenez 2014, interleaved gradient noise).
pub fn dither(pixel: [u32; 2]) -> f64 {
    let along = f64::from(pixel[0]) * 0.06711056 + f64::from(pixel[1]) * 0.00583715;
    (52.9829189 * along.fract()).fract()
}

/// Samples of four that an opacity covers at a pixel.
pub fn count(opacity: f64, pixel: [u32; 2]) -> u32 {
    ((opacity.clamp(0.0, 1.0) * 4.0 + dither(pixel)).floor() as u32).min(4)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_keep_the_mean() {
        for step in 0..=100 {
            let opacity = f64::from(step) / 100.0;
            let covered: u32 = (0..64).map(|index| count(opacity, [300 + index % 8, 500 + index / 8])).sum();
            assert!((f64::from(covered) / 256.0 - opacity).abs() < 0.01, "{covered} of 256 for {opacity}");
        }
        assert_eq!(count(0.0, [1, 0]), 0);
        assert_eq!(count(1.0, [0, 0]), 4);
    }
}
