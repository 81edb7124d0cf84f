//! Twin of `coverage.glsl`: opacity to samples.

/// Samples of four that an opacity covers at a pixel of the 2x2 pattern.
pub fn count(opacity: f64, pixel: [u32; 2]) -> u32 {
    let index = (pixel[0] & 1) + 2 * ((pixel[0] ^ pixel[1]) & 1);
    ((opacity.clamp(0.0, 1.0) * 4.0 + (f64::from(index) + 0.5) / 4.0).floor() as u32).min(4)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_pixels_keep_the_mean() {
        for step in 0..=100 {
            let opacity = f64::from(step) / 100.0;
            let covered: u32 = (0..4).map(|index| count(opacity, [index & 1, index >> 1])).sum();
            assert!((f64::from(covered) / 16.0 - opacity).abs() <= 1.0 / 32.0 + 1e-12, "{covered} of 16 for {opacity}");
        }
        assert_eq!(count(0.0, [1, 0]), 0);
        assert_eq!(count(1.0, [0, 0]), 4);
    }
}
