//! Twin of `coverage.glsl`: opacity to samples.

/// Samples that an opacity covers; see the shader for `threshold`.
pub fn count(opacity: f64, sample_count: u32, threshold: f64) -> u32 {
    if sample_count == 1 {
        return u32::from(opacity > 0.0 && opacity >= threshold);
    }
    ((opacity.clamp(0.0, 1.0) * 4.0 + threshold).floor() as u32).min(4)
}

/// Bits of four samples: the first `count` of 0, 3, 1, 2, turned by `order` in [0, 1).
pub fn mask(count: u32, order: f64) -> u32 {
    let orders = [[0, 3, 1, 2], [3, 0, 2, 1], [1, 2, 3, 0], [2, 1, 0, 3]];
    let first = [0, 1, 2, 3][(order * 4.0) as usize & 3];
    orders[first][..count as usize].iter().fold(0, |mask, sample| mask | 1 << sample)
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

    #[test]
    fn the_shaders_table_is_the_orders() {
        let shader = include_str!("../../../shaders_glsl/lib/coverage.glsl");
        let tables: Vec<u32> = shader
            .split("0x")
            .skip(1)
            .map(|rest| u32::from_str_radix(rest.split('u').next().unwrap(), 16).unwrap())
            .collect();
        assert_eq!(tables.len(), 4);
        for (index, table) in tables.iter().enumerate() {
            for count in 0..=4 {
                let expected = mask(count, (index as f64 + 0.5) / 4.0);
                assert_eq!((table >> (count * 4)) & 15, expected, "order {index}, {count} samples");
                assert_eq!(expected.count_ones(), count);
            }
        }
    }
}
