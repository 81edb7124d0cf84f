//! Look-up tables: small images that the library brings along, for lobes that have no closed form.

use ash::vk;
use half::f16;

/// A table: shaders call the texture `<name>_table` and the sampler `<name>_table_sampler`. Linear between texels, held
/// at the edges.
#[derive(Debug)]
pub struct Table {
    /// Stem of the GLSL names; no two tables share one.
    pub name: &'static str,
    /// Columns and rows.
    pub size: [u32; 2],
    /// RGBA, row by row from v = 0.
    pub texels: fn() -> Vec<[f32; 4]>,
}

impl Table {
    /// Every device filters it (Vulkan 1.3, "Required Format Support").
    pub const FORMAT: vk::Format = vk::Format::R16G16B16A16_SFLOAT;

    /// As the device stores it.
    pub fn bytes(&self) -> Vec<u8> {
        (self.texels)().into_iter().flatten().flat_map(|number| f16::from_f32(number).to_le_bytes()).collect()
    }
}
