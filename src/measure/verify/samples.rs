//! The inputs of a function: seeded ones, then the grid of extremes.

use super::error::VerifyError;
use crate::measure::twin::{Domain, Random, Twin};
use crate::shader::function::{Function, Scalar};

/// Largest grid of extremes that is evaluated whole; of a larger one, this many seeded points are.
const LARGEST_GRID: usize = 1 << 16;
/// One of so many random groups is an extreme, too: extremes beside ordinary numbers.
const ONE_EXTREME_IN: usize = 8;

/// Words of every sample, one after the other.
pub(super) struct Inputs {
    pub(super) words: Vec<u32>,
    /// Words a sample; at least 1.
    pub(super) stride: usize,
    /// Samples before those of the grid.
    pub(super) seeded: usize,
}

impl Inputs {
    pub(super) fn count(&self) -> usize {
        self.words.len() / self.stride
    }

    pub(super) fn sample(&self, index: usize) -> &[u32] {
        &self.words[index * self.stride..(index + 1) * self.stride]
    }
}

/// The inputs by which `twin` judges `function`.
pub(super) fn inputs(function: &Function, twin: &Twin, samples: u32) -> Result<Inputs, VerifyError> {
    let groups = groups(function, twin)?;
    let extremes: Vec<_> = groups.iter().map(|domain| domain.extremes()).collect();
    let mut words = Vec::new();
    for sample in 0..samples {
        let mut random = Random::new(twin.name, sample);
        for (domain, extremes) in groups.iter().zip(&extremes) {
            if !extremes.is_empty() && random.below(ONE_EXTREME_IN) == 0 {
                words.extend(&extremes[random.below(extremes.len())]);
            } else {
                words.extend(domain.draw(&mut random));
            }
        }
    }
    let points = extremes.iter().try_fold(1usize, |product, extremes| product.checked_mul(extremes.len()));
    let is_whole = points.is_some_and(|points| points <= LARGEST_GRID);
    for point in 0..points.unwrap_or(usize::MAX).min(LARGEST_GRID) {
        let mut random = Random::new(twin.name, u32::MAX - point as u32);
        let mut rest = point;
        for extremes in &extremes {
            let at = if is_whole { rest % extremes.len() } else { random.below(extremes.len()) };
            rest /= extremes.len();
            words.extend(&extremes[at]);
        }
    }
    let stride = function.arguments.iter().map(|value| value.words as usize).sum::<usize>().max(1);
    Ok(Inputs { words, stride, seeded: samples as usize })
}

/// One domain a group, having checked that domains and arguments go together.
fn groups(function: &Function, twin: &Twin) -> Result<Vec<Domain>, VerifyError> {
    let wrong = |problem| VerifyError::Domains { name: function.name, problem };
    let (has, wants) = (twin.domains.len(), function.arguments.len());
    if has != wants || wants == 0 {
        return Err(wrong(format!("it has {has} domains for {wants} arguments")));
    }
    let mut groups = Vec::new();
    for (domain, value) in twin.domains.iter().zip(function.arguments) {
        let fits = match domain {
            Domain::Uniform(..) | Domain::Log(..) | Domain::Sign => value.scalar == Scalar::Float,
            Domain::Choice(_) | Domain::Bits => value.scalar != Scalar::Float,
            _ => value.scalar == Scalar::Float && value.words == 3,
        };
        if !fits {
            return Err(wrong(format!("`{}` is {:?} x {}, not {domain:?}", value.name, value.scalar, value.words)));
        }
        let count = value.words as usize;
        groups.extend(std::iter::repeat_n(*domain, count / domain.group(count)));
    }
    Ok(groups)
}
