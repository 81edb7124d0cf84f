//! Which extensions vair reads and which it refuses.

use super::AssetError;
use super::context::Context;
use super::document::Document;

/// Read and honoured.
pub(super) const READ: [&str; 16] = [
    "KHR_texture_transform",
    "KHR_mesh_quantization",
    "KHR_lights_punctual",
    "KHR_materials_unlit",
    "KHR_materials_emissive_strength",
    "KHR_materials_variants",
    "KHR_materials_sheen",
    "KHR_materials_anisotropy",
    "KHR_materials_iridescence",
    "KHR_materials_specular",
    "KHR_materials_ior",
    "KHR_materials_clearcoat",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_materials_diffuse_transmission",
    "VAIR_material",
];

/// Warns once for each extension that is not read.
///
/// # Errors
/// A required extension that is not read.
pub(super) fn check(context: &Context, document: &Document) -> Result<(), AssetError> {
    for (i, name) in document.root.extensions_required.iter().enumerate() {
        if !READ.contains(&name.as_str()) {
            return Err(context.unsupported(format_args!("extensionsRequired[{i}]"), format_args!("`{name}`")));
        }
    }
    for name in document.root.extensions_used.iter().chain(&document.root.extensions_required) {
        if !READ.contains(&name.as_str()) {
            context.warn("extensionsUsed", format_args!("`{name}` is not known and is ignored"));
        }
    }
    Ok(())
}
