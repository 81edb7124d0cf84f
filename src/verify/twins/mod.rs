//! The judges of the shader library, one file a GLSL file.

mod albedo;
mod color;
mod cotton;
mod coverage;
mod direction;
mod fuzz;
mod ggx;
mod hash;
mod light;
mod lock;
mod sheen;
mod standard;
mod strand;
mod sway;
mod tonemap;
mod uv;
mod velvet;

use super::twin::Twin;

/// Every twin, by file.
pub fn twins() -> impl Iterator<Item = &'static Twin> {
    let files: [&'static [Twin]; 17] = [
        albedo::TWINS,
        color::TWINS,
        cotton::TWINS,
        coverage::TWINS,
        direction::TWINS,
        fuzz::TWINS,
        ggx::TWINS,
        hash::TWINS,
        light::TWINS,
        lock::TWINS,
        sheen::TWINS,
        standard::TWINS,
        strand::TWINS,
        sway::TWINS,
        tonemap::TWINS,
        uv::TWINS,
        velvet::TWINS,
    ];
    files.into_iter().flatten()
}

/// One unit in the last place, relative.
const ULP: f64 = f32::EPSILON as f64;
