//! Bundles of the knobs that trade time for error.

use clap::ValueEnum;

/// Samples a pixel and a factor on the shells that each material asks for; `--msaa` and `--layers` win over it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Quality {
    /// 1 sample, half the shells.
    Draft,
    /// 4 samples, the shells that each material says.
    Normal,
    /// 4 samples, half as many shells again.
    High,
    /// 4 samples, three times the shells.
    Reference,
}

impl Quality {
    /// Samples a pixel.
    pub fn msaa(self) -> u32 {
        if self == Self::Draft { 1 } else { 4 }
    }

    /// Factor on the shells of each material.
    pub fn layer_scale(self) -> f32 {
        match self {
            Self::Draft => 0.5,
            Self::Normal => 1.0,
            Self::High => 1.5,
            Self::Reference => 3.0,
        }
    }
}
