//! How each family of cloth is drawn: its fragment shader, its uniform block, its maps and tables, and what of it is
//! decided when the pipeline is made.

mod cotton;
mod gauze;
mod glint;
mod laser;
mod layered;
mod satin;
mod sheen;
mod velvet;

use super::map::Map;
use super::table::Table;
use crate::material::{Cloth, Standard};

/// What a family adds to the draw of the standard surface.
#[derive(Debug, Clone)]
pub struct ClothShader {
    /// Fragment shader, under `shaders_glsl/pass`.
    pub file: &'static str,
    /// GLSL name of its uniform block, in set 1.
    pub block: &'static str,
    /// The block's bytes.
    pub uniforms: Vec<u8>,
    /// Its own maps.
    pub maps: Vec<Map>,
    /// Specialization constants beside those of the maps, by GLSL name; those that are 0 may be left out.
    pub constants: Vec<(&'static str, u32)>,
    /// Defines of its own in `shaders_glsl/permutations`.
    pub defines: &'static [&'static str],
    /// Look-up tables that its lobes need.
    pub tables: Vec<&'static Table>,
    /// It lets light through whatever the base colour's opacity is.
    pub blends: bool,
    /// It asks the vertices where they are in the rest pose.
    pub reads_rest: bool,
}

/// The shader of a cloth over its standard parameters.
pub fn cloth_shader(cloth: &Cloth, standard: &Standard) -> ClothShader {
    match cloth {
        Cloth::Gauze(gauze) => gauze::shader(gauze, standard),
        Cloth::Laser(laser) => laser::shader(laser, standard),
        Cloth::Glint(glint) => glint::shader(glint, standard),
        Cloth::Cotton(cotton) => cotton::shader(cotton, standard),
        Cloth::Satin(satin) => satin::shader(satin, standard),
        Cloth::Velvet(velvet) => velvet::shader(velvet, standard),
        Cloth::Layered(layered) => layered::shader(layered, standard),
    }
}
