//! The passes, one file each.

pub mod deform;
pub mod draws;
pub mod tonemap;
