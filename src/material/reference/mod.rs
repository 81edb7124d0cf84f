//! Double-precision twins of the shader functions, written from the formulas and sharing no code with the shaders.
//!
//! Each file is named after the GLSL file in `shaders_glsl/lib` that it judges. The one thing both sides share is
//! data: [`albedo::Fit`] reads the fitted coefficients out of `albedo.glsl`, so that there is one declaration of them.
//! All directions are unit vectors in the tangent frame (z = normal) and point away from the surface.

pub mod albedo;
pub mod anisotropy;
pub mod classic;
pub mod color;
pub mod coverage;
pub mod direction;
pub mod environment;
pub mod environment_lobe;
pub mod fibre;
pub mod film;
pub mod fuzz;
pub mod gauze;
pub mod ggx;
pub mod glint;
pub mod hash;
pub mod horizon;
pub mod hsv;
pub mod laser;
pub mod layered;
pub mod light;
pub mod lock;
pub mod occlusion;
pub mod octahedral;
pub mod satin;
pub mod shadow;
pub mod sheen;
pub mod standard;
pub mod strand;
pub mod sway;
pub mod tonemap;
pub mod transparency;
pub mod uv;
