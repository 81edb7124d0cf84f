//! How finely an environment is prepared.

use crate::asset::Environment;

/// Sides of a cube's faces, texels.
const FACE_PX: std::ops::RangeInclusive<u32> = 16..=512;
/// Faces of the last level, of the roughest lobe, have this many texels a side.
const LAST_FACE_PX: u32 = 4;
/// A small environment's cube has at least this side: its levels are also the steps of roughness.
const LEAST_FACE_PX: u32 = 64;
/// Directions that a texel looks into at most, unless more are asked for: more no longer show.
const MOST_SAMPLES: u32 = 4096;
/// No direction differs: every texel of the one level is the same.
const CONSTANT_FACE_PX: u32 = 32;

/// How finely environments are prepared. `vair report` (feature `environment`) shows error against time for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct EnvironmentQuality {
    /// Largest side of the faces of the mirror's level, texels, a power of two in [16, 512]; default 256. Environments of
    /// fewer texels have smaller ones. Six faces with all levels take 64 bytes times its square.
    pub face_px: u32,
    /// Directions that a texel of the first blurred level looks into, in [1, 1024]; four times as many a level further, where
    /// a quarter of the texels is left, up to 4096; default 64. Time grows with it.
    pub samples: u32,
    /// Nodes of the table of lobes along the cosine and along the roughness, in [8, 64]; default 32.
    pub table_px: u32,
}

impl Default for EnvironmentQuality {
    fn default() -> Self {
        Self { face_px: 256, samples: 64, table_px: 32 }
    }
}

impl EnvironmentQuality {
    /// What is out of its range and what to do, if anything is.
    pub(in crate::render) fn problem(&self) -> Option<String> {
        let Self { face_px, samples, table_px } = *self;
        if !FACE_PX.contains(&face_px) || !face_px.is_power_of_two() {
            return Some(format!("faces of {face_px} texels; choose a power of two from 16 to 512"));
        }
        if !(1..=1024).contains(&samples) {
            return Some(format!("{samples} samples; choose 1 to 1024"));
        }
        (!(8..=64).contains(&table_px)).then(|| format!("a table of {table_px} nodes; choose 8 to 64"))
    }

    /// Sheets of the table of lobes: GGX and three models of sheen.
    pub(super) const TABLE_SHEETS: u32 = 4;

    /// Columns and rows of the table of lobes.
    pub(super) fn table_size(&self) -> [u32; 2] {
        [self.table_px, self.table_px * Self::TABLE_SHEETS]
    }

    /// Side of the faces of that environment's cube, and the number of its last level.
    pub(super) fn cube_of(&self, environment: &Environment) -> (u32, u32) {
        if environment.constant_radiance().is_some() {
            return (CONSTANT_FACE_PX, 0);
        }
        // A face spans a quarter of the turn.
        let resolved = environment.size[0].max(2 * environment.size[1]).div_ceil(4).next_power_of_two();
        let face_px = self.face_px.min(resolved.max(LEAST_FACE_PX));
        (face_px, (face_px / LAST_FACE_PX).ilog2())
    }

    /// Directions that a texel of a level looks into.
    pub(super) fn samples_of(&self, level: u32) -> u32 {
        (self.samples << (2 * level.saturating_sub(1)).min(10)).min(self.samples.max(MOST_SAMPLES))
    }
}
