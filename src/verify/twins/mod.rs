//! The judges of the shader library, one file a GLSL file.

mod albedo;
mod anisotropy;
mod color;
mod coverage;
mod direction;
mod film;
mod gauze;
mod ggx;
mod hash;
mod layered;
mod light;
mod lock;
mod satin;
mod standard;
mod strand;
mod sway;
mod tonemap;
mod uv;

use super::twin::Twin;

/// Every twin, by file.
pub fn twins() -> impl Iterator<Item = &'static Twin> {
    let files: [&'static [Twin]; 18] = [
        albedo::TWINS,
        anisotropy::TWINS,
        color::TWINS,
        coverage::TWINS,
        direction::TWINS,
        film::TWINS,
        gauze::TWINS,
        ggx::TWINS,
        hash::TWINS,
        layered::TWINS,
        light::TWINS,
        lock::TWINS,
        satin::TWINS,
        standard::TWINS,
        strand::TWINS,
        sway::TWINS,
        tonemap::TWINS,
        uv::TWINS,
    ];
    files.into_iter().flatten()
}

/// One unit in the last place, relative.
const ULP: f64 = f32::EPSILON as f64;
