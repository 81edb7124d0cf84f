//! The table of sheen, for every family with fuzz.

use crate::material::SheenTable;
use crate::render::table::Table;

/// `sheen_table` of the shaders: see [`SheenTable`].
pub static TABLE: Table = Table { name: "sheen", size: SheenTable::SIZE, texels: SheenTable::BYTES };
