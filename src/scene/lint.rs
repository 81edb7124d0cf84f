//! Maps that a file or look asks for and that cannot do what it expects: a picture is shown, and a warning says why it
//! lacks something.

use crate::asset::{Asset, Image, TextureRef};
use crate::material::{Material, ParameterSet};

/// Adds a warning, once, for each map that its mesh has no texture coordinates for, for each normal map that is grey, and
/// for cloth that nothing lights.
pub(super) fn maps(asset: &mut Asset, materials: &[Material]) {
    let mut warnings = Vec::new();
    for (m, mesh) in asset.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let variants = primitive.variant_materials.iter().map(|&(_, material)| material);
            for material in std::iter::once(primitive.material).chain(variants).map(|index| &materials[index]) {
                // The maps of fur are projected onto what has no coordinates.
                let sets = primitive.vertices.uv_sets.len();
                let lacking = textures(material).filter(|(_, map)| map.uv_set as usize >= sets);
                let names: Vec<_> = lacking.map(|(name, map)| format!("`{name}` (TEXCOORD_{})", map.uv_set)).collect();
                if !names.is_empty() {
                    let (names, material) = (names.join(", "), &material.name);
                    let mend = if sets == 0 { "unwrap the mesh" } else { "choose another uv_set" };
                    warnings.push(format!(
                        "meshes[{m}].primitives[{p}]: has no texture coordinates for {names} of material `{material}`, which \
                         are not shown; {mend}"
                    ));
                }
            }
        }
    }
    for material in materials {
        if let Some(cloth) = material.family.as_ref().filter(|_| material.standard.unlit) {
            warnings.push(format!(
                "material `{}`: is unlit, so that nothing shows that it is {}; set unlit = false",
                material.name,
                cloth.kind()
            ));
        }
        for (name, map) in textures(material).filter(|(name, _)| name.ends_with("normal_texture")) {
            let image = &asset.images[asset.textures[map.texture].image];
            if is_grey(image) {
                warnings.push(format!(
                    "material `{}`: `{name}` is the grey image `{}`, perhaps heights; a normal map is mostly blue",
                    material.name, image.name
                ));
            }
        }
    }
    warnings.retain(|warning| !asset.warnings.contains(warning));
    asset.warnings.extend(warnings);
}

/// Those of the surface and its cloth.
fn textures(material: &Material) -> impl Iterator<Item = (&'static str, TextureRef)> {
    let cloth = material.family.as_ref().map(|cloth| cloth.textures()).unwrap_or_default();
    material.standard.textures().into_iter().chain(cloth)
}

fn is_grey(image: &Image) -> bool {
    image.rgba.chunks_exact(4).all(|texel| texel[0] == texel[1] && texel[1] == texel[2])
}
