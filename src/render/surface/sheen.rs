//! The table of sheen, for every family with fuzz.

use super::Table;
use crate::material::SheenTable;

/// `sheen_table` of the shaders: see [`SheenTable`].
pub static TABLE: Table = Table { name: "sheen", size: SheenTable::SIZE, texels: SheenTable::BYTES };
