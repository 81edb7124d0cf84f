//! Materials, as the file says them.

use super::context::Context;
use super::document::{Document, present};
use super::{AlphaMode, AssetError, MAX_UV_SETS, Material, MaterialExtensions, TextureRef, material_extension};
use ::gltf::json;
use ::gltf::json::extensions::texture::TextureTransform;
use ::gltf::json::texture::Info;
use glam::{Vec2, Vec3, Vec4};
use serde::Deserialize;
use serde_json::{Map, Value};

const UNIT: (f32, f32) = (0.0, 1.0);
const POSITIVE: (f32, f32) = (0.0, f32::MAX);

/// All materials, and a default one at the end where some primitive names none.
///
/// # Errors
/// Texture indices out of range; an alpha mode that does not exist; numbers that are not finite.
pub(super) fn read(context: &Context, document: &Document) -> Result<Vec<Material>, AssetError> {
    let mut materials = Vec::with_capacity(document.root.materials.len() + 1);
    for (m, json) in document.root.materials.iter().enumerate() {
        materials.push(Reader { context, document, field: format!("materials[{m}]") }.material(json)?);
    }
    let mut primitives = document.root.meshes.iter().flat_map(|mesh| &mesh.primitives);
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
    fn material(&self, json: &json::Material) -> Result<Material, AssetError> {
        let pbr = &json.pbr_metallic_roughness;
        let normal_scale = json.normal_texture.as_ref().map_or(1.0, |info| info.scale);
        self.context.finite(format_args!("{}.normalTexture.scale", self.field), &[normal_scale])?;
        let extensions = json.extensions.as_ref();
        let strength = match extensions.and_then(|extensions| extensions.emissive_strength.as_ref()) {
            Some(emissive) => self.within("emissiveStrength", [emissive.emissive_strength.0], POSITIVE)?[0],
            None => 1.0,
        };
        let emissive = Vec3::from(self.within("emissiveFactor", json.emissive_factor.0, POSITIVE)?);
        let emissive = emissive * strength;
        self.context.finite(format_args!("{}.emissiveFactor", self.field), &emissive.to_array())?;
        let cutoff = self.within("alphaCutoff", [json.alpha_cutoff.unwrap_or_default().0], POSITIVE)?[0];
        let here = format!("{}.alphaMode", self.field);
        let alpha_mode = match self.document.code(&here, &json.alpha_mode) {
            Ok(json::material::AlphaMode::Opaque) => AlphaMode::Opaque,
            Ok(json::material::AlphaMode::Mask) => AlphaMode::Mask(cutoff),
            Ok(json::material::AlphaMode::Blend) => AlphaMode::Blend,
            Err(mode) => {
                let problem = format!("`{mode}` does not exist; use OPAQUE, MASK or BLEND");
                return Err(self.context.error(here, problem));
            }
        };
        let occlusion = json.occlusion_texture.as_ref().map_or(1.0, |info| info.strength.0);
        Ok(Material {
            name: json.name.clone(),
            base_color: Vec4::from(self.within("baseColorFactor", pbr.base_color_factor.0, UNIT)?),
            base_color_texture: self
                .texture("pbrMetallicRoughness.baseColorTexture", pbr.base_color_texture.as_ref())?,
            metallic: self.within("metallicFactor", [pbr.metallic_factor.0], UNIT)?[0],
            roughness: self.within("roughnessFactor", [pbr.roughness_factor.0], UNIT)?[0],
            metallic_roughness_texture: self
                .texture("pbrMetallicRoughness.metallicRoughnessTexture", pbr.metallic_roughness_texture.as_ref())?,
            normal_texture: self.normal_texture(json.normal_texture.as_ref())?,
            normal_scale,
            occlusion_texture: self.occlusion_texture(json.occlusion_texture.as_ref())?,
            occlusion_strength: self.within("occlusionTexture.strength", [occlusion], UNIT)?[0],
            emissive,
            emissive_texture: self.texture("emissiveTexture", json.emissive_texture.as_ref())?,
            alpha_mode,
            double_sided: json.double_sided,
            unlit: extensions.is_some_and(|extensions| extensions.unlit.is_some()),
            extensions: match extensions {
                Some(extensions) => material_extension::read(self, &extensions.others)?,
                None => MaterialExtensions::default(),
            },
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

    fn normal_texture(&self, json: Option<&json::material::NormalTexture>) -> Result<Option<TextureRef>, AssetError> {
        let Some(json) = json else { return Ok(None) };
        let others = json.extensions.as_ref().map(|extensions| &extensions.others);
        let transform = self.transform("normalTexture", others)?;
        self.reference("normalTexture", json.index.value(), json.tex_coord, transform.as_ref())
    }

    fn occlusion_texture(
        &self,
        json: Option<&json::material::OcclusionTexture>,
    ) -> Result<Option<TextureRef>, AssetError> {
        let Some(json) = json else { return Ok(None) };
        let others = json.extensions.as_ref().map(|extensions| &extensions.others);
        let transform = self.transform("occlusionTexture", others)?;
        self.reference("occlusionTexture", json.index.value(), json.tex_coord, transform.as_ref())
    }

    /// KHR_texture_transform, where the crate has no type for it.
    fn transform(
        &self,
        name: &str,
        others: Option<&Map<String, Value>>,
    ) -> Result<Option<TextureTransform>, AssetError> {
        let Some(value) = others.and_then(|others| others.get("KHR_texture_transform")) else { return Ok(None) };
        let broken = |error| {
            let name = format!("{name}.extensions.KHR_texture_transform");
            self.error(&name, &format!("{error}; export it again"))
        };
        TextureTransform::deserialize(value).map(Some).map_err(broken)
    }

    /// `None`, with a warning, for a texture without an image.
    pub(super) fn texture(&self, name: &str, info: Option<&Info>) -> Result<Option<TextureRef>, AssetError> {
        let Some(info) = info else { return Ok(None) };
        let transform = info.extensions.as_ref().and_then(|extensions| extensions.texture_transform.as_ref());
        self.reference(name, info.index.value(), info.tex_coord, transform)
    }

    fn reference(
        &self,
        name: &str,
        texture: usize,
        tex_coord: u32,
        transform: Option<&TextureTransform>,
    ) -> Result<Option<TextureRef>, AssetError> {
        let (context, textures) = (self.context, &self.document.root.textures);
        let field = format!("{}.{name}", self.field);
        context.index(format_args!("{field}.index"), texture, "textures", textures.len())?;
        if present(textures[texture].source).is_none() {
            let problem = format!("textures[{texture}] has no PNG or JPEG image; the factor alone is shown");
            context.warn(field, problem);
            return Ok(None);
        }
        let set = transform.and_then(|transform| transform.tex_coord).unwrap_or(tex_coord);
        let uv_set = if (set as usize) < MAX_UV_SETS {
            set
        } else {
            context.warn(&field, format_args!("uses TEXCOORD_{set}, which is not kept; TEXCOORD_0 is used"));
            0
        };
        let TextureTransform { offset, rotation, scale, .. } = transform.cloned().unwrap_or_default();
        let (offset, rotation, scale) = (Vec2::from(offset.0), rotation.0, Vec2::from(scale.0));
        context.finite(
            format_args!("{field}.extensions.KHR_texture_transform"),
            &[offset.x, offset.y, rotation, scale.x, scale.y],
        )?;
        Ok(Some(TextureRef { texture, uv_set, offset, rotation, scale }))
    }

    /// `extras.vair` overlaid by `extensions.VAIR_material`.
    fn vair(&self, json: &json::Material) -> Option<Map<String, Value>> {
        let extras = json.extras.as_ref().and_then(|extras| serde_json::from_str::<Value>(extras.get()).ok());
        let extras = extras.as_ref().and_then(|extras| extras.get("vair"));
        let extension = json.extensions.as_ref().and_then(|extensions| extensions.others.get("VAIR_material"));
        let sources = [("extras.vair", extras), ("extensions.VAIR_material", extension)];
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
