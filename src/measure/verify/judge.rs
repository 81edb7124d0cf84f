//! How far the device's answers are off.

use super::samples::Inputs;
use crate::measure::twin::{Limit, Random, Rule, Twin};
use crate::shader::function::{Function, Scalar, Value};
use rayon::prelude::*;

/// Joint moves of all inputs that [`Rule::Stepped`] tries beside those of each input alone.
const JOINT_MOVES: u32 = 128;

/// What was found about one function.
#[derive(Debug, Clone, PartialEq)]
pub struct FunctionReport {
    /// Name in the GLSL.
    pub name: &'static str,
    /// File under `shaders_glsl/lib`.
    pub file: &'static str,
    /// Inputs evaluated.
    pub samples: usize,
    /// Of them, seeded ones; the others are the grid of extremes.
    pub seeded: usize,
    /// Largest error over `|x| + abs / rel` (over `1 + |x|` without a relative limit). Where it is above `rel`, a rule or an
    /// allowance stands for the rest: see [`Self::of_limit`].
    pub max_rel: f64,
    /// [`Self::max_rel`] over the seeded inputs alone.
    pub max_rel_seeded: f64,
    /// 99.9th percentile of what `max_rel` is the largest of.
    pub p999_rel: f64,
    /// Largest error as it is.
    pub max_abs: f64,
    /// Largest share of its limit that a sample takes; above 1 it misses.
    pub of_limit: f64,
    /// Samples with a result that is not finite.
    pub nonfinite: usize,
    /// Samples that meet their limit only by the rule.
    pub by_rule: usize,
    /// Samples that miss their limit.
    pub missed: usize,
    /// How many may.
    pub missed_allowed: usize,
    /// The limit.
    pub limit: Limit,
    /// All is finite, and no more samples miss the limit than the twin allows.
    pub pass: bool,
    /// The sample that is farthest from its limit.
    pub worst: Option<Worst>,
}

/// One sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Worst {
    /// Arguments with their names.
    pub inputs: Vec<(&'static str, Vec<f64>)>,
    /// What the device answered; not finite where that is the fault.
    pub found: Vec<f64>,
    /// What the twin answers.
    pub expected: Vec<f64>,
}

/// One sample's verdict.
#[derive(Debug, Clone, Copy, Default)]
struct Verdict {
    relative: f64,
    absolute: f64,
    of_limit: f64,
    by_rule: bool,
    is_finite: bool,
}

/// Judges the answers `found` for `inputs`.
pub(super) fn judge(function: &Function, twin: &Twin, inputs: &Inputs, found: &[u32]) -> FunctionReport {
    let floats: Vec<bool> = scalars(function.arguments).map(|scalar| scalar == Scalar::Float).collect();
    let stride = scalars(function.results).count().max(1);
    let used = |words: &[u32]| {
        let mut values = values(function.results, words);
        (twin.used)(&mut values);
        values
    };
    let verdicts: Vec<Verdict> = found
        .par_chunks_exact(stride)
        .enumerate()
        .map(|(index, words)| verdict(twin, &floats, inputs.sample(index), &used(words)))
        .collect();
    let most = |value: fn(&Verdict) -> f64, verdicts: &[Verdict]| verdicts.iter().map(value).fold(0.0, f64::max);
    let count = |is_counted: fn(&Verdict) -> bool| verdicts.iter().filter(|verdict| is_counted(verdict)).count();
    let mut sorted: Vec<f64> = verdicts.iter().map(|verdict| verdict.relative).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let missed = count(|verdict| verdict.of_limit > 1.0);
    let nonfinite = count(|verdict| !verdict.is_finite);
    // What is not finite is worse than any error.
    let rank = |verdict: &Verdict| if verdict.is_finite { verdict.of_limit } else { f64::INFINITY };
    let worst = verdicts.iter().enumerate().max_by(|(_, a), (_, b)| rank(a).total_cmp(&rank(b)));
    FunctionReport {
        name: twin.name,
        file: function.file,
        samples: verdicts.len(),
        seeded: inputs.seeded,
        max_rel: most(|verdict| verdict.relative, &verdicts),
        max_rel_seeded: most(|verdict| verdict.relative, &verdicts[..inputs.seeded]),
        p999_rel: sorted.get(sorted.len() * 999 / 1000).copied().unwrap_or_default(),
        max_abs: most(|verdict| verdict.absolute, &verdicts),
        of_limit: most(|verdict| verdict.of_limit, &verdicts),
        nonfinite,
        by_rule: count(|verdict| verdict.by_rule),
        missed,
        missed_allowed: (twin.missed * verdicts.len() as f64) as usize,
        limit: twin.limit,
        pass: nonfinite == 0 && !verdicts.is_empty() && missed as f64 <= twin.missed * verdicts.len() as f64,
        worst: worst.map(|(index, _)| Worst {
            inputs: named(function.arguments, inputs.sample(index)),
            found: values(function.results, &found[index * stride..(index + 1) * stride]),
            expected: twin.expected(inputs.sample(index)),
        }),
    }
}

