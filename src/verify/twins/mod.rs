//! The judges of the shader library, one file a GLSL file.

mod albedo;
mod anisotropy;
mod color;
mod coverage;
mod direction;
mod film;
mod gauze;
mod ggx;
mod glint;
mod hash;
mod hsv;
mod laser;
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
    const FILES: &[&[Twin]] = &[
        albedo::TWINS,
        anisotropy::TWINS,
        color::TWINS,
        coverage::TWINS,
        direction::TWINS,
        gauze::TWINS,
        film::TWINS,
        ggx::TWINS,
        glint::TWINS,
        hash::TWINS,
        hsv::TWINS,
        laser::TWINS,
        light::TWINS,
        lock::TWINS,
        satin::TWINS,
        standard::TWINS,
        strand::TWINS,
        sway::TWINS,
        tonemap::TWINS,
        uv::TWINS,
    ];
    FILES.iter().copied().flatten()
}

/// One unit in the last place, relative.
const ULP: f64 = f32::EPSILON as f64;
