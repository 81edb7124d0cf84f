//! The points of one method before one camera, in the order of its knob.

use super::feature::{Feature, Point};
use super::statistics::log_log_slope;

/// The points of one method before one camera.
#[derive(Debug, Clone)]
pub struct Curve<'a> {
    /// Method.
    pub method: &'static str,
    /// What others do.
    pub is_classic: bool,
    /// In the order of the knob.
    pub points: Vec<&'a Point>,
}

impl Curve<'_> {
    /// (milliseconds, error) of each point.
    pub fn cost_and_error(&self) -> Vec<[f64; 2]> {
        self.points.iter().map(|point| [point.ms.median, point.relmse]).collect()
    }

    /// Slope of log error over log ms.
    pub fn slope_over_ms(&self) -> Option<f64> {
        log_log_slope(&self.cost_and_error())
    }

    /// Slope of log error over the log of the knob: shells, or steps a second.
    pub fn slope_over_knob(&self) -> Option<f64> {
        let points: Vec<_> = self.points.iter().map(|point| [f64::from(point.knob.1), point.relmse]).collect();
        log_log_slope(&points)
    }
}

impl Feature {
    /// Cameras, in the order of their first point.
    pub fn cameras(&self) -> Vec<&'static str> {
        let mut cameras = Vec::new();
        for point in &self.points {
            if !cameras.contains(&point.camera) {
                cameras.push(point.camera);
            }
        }
        cameras
    }

    /// The curves before one camera.
    pub fn curves(&self, camera: &str) -> Vec<Curve<'_>> {
        let mut curves: Vec<Curve> = Vec::new();
        for point in self.points.iter().filter(|point| point.camera == camera) {
            match curves.iter_mut().find(|curve| curve.method == point.method) {
                Some(curve) => curve.points.push(point),
                None => {
                    let (method, is_classic) = (point.method, point.is_classic);
                    curves.push(Curve { method, is_classic, points: vec![point] });
                }
            }
        }
        for curve in &mut curves {
            curve.points.sort_by_key(|point| point.knob.1);
        }
        curves
    }
}
