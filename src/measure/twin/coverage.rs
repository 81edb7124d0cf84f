//! Twin of `coverage.glsl`: opacity to samples.

use super::domain::{ALMOST_ONE, Domain, UNIT};
use super::{Limit, Rule, Twin, hash};

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

/// In [0, 1).
const SHARE: Domain = Domain::Uniform(0.0, ALMOST_ONE, &[0.0, 1e-40, 0.25, 0.5, 0.75, ALMOST_ONE]);

const LAYER: Domain = Domain::Choice(&[0, 1, 7, 255]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    // The cells of a picture 32 units wide with pixels of a micrometre still have integer numbers. log2 of such pixels
    // is rounded at 2^-20, which is 2^-20 ln 2 / 2^-24 = 11 units of the pixel's size; three more for log2 itself.
    Twin::new(
        "coverage_grain",
        &[
            Domain::Uniform(-32.0, 32.0, &[-32.0, -1.0, 0.0, 0.5, 32.0]),
            Domain::Log(1e-6, 10.0, &[1e-6, 0.25, 1.0]),
            LAYER,
        ],
        |inputs| {
            let (position, pixel_size, layer) = (inputs.vec3(), inputs.number(), inputs.uint() as i32);
            let cell_size = pixel_size.max(1e-30).log2().ceil().exp2();
            let cell = (position / cell_size).floor().to_array().map(|coordinate| coordinate as i32 + layer * 7919);
            let [_, y, z] = hash::cell(cell);
            vec![z, y]
        },
    )
    .rule(Rule::Stepped(14)),
    Twin {
        limit: Limit::EXACT,
        ..Twin::new("coverage_mask", &[UNIT, Domain::Choice(&[1, 4]), SHARE, SHARE], |inputs| {
            let (opacity, sample_count) = (inputs.number(), inputs.uint());
            let (threshold, order) = (inputs.number(), inputs.number());
            let count = count(opacity, sample_count, threshold);
            vec![f64::from(if sample_count == 1 { count } else { mask(count, order) })]
        })
        .rule(Rule::Stepped(4))
    },
];

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
