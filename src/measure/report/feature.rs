//! From measurements to points, features and the report.

use super::case::Cases;
use super::dynamics::{self, Integrator, STRAND_KINDS, STRANDS};
use super::measurement::{FrameMs, Measurement, Measurements};
use super::metric::PictureError;
use super::statistics::{Spread, pareto_front};
use super::summary::Summary;
use super::sweep::{Method, Sweep, SweepPoint};
use super::{Effort, View};
use crate::gpu::{DeviceInfo, DeviceKind};
use crate::measure::furnace::{self, Property};
use std::time::{SystemTime, UNIX_EPOCH};

/// The reference's noise should be at most this share of an error that is compared with it.
const NOISE_SHARE: f64 = 0.1;
/// Rates of the dynamics sweep, steps a second.
const STEPS_HZ: [u32; 6] = [30, 60, 120, 240, 480, 960];

/// What times are taken by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Clock {
    /// The device's timestamps around the opaque, fur and transparent passes.
    Device,
    /// The wall clock around the whole frame: the device has no timestamps.
    Wall,
}

/// One method with one setting of its knob before one camera.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Method.
    pub method: &'static str,
    /// What others do.
    pub is_classic: bool,
    /// The knob that is turned, and its setting.
    pub knob: (&'static str, u32),
    /// Camera; of the dynamics, the strand.
    pub camera: &'static str,
    /// Milliseconds by the report's clock.
    pub ms: Spread,
    /// Milliseconds of the whole frame by the wall clock.
    pub wall_ms: Spread,
    /// Relative mean squared error.
    pub relmse: f64,
    /// Mean FLIP; `None` where there is no picture.
    pub flip: Option<f64>,
    /// Largest error, where there is no picture: distance in amplitudes of the root.
    pub max_error: Option<f64>,
    /// No other point before this camera is at once as fast and as right.
    pub is_on_front: bool,
    /// The reference's own noise is more than a tenth of the error: the true error may be smaller.
    pub is_at_floor: bool,
}

impl Point {
    /// Without an error yet, taken by one clock.
    pub fn new(method: &'static str, knob: (&'static str, u32), camera: &'static str, ms: Spread) -> Self {
        Self {
            method,
            is_classic: false,
            knob,
            camera,
            ms,
            wall_ms: ms,
            relmse: 0.0,
            flip: None,
            max_error: None,
            is_on_front: false,
            is_at_floor: false,
        }
    }

    /// Of frames whose picture has that error.
    pub fn of_frames(
        method: &'static str,
        knob: (&'static str, u32),
        camera: &'static str,
        (frames, clock): (&[FrameMs], Clock),
        error: PictureError,
    ) -> Self {
        Self {
            wall_ms: spread_of(frames, Clock::Wall),
            relmse: error.relmse,
            flip: Some(error.flip),
            ..Self::new(method, knob, camera, spread_of(frames, clock))
        }
    }
}

/// What one sweep found.
#[derive(Debug, Clone, PartialEq)]
pub struct Feature {
    /// Name.
    pub name: &'static str,
    /// What errors are taken against.
    pub reference: String,
    /// relMSE of the reference's noise: the largest of its views.
    pub reference_noise: f64,
    /// All points.
    pub points: Vec<Point>,
    /// What is not plotted, and why.
    pub notes: Vec<String>,
}

/// Everything that was measured, and under which conditions.
#[derive(Debug, Clone)]
pub struct Report {
    /// The device.
    pub device: DeviceInfo,
    /// Day of the run, UTC, `2001-02-03`.
    pub date: String,
    /// Threads that the host offers.
    pub threads: usize,
    /// Pixels of the pictures of the knot, and of the swatch.
    pub sizes: [[u32; 2]; 2],
    /// Rounds of timing.
    pub rounds: usize,
    /// What times are taken by.
    pub clock: Clock,
    /// Shells of the fur's own material.
    pub default_layers: u32,
    /// What the sweeps found.
    pub features: Vec<Feature>,
    /// The three figures.
    pub summary: Summary,
    /// What the formulas promise, and those of older engines beside them.
    pub furnace: Vec<Property>,
}

impl Report {
    pub(super) fn new(
        device: &DeviceInfo,
        sweeps: &[Sweep],
        cases: &Cases,
        measurements: &Measurements,
        effort: &Effort,
    ) -> Self {
        let mut frames = measurements.by_point.values().flat_map(|measurement| &measurement.frames);
        let clock = if frames.all(|frame| frame.passes.is_some()) { Clock::Device } else { Clock::Wall };
        let mut features: Vec<Feature> =
            sweeps.iter().map(|sweep| picture_feature(sweep, measurements, effort, clock)).collect();
        features.push(dynamics_feature(effort));
        Self {
            device: device.clone(),
            date: date(SystemTime::now()),
            threads: std::thread::available_parallelism().map_or(1, usize::from),
            sizes: [effort.size, effort.swatch_size],
            rounds: measurements.rounds,
            clock,
            default_layers: cases.default_layers,
            summary: Summary::new(sweeps, measurements, clock, cases.default_layers),
            features,
            furnace: furnace::run(effort.furnace_points),
        }
    }

    /// Whether the device is a program on the host's processor.
    pub fn is_on_processor(&self) -> bool {
        self.device.kind == DeviceKind::Cpu
    }
}

