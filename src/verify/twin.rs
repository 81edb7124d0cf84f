//! What a function is judged by.

use super::domain::Domain;
use glam::{DVec2, DVec3};

/// One function's judge: where it is evaluated, what it should answer, and how far off it may be.
#[derive(Debug, Clone, Copy)]
pub struct Twin {
    /// Name of the function in `shaders_glsl/lib`.
    pub name: &'static str,
    /// One an argument, or a member where an argument is a struct (padding aside), in their order.
    pub domains: &'static [Domain],
    /// How far a result may be off.
    pub limit: Limit,
    /// What of a result's error is allowed beside the limit, a component: of the same inputs.
    pub allowance: Option<fn(&mut Given<'_>) -> Vec<f64>>,
    /// What an error is measured against.
    pub rule: Rule,
    /// Share of the samples that may miss the limit: nothing but where the function leaves out on purpose what the twin
    /// does not.
    pub missed: f64,
    /// The function in double precision: results in their order, matrices column by column.
    pub value: fn(&mut Given<'_>) -> Vec<f64>,
    /// What of a result is used, applied to found and expected alike.
    pub used: fn(&mut [f64]),
}

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

impl Twin {
    /// A twin with the limit that holds where nothing else is said.
    pub(super) const fn new(
        name: &'static str,
        domains: &'static [Domain],
        value: fn(&mut Given<'_>) -> Vec<f64>,
    ) -> Self {
        Self {
            name,
            domains,
            limit: Limit::DEFAULT,
            allowance: None,
            rule: Rule::Plain,
            missed: 0.0,
            value,
            used: |_| {},
        }
    }

    pub(super) const fn limit(mut self, rel: f64, abs: f64) -> Self {
        self.limit = Limit { rel, abs };
        self
    }

    pub(super) const fn rule(mut self, rule: Rule) -> Self {
        self.rule = rule;
        self
    }

    pub(super) const fn allowance(mut self, allowance: fn(&mut Given<'_>) -> Vec<f64>) -> Self {
        self.allowance = Some(allowance);
        self
    }

    pub(super) const fn missed(mut self, share: f64) -> Self {
        self.missed = share;
        self
    }

    pub(super) const fn used(mut self, used: fn(&mut [f64])) -> Self {
        self.used = used;
        self
    }

    /// What is allowed beside the limit, for that many components.
    pub(super) fn allowed(&self, words: &[u32], components: usize) -> Vec<f64> {
        self.allowance.map_or_else(|| vec![0.0; components], |allowance| allowance(&mut Given(words.iter())))
    }

    /// The twin's value for one invocation's words.
    pub(super) fn expected(&self, words: &[u32]) -> Vec<f64> {
        let mut value = (self.value)(&mut Given(words.iter()));
        (self.used)(&mut value);
        value
    }
}

/// One invocation's arguments, read one after the other.
#[derive(Debug)]
pub struct Given<'a>(std::slice::Iter<'a, u32>);

impl Given<'_> {
    fn word(&mut self) -> u32 {
        // The number of words is checked before the first sample.
        self.0.next().copied().unwrap_or_default()
    }

    /// The next `float`.
    pub fn number(&mut self) -> f64 {
        f64::from(f32::from_bits(self.word()))
    }

    /// The next `vec2`.
    pub fn vec2(&mut self) -> DVec2 {
        DVec2::new(self.number(), self.number())
    }

    /// The next `vec3`.
    pub fn vec3(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }

    /// The next `uint`, or `bool` as 0 or 1.
    pub fn uint(&mut self) -> u32 {
        self.word()
    }

    /// The next `int`.
    pub fn int(&mut self) -> i32 {
        self.word().cast_signed()
    }
}
