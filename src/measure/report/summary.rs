//! The three figures that sum a report up.

use super::View;
use super::feature::{Clock, spread};
use super::measurement::Measurements;
use super::statistics::Spread;
use super::sweep::{CLASSIC_LAYERS, Method, Sweep, SweepPoint};
use std::iter::once;

/// Layers that [`Summary::layers_4x_cost`] compares.
pub const LAYERS_4X: [u32; 2] = [8, 32];

/// The three figures; each is `None` where the sweeps lack its points, and the notes say why.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Summary {
    /// Milliseconds of 20 classic draws over those of our cheapest number of layers whose relMSE is no larger, before the
    /// gallery's camera.
    pub equal_error_speedup: Option<f64>,
    /// Milliseconds of the default method with the more of [`LAYERS_4X`] over those with the fewer.
    pub layers_4x_cost: Option<f64>,
    /// Milliseconds of the whole default fur with its skin over those of its outer surface drawn once, opaque, with the
    /// same fetches and lighting.
    pub vs_one_layer: Option<f64>,
    /// What a reader must know beside the figures.
    pub notes: Vec<String>,
}

/// What the summary needs beside the sweeps.
pub fn sweep_points(default_layers: u32) -> Vec<SweepPoint> {
    let ours = Method::ours();
    LAYERS_4X
        .into_iter()
        .chain(once(default_layers))
        .map(|layers| SweepPoint::new(&ours, layers, View::Gallery))
        .chain([
            SweepPoint::new(&Method::classic_draws(), CLASSIC_LAYERS, View::Gallery),
            SweepPoint::new(&ours, 1, View::OuterSurface),
        ])
        .collect()
}

impl Summary {
    pub(super) fn new(sweeps: &[Sweep], measurements: &Measurements, clock: Clock, default_layers: u32) -> Self {
        let ours = Method::ours();
        let measured =
            |method: &Method, layers| measurements.by_point.get(&SweepPoint::new(method, layers, View::Gallery));
        let ms = |layers| measured(&ours, layers).map(|measurement| spread(measurement, clock).median);
        let mut notes = Vec::new();

        let mut layers: Vec<u32> = sweeps.iter().flat_map(|sweep| sweep.layers.iter().copied()).collect();
        layers.extend(LAYERS_4X.iter().chain(once(&default_layers)));
        layers.sort_unstable();
        layers.dedup();
        let curve: Vec<(u32, [f64; 2])> = layers
            .into_iter()
            .filter_map(|layers| Some((layers, [ms(layers)?, measured(&ours, layers)?.error?.relmse])))
            .collect();
        let equal_error_speedup = measured(&Method::classic_draws(), CLASSIC_LAYERS).and_then(|classic| {
            let (classic_ms, error) = (spread(classic, clock).median, classic.error?.relmse);
            // A number of layers that can be had, not one in between.
            let good_enough = curve.iter().filter(|(_, [_, relmse])| *relmse <= error);
            match good_enough.min_by(|(_, a), (_, b)| a[0].total_cmp(&b[0])) {
                Some((layers, [ms, relmse])) => {
                    notes.push(format!(
                        "speedup: {layers} of our layers, relMSE {relmse:.4}, for 20 classic draws, {error:.4}"
                    ));
                    Some(classic_ms / ms)
                }
                None => {
                    notes.push("speedup at equal error: none of our points is as good as 20 classic draws".into());
                    None
                }
            }
        });

        let layers_4x_cost = ms(LAYERS_4X[1]).zip(ms(LAYERS_4X[0])).map(|(many, few)| many / few);
        let outer = measurements.by_point.get(&SweepPoint::new(&ours, 1, View::OuterSurface));
        let vs_one_layer = ms(default_layers).zip(outer).map(|(whole, outer)| {
            let one = outer.frames.iter().map(|frame| match clock {
                Clock::Device => frame.fur.unwrap_or(frame.wall),
                Clock::Wall => frame.wall,
            });
            whole / Spread::of(&one.collect::<Vec<_>>()).median
        });
        let finite = |figure: Option<f64>| figure.filter(|figure| figure.is_finite());
        Self {
            equal_error_speedup: finite(equal_error_speedup),
            layers_4x_cost: finite(layers_4x_cost),
            vs_one_layer: finite(vs_one_layer),
            notes,
        }
    }
}