/// Every point of a sweep.
pub fn sweep_points(sweep: &Sweep) -> Vec<SweepPoint> {
    points(sweep).into_iter().map(|(method, layers, view)| SweepPoint::new(method, layers, view)).collect()
}

fn points(sweep: &Sweep) -> Vec<(&Method, u32, View)> {
    let mut points = Vec::new();
    for &view in &sweep.views {
        for method in &sweep.methods {
            points.extend(sweep.layers_of(method).into_iter().map(|layers| (method, layers, view)));
        }
    }
    points
}

/// Milliseconds of a measurement by a clock.
pub fn spread(measurement: &Measurement, clock: Clock) -> Spread {
    spread_of(&measurement.frames, clock)
}

/// Milliseconds of frames by a clock.
fn spread_of(frames: &[FrameMs], clock: Clock) -> Spread {
    let ms = |frame: &FrameMs| match clock {
        Clock::Device => frame.passes.unwrap_or(frame.wall),
        Clock::Wall => frame.wall,
    };
    Spread::of(&frames.iter().map(ms).collect::<Vec<_>>())
}

fn picture_feature(sweep: &Sweep, measurements: &Measurements, effort: &Effort, clock: Clock) -> Feature {
    let noise_of = |view| measurements.noise.get(&view).copied().unwrap_or_default();
    let mut all = Vec::new();
    for (method, layers, view) in points(sweep) {
        let Some(measurement) = measurements.by_point.get(&SweepPoint::new(method, layers, view)) else { continue };
        let Some(error) = measurement.error else { continue };
        let frames = (&measurement.frames[..], clock);
        all.push(Point {
            is_classic: method.is_classic,
            is_at_floor: noise_of(view) > NOISE_SHARE * error.relmse,
            ..Point::of_frames(method.name, ("layers", layers), view.name(), frames, error)
        });
    }
    mark_fronts(&mut all);
    Feature {
        name: sweep.name,
        reference: format!("fur ray-cast in double precision, {} samples a pixel", effort.reference_samples),
        reference_noise: sweep.views.iter().map(|&view| noise_of(view)).fold(0.0, f64::max),
        points: all,
        notes: Vec::new(),
    }
}

/// Marks, before each camera, the points that no other beats in both time and error.
pub fn mark_fronts(points: &mut [Point]) {
    let mut cameras: Vec<&str> = points.iter().map(|point| point.camera).collect();
    cameras.dedup();
    for camera in cameras {
        let indices: Vec<usize> = (0..points.len()).filter(|&i| points[i].camera == camera).collect();
        let costs: Vec<_> = indices.iter().map(|&i| [points[i].ms.median, points[i].relmse]).collect();
        for (index, is_on_front) in indices.into_iter().zip(pareto_front(&costs)) {
            points[index].is_on_front = is_on_front;
        }
    }
}

fn dynamics_feature(effort: &Effort) -> Feature {
    let (mut points, mut notes) = (Vec::new(), Vec::new());
    for strand in &STRAND_KINDS {
        let reference = dynamics::Reference::new(strand);
        let mut kept = Vec::new();
        for integrator in Integrator::ALL {
            for steps_hz in STEPS_HZ {
                match reference.error(integrator, strand, steps_hz) {
                    Some(error) => kept.push((integrator, steps_hz, error, Vec::new())),
                    None => notes.push(format!("{}: {} at {steps_hz} Hz diverges", strand.name, integrator.name())),
                }
            }
        }
        for round in 0..=effort.rounds {
            for (integrator, steps_hz, _, times) in &mut kept {
                let ms = dynamics::time_ms(*integrator, strand, *steps_hz);
                // The first round warms up.
                if round > 0 {
                    times.push(ms);
                }
            }
        }
        points.extend(kept.into_iter().map(|(integrator, steps_hz, error, times)| Point {
            is_classic: integrator.is_classic(),
            relmse: error.relmse,
            max_error: Some(error.max),
            ..Point::new(integrator.name(), ("steps_hz", steps_hz), strand.name, Spread::of(&times))
        }));
    }
    mark_fronts(&mut points);
    Feature {
        name: "dynamics",
        reference: format!(
            "exact solution at 1/256 of the finest step; ms of one host thread for one second of {STRANDS} strands"
        ),
        reference_noise: 0.0,
        points,
        notes,
    }
}

/// Day of a time, UTC, in the Gregorian calendar (Fliegel & Van Flandern 1968, "A Machine Algorithm for Processing
/// Calendar Dates").
fn date(time: SystemTime) -> String {
    let days = time.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs() / 86_400) as i64;
    // Julian day of 1970-01-01.
    let mut l = days + 2_440_588 + 68_569;
    let n = 4 * l / 146_097;
    l -= (146_097 * n + 3) / 4;
    let i = 4000 * (l + 1) / 1_461_001;
    l -= 1461 * i / 4 - 31;
    let j = 80 * l / 2447;
    let day = l - 2447 * j / 80;
    l = j / 11;
    format!("{:04}-{:02}-{:02}", 100 * (n - 49) + i + l, j + 2 - 12 * l, day)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn days_are_those_of_the_calendar() {
        for (seconds, expected) in
            [(0, "1970-01-01"), (951_782_400, "2000-02-29"), (951_868_800, "2000-03-01"), (1_767_225_599, "2025-12-31")]
        {
            assert_eq!(date(UNIX_EPOCH + Duration::from_secs(seconds)), expected);
        }
    }
}
