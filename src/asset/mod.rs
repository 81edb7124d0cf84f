//! Files or formulas to plain data.

mod model;
pub use model::*;
