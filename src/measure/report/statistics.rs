//! What many measurements say: medians and how sure they are, slopes, and fronts.

use crate::measure::profile;

/// Resamples of a bootstrap: the ends of a 95 % interval are then good to about a hundredth of its rank.
const RESAMPLES: usize = 1000;

/// Times of one thing, measured several times.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Spread {
    /// Middle value.
    pub median: f64,
    /// Smallest.
    pub min: f64,
    /// Largest.
    pub max: f64,
    /// 95 % interval of the median (Efron 1979, "Bootstrap Methods: Another Look at the Jackknife", by percentiles).
    pub interval: [f64; 2],
}

impl Spread {
    /// Of at least one finite value; all zero without any. The same values give the same interval.
    pub fn of(values: &[f64]) -> Self {
        let Some(profile::Spread { median, min, max, .. }) = profile::Spread::of(values) else {
            return Self::default();
        };
        // Sorted, so that the same values in another order give the same interval.
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        let mut state = 1u64;
        let mut medians: Vec<f64> = (0..RESAMPLES)
            .filter_map(|_| {
                let resample: Vec<f64> = sorted.iter().map(|_| sorted[below(sorted.len(), &mut state)]).collect();
                profile::Spread::of(&resample).map(|spread| spread.median)
            })
            .collect();
        medians.sort_by(f64::total_cmp);
        let interval = [0.025, 0.975].map(|share| medians[(share * (RESAMPLES - 1) as f64).round() as usize]);
        Self { median, min, max, interval }
    }
}

/// A number in [0, count); xorshift64 (Marsaglia 2003, "Xorshift RNGs").
fn below(count: usize, state: &mut u64) -> usize {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    ((*state >> 33) % count as u64) as usize
}

/// Slope of log y over log x by least squares; `None` with fewer than three points above 0, since two fit any line, or
/// where x stands still.
pub fn log_log_slope(points: &[[f64; 2]]) -> Option<f64> {
    let logs: Vec<[f64; 2]> =
        points.iter().filter(|point| point.iter().all(|v| *v > 0.0)).map(|point| point.map(f64::ln)).collect();
    if logs.len() < 3 {
        return None;
    }
    let mean = |axis: usize| logs.iter().map(|log| log[axis]).sum::<f64>() / logs.len() as f64;
    let [x, y] = [mean(0), mean(1)];
    let squares: f64 = logs.iter().map(|log| (log[0] - x).powi(2)).sum();
    let products: f64 = logs.iter().map(|log| (log[0] - x) * (log[1] - y)).sum();
    let slope = products / squares;
    slope.is_finite().then_some(slope)
}

/// Which points (cost, error) no other one beats: none is at most as dear and as wrong, and less of one of them.
pub fn pareto_front(points: &[[f64; 2]]) -> Vec<bool> {
    let beats = |a: &[f64; 2], b: &[f64; 2]| a[0] <= b[0] && a[1] <= b[1] && a != b;
    points.iter().map(|point| !points.iter().any(|other| beats(other, point))).collect()
}
