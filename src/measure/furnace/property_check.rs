//! Property checks: a value of a formula that must not exceed a limit, and the search for the inputs that break it.

use super::Property;
use crate::material::ParameterSet;
use crate::measure::twin::hash;
use rayon::prelude::*;

/// One number that a check's value depends on.
#[derive(Debug, Clone)]
pub struct Input {
    /// Name, with its unit.
    pub name: &'static str,
    /// Smallest and largest value.
    pub range: (f64, f64),
    /// The values that are combined with those of all other inputs: the corners of the range and what lies between.
    pub corners: Vec<f64>,
    /// Random values crowd towards 0 as those of a logarithm do.
    pub grazing: bool,
}

impl Input {
    /// Between two ends; the middle counts as a corner, as defects like to sit there.
    pub fn between(name: &'static str, (low, high): (f64, f64)) -> Self {
        Self { name, range: (low, high), corners: vec![low, 0.5 * (low + high), high], grazing: false }
    }

    /// A parameter over the range that its family declares.
    ///
    /// # Panics
    /// If the family declares no such parameter.
    pub fn of<F: ParameterSet>(name: &'static str) -> Self {
        Self::between(name, F::parameter(name).expect("the family declares the parameter").range)
    }

    /// A cosine in (0, 1], from the most grazing one that the renderer evaluates.
    pub fn cosine(name: &'static str) -> Self {
        Self { name, range: (1e-3, 1.0), corners: vec![1e-3, 0.01, 0.05, 0.2, 0.5, 1.0], grazing: true }
    }

    /// A cosine in [-1, 1].
    pub fn signed_cosine(name: &'static str) -> Self {
        Self { corners: vec![-1.0, -0.3, 0.0, 0.05, 0.5, 1.0], ..Self::between(name, (-1.0, 1.0)) }
    }

    /// A turn around the normal, in degrees.
    pub fn turn(name: &'static str) -> Self {
        Self { corners: vec![0.0, 90.0, 180.0], ..Self::between(name, (0.0, 360.0)) }
    }

    fn random(&self, share: f64) -> f64 {
        let (low, high) = self.range;
        if self.grazing { low * (high / low).powf(share) } else { low + (high - low) * share }
    }
}

/// A number from one number an input.
pub type Measure = Box<dyn Fn(&[f64]) -> f64 + Send + Sync>;

/// A check of one formula: a value that must not exceed a limit, whatever the inputs.
pub struct PropertyCheck {
    /// Whose formula.
    pub material: &'static str,
    /// What is checked.
    pub property: &'static str,
    /// A formula of older engines: its verdict is shown and decides nothing.
    pub classic: bool,
    /// Largest value that keeps the promise; none: the value is recorded, and nothing is promised.
    pub limit: Option<f64>,
    /// What the value depends on.
    pub inputs: Vec<Input>,
    /// The value.
    pub value: Measure,
}

impl std::fmt::Debug for PropertyCheck {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PropertyCheck")
            .field("material", &self.material)
            .field("property", &self.property)
            .field("classic", &self.classic)
            .field("limit", &self.limit)
            .field("inputs", &self.inputs)
            .finish_non_exhaustive()
    }
}

impl PropertyCheck {
    /// That a formula of ours never gives more than `limit`.
    pub fn ours(
        material: &'static str,
        property: &'static str,
        limit: f64,
        inputs: Vec<Input>,
        value: Measure,
    ) -> Self {
        Self { material, property, classic: false, limit: Some(limit), inputs, value }
    }

    /// The worst value over all corners and `random` seeded points. A value that is not finite breaks every promise.
    pub fn judge(&self, random: usize) -> Property {
        let corners: usize = self.inputs.iter().map(|input| input.corners.len()).product();
        let samples = corners + random;
        let (worst, at, nonfinite) = (0..samples)
            .into_par_iter()
            .map(|index| {
                let value = (self.value)(&self.point(index, corners));
                if value.is_finite() { (value, index, 0) } else { (f64::NEG_INFINITY, index, 1) }
            })
            .reduce(
                || (f64::NEG_INFINITY, usize::MAX, 0),
                |a, b| {
                    // Of equals the first, so that every run tells the same.
                    let (worst, at) = if (b.0, a.1) > (a.0, b.1) { (b.0, b.1) } else { (a.0, a.1) };
                    (worst, at, a.2 + b.2)
                },
            );
        let finite = worst.is_finite();
        let names = self.inputs.iter().map(|input| input.name);
        Property {
            material: self.material,
            property: self.property,
            classic: self.classic,
            worst: if finite { worst } else { f64::MAX },
            at: names.zip(if finite { self.point(at, corners) } else { Vec::new() }).collect(),
            limit: self.limit,
            samples,
            nonfinite,
            pass: finite && nonfinite == 0 && self.limit.is_none_or(|limit| worst <= limit),
        }
    }

    /// The inputs of one sample: the corners first, then random points.
    fn point(&self, index: usize, corners: usize) -> Vec<f64> {
        let mut rest = index;
        let coordinate = |(place, input): (usize, &Input)| {
            if index < corners {
                let corner = input.corners[rest % input.corners.len()];
                rest /= input.corners.len();
                corner
            } else {
                input.random(hash::cell([index as i32, place as i32, 0])[0])
            }
        };
        self.inputs.iter().enumerate().map(coordinate).collect()
    }
}
