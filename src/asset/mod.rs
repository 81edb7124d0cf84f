//! Files or formulas to plain data.

mod model;
pub mod procedural;
pub use model::*;
