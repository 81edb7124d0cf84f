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
use crate::material::Cloth;
use bytemuck::bytes_of;

/// What a family adds to the draw of the standard surface.
#[derive(Debug, Clone)]
pub struct ClothShader {
    /// Fragment shader, under `shaders_glsl/pass`.
    pub file: &'static str,
    /// GLSL name of its uniform block, in set 1.
    pub block: &'static str,
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

/// How a cloth is drawn.
pub fn cloth_shader(cloth: &Cloth) -> ClothShader {
    match cloth {
        Cloth::Gauze(gauze) => gauze::shader(gauze),
        Cloth::Laser(laser) => laser::shader(laser),
        Cloth::Glint(glint) => glint::shader(glint),
        Cloth::Cotton(cotton) => cotton::shader(cotton),
        Cloth::Satin(satin) => satin::shader(satin),
        Cloth::Velvet(velvet) => velvet::shader(velvet),
        Cloth::Layered(layered) => layered::shader(layered),
    }
}

/// The bytes of its uniform block.
pub fn cloth_uniforms(cloth: &Cloth) -> Vec<u8> {
    match cloth {
        Cloth::Gauze(gauze) => bytes_of(&gauze::uniforms(gauze)).to_vec(),
        Cloth::Laser(laser) => bytes_of(&laser::uniforms(laser)).to_vec(),
        Cloth::Glint(glint) => bytes_of(&glint::uniforms(glint)).to_vec(),
        Cloth::Cotton(cotton) => bytes_of(&cotton::uniforms(cotton)).to_vec(),
        Cloth::Satin(satin) => bytes_of(&satin::uniforms(satin)).to_vec(),
        Cloth::Velvet(velvet) => bytes_of(&velvet::uniforms(velvet)).to_vec(),
        Cloth::Layered(layered) => bytes_of(&layered::uniforms(layered)).to_vec(),
    }
}
