//! From what a function's test inputs are drawn.

use super::hash;
use glam::DVec3;
use std::f64::consts::TAU;

/// Values of one argument or member.
#[derive(Debug, Clone, Copy)]
pub enum Domain {
    /// Each component uniform between two numbers, and its extremes.
    Uniform(f32, f32, &'static [f32]),
    /// The logarithm of each component uniform between those of two positive numbers, and its extremes.
    Log(f32, f32, &'static [f32]),
    /// A unit vector.
    Direction,
    /// A unit vector, or none: what a mesh without tangents has.
    DirectionOrZero,
    /// A unit vector above the horizon, z in [1e-7, 1].
    Above,
    /// A unit vector on or above the horizon, z in [0, 1].
    Hemisphere,
    /// 1 or -1.
    Sign,
    /// One of these words.
    Choice(&'static [u32]),
    /// Any 32 bits, and the extremes of integers.
    Bits,
}

/// In [0, 1].
pub(super) const UNIT: Domain = Domain::Uniform(0.0, 1.0, &[0.0, 1e-40, 1e-8, 0.5, ALMOST_ONE, 1.0]);
/// A roughness, in [0, 1]: below about 0.03 nothing changes any more.
pub(super) const ROUGHNESS: Domain = Domain::Uniform(0.0, 1.0, &[0.0, 1e-40, 1e-8, 0.031, 0.089, 1.0]);
/// A cosine above the horizon, in [0, 1].
pub(super) const COSINE: Domain = Domain::Uniform(0.0, 1.0, &[0.0, 1e-40, 1e-7, 1e-4, 1e-2, ALMOST_ONE, 1.0]);
/// A GGX width, in [1e-3, 1]: roughness 0 to 1 at every anisotropy.
pub(super) const ALPHA: Domain = Domain::Log(1e-3, 1.0, &[1e-3, 0.05, 1.0]);
/// Radiance of an environment.
pub(super) const RADIANCE: Domain = Domain::Log(1e-3, 64512.0, &[0.0, 1.0, 64512.0]);
/// Largest number below 1.
pub(super) const ALMOST_ONE: f32 = 1.0 - f32::EPSILON / 2.0;

/// Directions where formulas tend to break: along the axes, nearly so, and nowhere in particular.
const DIRECTIONS: [[f32; 3]; 13] = [
    [0.0, 0.0, 1.0],
    [0.0, 0.0, -1.0],
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, -1.0, 0.0],
    [1e-7, 0.0, 1.0],
    [0.0, -1e-4, -1.0],
    [1.0, 0.0, 1e-7],
    [-1.0, 0.0, 1e-7],
    [0.0, 1.0, -1e-7],
    [0.6, -0.48, 0.64],
    [-0.6, 0.48, -0.64],
];

/// Seeded random bits: draw after draw of one sample of one function.
#[derive(Debug, Clone)]
pub(in crate::measure) struct Random {
    seed: u32,
    sample: u32,
    drawn: u32,
}

impl Random {
    /// The numbers of one sample; `name` keeps the functions' apart.
    pub(in crate::measure) fn new(name: &str, sample: u32) -> Self {
        // FNV-1a (Fowler, Noll & Vo): any hash of the name would do.
        let seed = name.bytes().fold(0x811c_9dc5, |hash: u32, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193));
        Self { seed, sample, drawn: 0 }
    }

    pub(in crate::measure) fn bits(&mut self) -> [u32; 3] {
        self.drawn += 1;
        hash::pcg3d([self.sample, self.drawn, self.seed])
    }

    /// Below `count`, which is at least 1.
    pub(in crate::measure) fn below(&mut self, count: usize) -> usize {
        ((u64::from(self.bits()[0]) * count as u64) >> 32) as usize
    }

    /// In [0, 1).
    fn unit(&mut self) -> f64 {
        f64::from(self.bits()[0]) / 2f64.powi(32)
    }
}

impl Domain {
    /// Words that are chosen together: vectors of a length are, the components of other vectors are not.
    pub(in crate::measure) fn group(&self, words: usize) -> usize {
        match self {
            Self::Uniform(..) | Self::Log(..) | Self::Sign | Self::Choice(_) | Self::Bits => 1,
            _ => words,
        }
    }

    /// The extremes of one group.
    pub(in crate::measure) fn extremes(&self) -> Vec<Vec<u32>> {
        let numbers = |numbers: &[f32]| numbers.iter().map(|number| vec![number.to_bits()]).collect();
        let vectors = |is_allowed: fn(&[f32; 3]) -> bool| {
            let allowed = DIRECTIONS.iter().filter(|direction| is_allowed(direction));
            allowed.map(|direction| direction.map(f32::to_bits).to_vec()).collect()
        };
        match self {
            Self::Uniform(_, _, extremes) | Self::Log(_, _, extremes) => numbers(extremes),
            Self::Sign => numbers(&[1.0, -1.0]),
            Self::Direction => vectors(|_| true),
            Self::DirectionOrZero => [vectors(|_| true), vec![vec![0; 3]]].concat(),
            Self::Above => vectors(|direction| direction[2] > 0.0),
            Self::Hemisphere => vectors(|direction| direction[2] >= 0.0),
            Self::Choice(words) => words.iter().map(|word| vec![*word]).collect(),
            Self::Bits => [0, 1, 0x7fff_ffff, 0x8000_0000, 0xffff_ffff].map(|word| vec![word]).to_vec(),
        }
    }

    /// One group at random.
    pub(in crate::measure) fn draw(&self, random: &mut Random) -> Vec<u32> {
        let number = |number: f64| vec![(number as f32).to_bits()];
        match *self {
            Self::Uniform(low, high, _) => number(f64::from(low) + random.unit() * f64::from(high - low)),
            Self::Log(low, high, _) => {
                let (low, high) = (f64::from(low).ln(), f64::from(high).ln());
                number((low + random.unit() * (high - low)).exp())
            }
            Self::Sign => vec![[1f32, -1.0][random.below(2)].to_bits()],
            Self::Direction | Self::DirectionOrZero => direction(2.0 * random.unit() - 1.0, random),
            Self::Above | Self::Hemisphere => direction(random.unit().max(1e-7), random),
            Self::Choice(words) => vec![words[random.below(words.len())]],
            Self::Bits => vec![random.bits()[0]],
        }
    }
}

fn direction(z: f64, random: &mut Random) -> Vec<u32> {
    let (sine, cosine) = (random.unit() * TAU).sin_cos();
    let across = (1.0 - z * z).max(0.0).sqrt();
    DVec3::new(across * cosine, across * sine, z).as_vec3().to_array().map(f32::to_bits).to_vec()
}
