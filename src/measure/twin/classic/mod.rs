//! The formulas that artists know from older engine shaders, as those state them, defects and all: what `classic = true`
//! asks for, and what the furnace measures beside the robust forms.
//!
//! One file a family, with what the shader's classic functions are held to. Every range stands beside its formula; colours
//! are linear, angles radians, directions unit vectors in the tangent frame (z = normal) that point away from the surface.

pub mod cotton;
pub mod fur;
pub mod gauze;
pub mod laser;
pub mod satin;
pub mod velvet;
