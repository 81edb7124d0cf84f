//! Textures, samplers, and the images that materials really use.

use super::accessor::Accessors;
use super::context::Context;
use super::document::{Document, present};
use super::{AssetError, Image, Material, Sampler, Texture, Wrap, image, uri};
use ::gltf::json;
use ::gltf::json::texture::{MagFilter, MinFilter, WrappingMode};
use ::gltf::json::validation::Checked;

/// All textures. One without an image points to an empty image appended after the file's own.
///
/// # Errors
/// Indices out of range; filter or wrap codes that do not exist.
pub(super) fn read(context: &Context, document: &Document) -> Result<Vec<Texture>, AssetError> {
    let texture = |(t, json): (usize, &json::Texture)| {
        let field = format!("textures[{t}]");
        let image = match present(json.source) {
            Some(source) => {
                context.index(format_args!("{field}.source"), source, "images", document.root.images.len())?
            }
            None => document.root.images.len(),
        };
        let sampler = match json.sampler {
            None => Sampler::default(),
            Some(index) => {
                let (samplers, index) = (&document.root.samplers, index.value());
                context.index(format_args!("{field}.sampler"), index, "samplers", samplers.len())?;
                sampler(context, document, index, &samplers[index])?
            }
        };
        Ok(Texture { image, sampler })
    };
    document.root.textures.iter().enumerate().map(texture).collect()
}

fn sampler(
    context: &Context,
    document: &Document,
    index: usize,
    json: &json::texture::Sampler,
) -> Result<Sampler, AssetError> {
    let field = |name: &str| format!("samplers[{index}].{name}");
    let unknown = |name: &str, code: &str| context.error(field(name), format_args!("{code} does not exist"));
    let wrap = |name: &str, mode: &Checked<WrappingMode>| match document.code(&field(name), mode) {
        Ok(WrappingMode::Repeat) => Ok(Wrap::Repeat),
        Ok(WrappingMode::MirroredRepeat) => Ok(Wrap::Mirror),
        Ok(WrappingMode::ClampToEdge) => Ok(Wrap::Clamp),
        Err(code) => Err(unknown(name, code)),
    };
    let mag_filter = json.mag_filter.as_ref().map(|filter| document.code(&field("magFilter"), filter));
    let mag_linear = match mag_filter.transpose().map_err(|code| unknown("magFilter", code))? {
        None | Some(MagFilter::Linear) => true,
        Some(MagFilter::Nearest) => false,
    };
    let min_filter = json.min_filter.as_ref().map(|filter| document.code(&field("minFilter"), filter));
    let (min_linear, mip_linear) = match min_filter.transpose().map_err(|code| unknown("minFilter", code))? {
        None | Some(MinFilter::LinearMipmapLinear) => (true, Some(true)),
        Some(MinFilter::Nearest) => (false, None),
        Some(MinFilter::Linear) => (true, None),
        Some(MinFilter::NearestMipmapNearest) => (false, Some(false)),
        Some(MinFilter::LinearMipmapNearest) => (true, Some(false)),
        Some(MinFilter::NearestMipmapLinear) => (false, Some(true)),
    };
    let wrap = [wrap("wrapS", &json.wrap_s)?, wrap("wrapT", &json.wrap_t)?];
    Ok(Sampler { wrap, mag_linear, min_linear, mip_linear })
}

/// All images, decoded once each where a material uses them.
///
/// # Errors
/// A used image that is missing, broken, outside the folder or over the memory limit.
pub(super) fn read_images(
    context: &Context,
    document: &Document,
    accessors: &Accessors,
    materials: &[Material],
    textures: &[Texture],
) -> Result<Vec<Image>, AssetError> {
    let mut used = vec![false; document.root.images.len() + 1];
    for material in materials {
        let references = [
            material.base_color_texture,
            material.metallic_roughness_texture,
            material.normal_texture,
            material.occlusion_texture,
            material.emissive_texture,
        ];
        for reference in references.into_iter().flatten().chain(material.extensions.textures()) {
            used[textures[reference.texture].image] = true;
        }
    }
    let mut images = Vec::with_capacity(used.len());
    for (i, json) in document.root.images.iter().enumerate() {
        let short_uri = json.uri.as_ref().filter(|uri| !uri.starts_with("data:"));
        let name = json.name.as_ref().or(short_uri).cloned().unwrap_or_else(|| format!("image {i}"));
        if !used[i] {
            images.push(Image { name, ..Image::default() });
            continue;
        }
        let field = format!("images[{i}]");
        let image = match (&json.uri, json.buffer_view) {
            (Some(uri), _) => {
                image::decode(context, &field, &uri::read(context, &format!("{field}.uri"), uri)?, &name)?
            }
            (None, Some(view)) => image::decode(context, &field, accessors.view(&field, view.value())?, &name)?,
            (None, None) => return Err(context.error(field, "has neither uri nor bufferView; export it again")),
        };
        images.push(image);
    }
    if textures.iter().any(|texture| texture.image == document.root.images.len()) {
        images.push(Image { name: "none".to_owned(), ..Image::default() });
    }
    Ok(images)
}
