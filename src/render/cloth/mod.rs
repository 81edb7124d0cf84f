//! How each family of cloth is drawn: its fragment shader, its uniform block, its maps and tables, and what of it is
//! decided when the pipeline is made.

mod layered;
mod satin;

use super::map::Map;
use super::table::Table;
use crate::material::{Cloth, SheenTable, Standard};
use half::f16;

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
    /// Look-up tables that its lobes need.
    pub tables: Vec<&'static Table>,
    /// It lets light through whatever the base colour's opacity is.
    pub blends: bool,
}

/// The shader of a cloth over its standard parameters.
pub fn cloth_shader(cloth: &Cloth, standard: &Standard) -> ClothShader {
    match cloth {
        Cloth::Satin(satin) => satin::shader(satin, standard),
        Cloth::Layered(layered) => layered::shader(layered, standard),
    }
}

/// What the lobes of fuzz reflect.
static SHEEN_TABLE: Table = Table { name: "sheen", size: SheenTable::SIZE, texels: sheen_texels };

fn sheen_texels() -> Vec<[f32; 4]> {
    let numbers: Vec<f32> =
        SheenTable::BYTES.chunks_exact(2).map(|bytes| f16::from_le_bytes([bytes[0], bytes[1]]).to_f32()).collect();
    numbers.chunks_exact(4).map(|texel| [texel[0], texel[1], texel[2], texel[3]]).collect()
}
