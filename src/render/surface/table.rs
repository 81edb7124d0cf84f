//! Look-up tables: small images that the library brings along, for lobes that have no closed form.

use ash::vk;

/// A table: shaders call the texture `<name>_table` and the sampler `<name>_table_sampler`. Linear between texels, held
/// at the edges.
#[derive(Debug, PartialEq, Eq)]
pub struct Table {
    /// Stem of the GLSL names; no two tables share one.
    pub name: &'static str,
    /// Columns and rows.
    pub size: [u32; 2],
    /// As the device stores them: four little-endian half floats each, row by row from v = 0.
    pub texels: &'static [u8],
}

impl Table {
    /// Name of its texture in the shaders.
    pub fn texture_name(&self) -> String {
        format!("{}_table", self.name)
    }

    /// Name of its sampler in the shaders.
    pub fn sampler_name(&self) -> String {
        format!("{}_table_sampler", self.name)
    }

    /// Every device filters it (Vulkan 1.3, "Required Format Support").
    pub const FORMAT: vk::Format = vk::Format::R16G16B16A16_SFLOAT;
}
