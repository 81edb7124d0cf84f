//! No material gives more light than it gets: directional albedo, normalisation, reciprocity, linearity, and darkness when
//! the lights are off, at every corner of the parameter ranges and at random points between them.
//!
//! Measured on the double-precision twins, which the device is checked against. The formulas of older engines are
//! measured beside them, and shown as what they are.

mod anisotropy;
mod classic;
mod environment_lobe;
mod fur;
mod fuzz;
mod gauze;
mod glint;
mod laser;
mod layered;
mod light;
mod occlusion;
mod property_check;
mod quadrature;
mod satin;
mod sheen;
mod standard;

pub use property_check::{Input, Measure, PropertyCheck};

use serde::{Serialize, Serializer};
use std::fmt;

/// Random points of a full run, beside the corners: as many as two processor cores try in half a minute.
pub const RANDOM_POINTS: usize = 1_000;

/// More than this share of the light must not come back: all of it, and what quadrature and fits may err by.
pub const ALBEDO_LIMIT: f64 = 1.0 + 1e-3;

/// How far one promise was kept.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Property {
    /// Whose formula.
    pub material: &'static str,
    /// What is checked.
    pub property: &'static str,
    /// A formula of older engines: shown, but [`Property::fails`] never.
    pub classic: bool,
    /// The largest finite value found; the largest number there is if none was finite.
    pub worst: f64,
    /// Names and values of the inputs that gave it.
    #[serde(serialize_with = "as_map")]
    pub at: Vec<(&'static str, f64)>,
    /// Largest value that keeps the promise; none: recorded only.
    pub limit: Option<f64>,
    /// Points tried.
    pub samples: usize,
    /// Points at which the value was not finite.
    pub nonfinite: usize,
    /// All values were finite and within the limit.
    pub pass: bool,
}

impl Property {
    /// Whether a promise of ours is broken.
    pub fn fails(&self) -> bool {
        !self.pass && !self.classic
    }
}

impl fmt::Display for Property {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = match (self.pass, self.classic, self.limit) {
            (true, _, None) => "noted",
            (true, ..) => "ok",
            (false, true, _) => "classic",
            (false, false, _) => "FAIL",
        };
        let material = if self.classic { format!("{} (classic)", self.material) } else { self.material.to_owned() };
        write!(f, "{verdict:<7} {material:<16} {:<38} {:>10}", self.property, short(self.worst))?;
        match self.limit {
            Some(limit) => write!(f, " of {:<8}", short(limit))?,
            None => write!(f, "{:12}", "")?,
        }
        let mut separator = " at ";
        for (name, value) in &self.at {
            write!(f, "{separator}{name} {}", short(*value))?;
            separator = ", ";
        }
        if self.nonfinite > 0 {
            write!(f, "; {} of {} not finite", self.nonfinite, self.samples)?;
        }
        Ok(())
    }
}

/// Four places without idle zeros, or a power of ten where that would say nothing.
pub(crate) fn short(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) {
        return format!("{value:.1e}");
    }
    ((value * 1e4).round() / 1e4).to_string()
}

fn as_map<S: Serializer>(inputs: &[(&'static str, f64)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(inputs.iter().copied())
}

/// The checks of each family, ours first.
const FAMILIES: &[fn() -> Vec<PropertyCheck>] = &[
    standard::checks,
    fur::checks,
    anisotropy::checks,
    satin::checks,
    gauze::checks,
    sheen::checks,
    fuzz::checks,
    laser::checks,
    glint::checks,
    layered::checks,
    occlusion::checks,
    environment_lobe::checks,
    classic::checks,
];

/// Every check.
pub fn checks() -> Vec<PropertyCheck> {
    FAMILIES.iter().flat_map(|checks| checks()).collect()
}

/// Makes every check at its corners and at `random` points more ([`RANDOM_POINTS`] in a full run); the classic formulas
/// at a tenth as many, as they decide nothing and break at the corners.
pub fn run(random: usize) -> Vec<Property> {
    checks().iter().map(|check| check.judge(if check.classic { random / 10 } else { random })).collect()
}
