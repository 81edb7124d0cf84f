//! How far a function may be off, and from what.

/// `|error| <= abs + rel |x|`, a component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// Relative.
    pub rel: f64,
    /// Absolute.
    pub abs: f64,
}

impl Limit {
    /// What a function meets that says nothing else.
    pub const DEFAULT: Self = Self { rel: 2e-5, abs: 1e-6 };
    /// The same bits: integers, and numbers made of them.
    pub const EXACT: Self = Self { rel: 0.0, abs: 0.0 };

    /// Largest allowed error at an expected value. Results below the smallest normal number may be flushed to zero.
    pub fn at(self, expected: f64) -> f64 {
        self.abs + self.rel * expected.abs() + if self.rel > 0.0 { f64::from(f32::MIN_POSITIVE) } else { 0.0 }
    }
}

/// What an error is measured against. The inputs that a rule moves are floats other than zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rule {
    /// The twin's value alone.
    Plain,
    /// The limit grows by what moving each input that many units in the last place changes in the twin (its condition),
    /// since the device rounds intermediate values as if the inputs had been moved.
    Conditioned(u32),
    /// The twin's value for the inputs as they are, or moved by up to that many units in the last place: which side of a
    /// step a result falls on is a matter of rounding, what stands there is not.
    Stepped(u32),
}