fn verdict(twin: &Twin, floats: &[bool], words: &[u32], found: &[f64]) -> Verdict {
    let expected = twin.expected(words);
    // A twin that is not finite, or has another number of results, judges nothing: the sample fails.
    if found.len() != expected.len() || found.iter().chain(&expected).any(|value| !value.is_finite()) {
        return Verdict { of_limit: f64::MAX, ..Verdict::default() };
    }
    let allowed = twin.allowed(words, found.len());
    let plain = against(twin.limit, found, &expected, &allowed);
    if plain.of_limit <= 1.0 {
        return plain;
    }
    let moved = |steps: &dyn Fn(usize) -> i64| twin.expected(&moved(words, floats, steps));
    let judged = match twin.rule {
        Rule::Plain => return plain,
        Rule::Conditioned(ulps) => {
            let mut growth = allowed;
            for input in (0..words.len()).filter(|input| floats[*input]) {
                let ends = [-1, 1].map(|sign| moved(&|at| if at == input { sign * i64::from(ulps) } else { 0 }));
                for (at, growth) in growth.iter_mut().enumerate() {
                    *growth += ends.iter().map(|end| (end[at] - expected[at]).abs()).fold(0.0, f64::max);
                }
            }
            against(twin.limit, found, &expected, &growth)
        }
        Rule::Stepped(ulps) => {
            let ulps = i64::from(ulps);
            let alone = (0..words.len())
                .flat_map(|input| [-ulps, ulps].map(|steps| moved(&|at: usize| if at == input { steps } else { 0 })));
            let jointly = (0..JOINT_MOVES).map(|index| {
                let mut random = Random::new(twin.name, index);
                let steps: Vec<_> = words.iter().map(|_| (random.below(3) as i64 - 1) * ulps).collect();
                moved(&|at| steps[at])
            });
            let near = alone.chain(jointly).map(|expected| against(twin.limit, found, &expected, &allowed));
            near.fold(plain, |best, near| if near.of_limit < best.of_limit { near } else { best })
        }
    };
    Verdict { absolute: plain.absolute, by_rule: judged.of_limit <= 1.0, ..judged }
}

/// The largest errors over all components, `growth` added to their limits.
fn against(limit: Limit, found: &[f64], expected: &[f64], growth: &[f64]) -> Verdict {
    let mut verdict = Verdict { is_finite: true, ..Verdict::default() };
    for ((found, expected), growth) in found.iter().zip(expected).zip(growth) {
        let error = (found - expected).abs();
        if error == 0.0 {
            continue;
        }
        let left = (error - f64::from(f32::MIN_POSITIVE)).max(0.0);
        let scale = expected.abs() + if limit.rel > 0.0 { limit.abs / limit.rel } else { 1.0 };
        verdict.relative = verdict.relative.max(if left == 0.0 { 0.0 } else { (left / scale).min(f64::MAX) });
        verdict.absolute = verdict.absolute.max(error);
        verdict.of_limit = verdict.of_limit.max((error / (limit.at(*expected) + growth)).min(f64::MAX));
    }
    verdict
}

/// The words with their floats moved by as many units in the last place, away from zero or towards it.
fn moved(words: &[u32], floats: &[bool], steps: &dyn Fn(usize) -> i64) -> Vec<u32> {
    let one = |(at, word): (usize, &u32)| {
        let magnitude = i64::from(word & 0x7fff_ffff);
        if !floats[at] || magnitude == 0 {
            return *word;
        }
        let largest = i64::from(f32::MAX.to_bits());
        word & 0x8000_0000 | (magnitude + steps(at)).clamp(0, largest) as u32
    };
    words.iter().enumerate().map(one).collect()
}

fn scalars(list: &[Value]) -> impl Iterator<Item = Scalar> {
    list.iter().flat_map(|value| std::iter::repeat_n(value.scalar, value.words as usize))
}

fn values(list: &[Value], words: &[u32]) -> Vec<f64> {
    let value = |(scalar, word): (Scalar, &u32)| match scalar {
        Scalar::Float => f64::from(f32::from_bits(*word)),
        Scalar::Int => f64::from(word.cast_signed()),
        Scalar::Uint | Scalar::Bool => f64::from(*word),
    };
    scalars(list).zip(words).map(value).collect()
}

fn named(list: &[Value], words: &[u32]) -> Vec<(&'static str, Vec<f64>)> {
    let mut numbers = values(list, words).into_iter();
    list.iter().map(|value| (value.name, numbers.by_ref().take(value.words as usize).collect())).collect()
}
