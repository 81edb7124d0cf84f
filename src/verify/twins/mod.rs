//! The judges of the shader library, one file a GLSL file.

mod albedo;
mod anisotropy;
mod color;
mod cotton;
mod coverage;
mod direction;
mod environment;
mod environment_lobe;
mod fibre;
mod film;
mod fuzz;
mod gauze;
mod ggx;
mod glint;
mod hash;
mod horizon;
mod hsv;
mod laser;
mod layered;
mod light;
mod lock;
mod occlusion;
mod octahedral;
mod satin;
mod shadow;
mod sheen;
mod standard;
mod strand;
mod sway;
mod tonemap;
mod transparency;
mod uv;
mod velvet;

use super::twin::Twin;

/// Every file's.
const FILES: &[&[Twin]] = &[
    albedo::TWINS,
    anisotropy::TWINS,
    color::TWINS,
    cotton::TWINS,
    coverage::TWINS,
    direction::TWINS,
    environment_lobe::TWINS,
    fibre::TWINS,
    environment::TWINS,
    film::TWINS,
    fuzz::TWINS,
    gauze::TWINS,
    ggx::TWINS,
    glint::TWINS,
    hash::TWINS,
    horizon::TWINS,
    hsv::TWINS,
    laser::TWINS,
    layered::TWINS,
    light::TWINS,
    lock::TWINS,
    occlusion::TWINS,
    octahedral::TWINS,
    satin::TWINS,
    shadow::TWINS,
    sheen::TWINS,
    standard::TWINS,
    strand::TWINS,
    sway::TWINS,
    tonemap::TWINS,
    transparency::TWINS,
    uv::TWINS,
    velvet::TWINS,
];

/// Every twin, by file.
pub fn twins() -> impl Iterator<Item = &'static Twin> {
    FILES.iter().copied().flatten()
}

/// One unit in the last place, relative.
const ULP: f64 = f32::EPSILON as f64;
