//! Materials, as the file says them.

use super::context::Context;
use super::document::{self, Document, TextureInfo};
use super::{AlphaMode, AssetError, MAX_UV_SETS, Material, TextureRef, material_extension};
use glam::{Vec2, Vec3, Vec4};
use serde_json::{Map, Value};

const UNIT: (f32, f32) = (0.0, 1.0);
const POSITIVE: (f32, f32) = (0.0, f32::MAX);

/// All materials, and a default one at the end where some primitive names none.
///
/// # Errors
/// Texture indices out of range; an alpha mode that does not exist; numbers that are not finite.
pub(super) fn read(context: &Context, document: &Document) -> Result<Vec<Material>, AssetError> {
    let mut materials = Vec::with_capacity(document.materials.len() + 1);
    for (m, json) in document.materials.iter().enumerate() {
        materials.push(Reader { context, document, field: format!("materials[{m}]") }.material(json)?);
    }
    let mut primitives = document.meshes.iter().flat_map(|mesh| &mesh.primitives);
    if primitives.any(|primitive| primitive.material.is_none()) {
        materials.push(Material::default());
    }
    Ok(materials)
}

/// Reads one material.
pub(super) struct Reader<'a> {
    context: &'a Context,
    document: &'a Document,
    field: String,
}

impl Reader<'_> {
    fn material(&self, json: &document::Material) -> Result<Material, AssetError> {
        let pbr = &json.pbr_metallic_roughness;
        let default = Material::default();
        let scale = |info: &Option<TextureInfo>, pick: fn(&TextureInfo) -> Option<f32>| info.as_ref().and_then(pick);
        let normal_scale = scale(&json.normal_texture, |info| info.scale).unwrap_or(1.0);
        self.context.finite(format_args!("{}.normalTexture.scale", self.field), &[normal_scale])?;
        let strength = match &json.extensions.emissive_strength {
            Some(emissive) => {
                self.within("emissiveStrength", [emissive.emissive_strength.unwrap_or(1.0)], POSITIVE)?[0]
            }
            None => 1.0,
        };
        let emissive = Vec3::from(self.within("emissiveFactor", json.emissive_factor.unwrap_or([0.0; 3]), POSITIVE)?);
        let emissive = emissive * strength;
        self.context.finite(format_args!("{}.emissiveFactor", self.field), &emissive.to_array())?;
        let cutoff = self.within("alphaCutoff", [json.alpha_cutoff.unwrap_or(0.5)], POSITIVE)?[0];
        let alpha_mode = match json.alpha_mode.as_deref() {
            None | Some("OPAQUE") => AlphaMode::Opaque,
            Some("MASK") => AlphaMode::Mask(cutoff),
            Some("BLEND") => AlphaMode::Blend,
            Some(mode) => {
                let problem = format!("`{mode}` does not exist; use OPAQUE, MASK or BLEND");
                return Err(self.context.error(format_args!("{}.alphaMode", self.field), problem));
            }
        };
        let base_color = self.within("baseColorFactor", pbr.base_color_factor.unwrap_or([1.0; 4]), UNIT)?;
        let occlusion = scale(&json.occlusion_texture, |info| info.strength).unwrap_or(1.0);
        Ok(Material {
            name: json.name.clone(),
            base_color: Vec4::from(base_color),
            base_color_texture: self.texture("pbrMetallicRoughness.baseColorTexture", &pbr.base_color_texture)?,
            metallic: self.within("metallicFactor", [pbr.metallic_factor.unwrap_or(default.metallic)], UNIT)?[0],
            roughness: self.within("roughnessFactor", [pbr.roughness_factor.unwrap_or(default.roughness)], UNIT)?[0],
            metallic_roughness_texture: self
                .texture("pbrMetallicRoughness.metallicRoughnessTexture", &pbr.metallic_roughness_texture)?,
            normal_texture: self.texture("normalTexture", &json.normal_texture)?,
            normal_scale,
            occlusion_texture: self.texture("occlusionTexture", &json.occlusion_texture)?,
            occlusion_strength: self.within("occlusionTexture.strength", [occlusion], UNIT)?[0],
            emissive,
            emissive_texture: self.texture("emissiveTexture", &json.emissive_texture)?,
            alpha_mode,
            double_sided: json.double_sided,
            unlit: json.extensions.unlit.is_some(),
            extensions: material_extension::read(self, &json.extensions.further)?,
            vair: self.vair(json),
        })
    }

    /// Factors clamped to a range, with a warning.
    pub(super) fn within<const N: usize>(
        &self,
        name: &str,
        values: [f32; N],
        (least, most): (f32, f32),
    ) -> Result<[f32; N], AssetError> {
        let field = format!("{}.{name}", self.field);
        self.context.finite(&field, &values)?;
        let clamped = values.map(|value| value.clamp(least, most));
        if clamped != values {
            let range = if most == f32::MAX { format!(">= {least}") } else { format!("in [{least}, {most}]") };
            self.context.warn(field, format_args!("must be {range}; it is clamped"));
        }
        Ok(clamped)
    }

    /// The material breaks the format at `name`.
    pub(super) fn error(&self, name: &str, problem: &str) -> AssetError {
        self.context.error(format_args!("{}.{name}", self.field), problem)
    }

    /// Notes an oddity at `name`.
    pub(super) fn warn(&self, name: &str, problem: &str) {
        self.context.warn(format_args!("{}.{name}", self.field), problem);
    }

    /// `None`, with a warning, for a texture without an image.
    pub(super) fn texture(&self, name: &str, info: &Option<TextureInfo>) -> Result<Option<TextureRef>, AssetError> {
        let Some(info) = info else { return Ok(None) };
        let context = self.context;
        let field = format!("{}.{name}", self.field);
        context.index(format_args!("{field}.index"), info.index, "textures", self.document.textures.len())?;
        if self.document.textures[info.index].source.is_none() {
            let problem = format!("textures[{}] has no PNG or JPEG image; the factor alone is shown", info.index);
            context.warn(field, problem);
            return Ok(None);
        }
        let transform = info.extensions.transform.as_ref();
        let set = transform.and_then(|transform| transform.tex_coord).unwrap_or(info.tex_coord);
        let uv_set = match u32::try_from(set) {
            Ok(set) if (set as usize) < MAX_UV_SETS => set,
            _ => {
                context.warn(&field, format_args!("uses TEXCOORD_{set}, which is not kept; TEXCOORD_0 is used"));
                0
            }
        };
        let offset = transform.and_then(|t| t.offset).unwrap_or([0.0; 2]);
        let rotation = transform.and_then(|t| t.rotation).unwrap_or(0.0);
        let scale = transform.and_then(|t| t.scale).unwrap_or([1.0; 2]);
        context.finite(
            format_args!("{field}.extensions.KHR_texture_transform"),
            &[offset[0], offset[1], rotation, scale[0], scale[1]],
        )?;
        let (offset, scale) = (Vec2::from(offset), Vec2::from(scale));
        Ok(Some(TextureRef { texture: info.index, uv_set, offset, rotation, scale }))
    }

    /// `extras.vair` overlaid by `extensions.VAIR_material`.
    fn vair(&self, json: &document::Material) -> Option<Map<String, Value>> {
        let extras = json.extras.as_ref().and_then(|extras| extras.get("vair"));
        let sources = [("extras.vair", extras), ("extensions.VAIR_material", json.extensions.vair.as_ref())];
        let mut merged: Option<Map<String, Value>> = None;
        for (name, source) in sources {
            match source {
                None => {}
                Some(Value::Object(keys)) => merged.get_or_insert_default().extend(keys.clone()),
                Some(_) => self.context.warn(format_args!("{}.{name}", self.field), "is no object; it is ignored"),
            }
        }
        merged
    }
}
