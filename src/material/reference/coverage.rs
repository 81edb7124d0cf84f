//! Twin of `coverage.glsl`: opacity to samples.

/// Samples that an opacity covers; see the shader for `threshold`.
pub fn count(opacity: f64, sample_count: u32, threshold: f64) -> u32 {
    if sample_count == 1 {
        return u32::from(opacity > 0.0 && opacity >= threshold);
    }
    ((opacity.clamp(0.0, 1.0) * 4.0 + threshold).floor() as u32).min(4)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn random_thresholds_keep_the_mean() {
        for step in 0..=100 {
            let opacity = f64::from(step) / 100.0;
            for samples in [1, 4] {
                let covered: u32 = (0..1000).map(|index| count(opacity, samples, f64::from(index) / 1000.0)).sum();
                let mean = f64::from(covered) / f64::from(1000 * samples);
                assert!((mean - opacity).abs() < 2e-3, "{mean} for {opacity} at {samples} samples");
            }
        }
    }

    #[test]
    fn a_threshold_of_one_half_rounds() {
        assert_eq!([0.0, 0.1, 0.13, 0.5, 0.88, 1.0].map(|opacity| count(opacity, 4, 0.5)), [0, 0, 1, 2, 4, 4]);
        assert_eq!([0.0, 0.49, 0.5, 1.0].map(|opacity| count(opacity, 1, 0.5)), [0, 0, 1, 1]);
    }
}
