//! Materials.

pub mod reference;
