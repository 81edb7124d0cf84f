//! Test inputs: what a function is evaluated at.

use glam::{DVec2, DVec3};

/// One invocation's arguments, read one after the other.
#[derive(Debug)]
pub struct TestInputs<'a>(std::slice::Iter<'a, u32>);

impl<'a> TestInputs<'a> {
    /// Of one invocation's words.
    pub(super) fn new(words: &'a [u32]) -> Self {
        Self(words.iter())
    }

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
