//! Textures, samplers, and the images that materials really use.

use super::accessor::Accessors;
use super::context::Context;
use super::document::Document;
use super::{AssetError, Image, Material, Sampler, Texture, Wrap, image, uri};

/// All textures. One without an image points to an empty image appended after the file's own.
///
/// # Errors
/// Indices out of range; filter or wrap codes that do not exist.
pub(super) fn read(context: &Context, document: &Document) -> Result<Vec<Texture>, AssetError> {
    let texture = |(t, json): (usize, &super::document::Texture)| {
        let field = format!("textures[{t}]");
        let image = match json.source {
            Some(source) => context.index(format_args!("{field}.source"), source, "images", document.images.len())?,
            None => document.images.len(),
        };
        let sampler = match json.sampler {
            None => Sampler::default(),
            Some(s) => {
                context.index(format_args!("{field}.sampler"), s, "samplers", document.samplers.len())?;
                sampler(context, s, &document.samplers[s])?
            }
        };
        Ok(Texture { image, sampler })
    };
    document.textures.iter().enumerate().map(texture).collect()
}

fn sampler(context: &Context, index: usize, json: &super::document::Sampler) -> Result<Sampler, AssetError> {
    let field = format!("samplers[{index}]");
    let unknown =
        |name: &str, code| context.error(format_args!("{field}.{name}"), format_args!("{code} does not exist"));
    let wrap = |name, code| match code {
        None | Some(10497) => Ok(Wrap::Repeat),
        Some(33648) => Ok(Wrap::Mirror),
        Some(33071) => Ok(Wrap::Clamp),
        Some(code) => Err(unknown(name, code)),
    };
    let mag_linear = match json.mag_filter {
        None | Some(9729) => true,
        Some(9728) => false,
        Some(code) => return Err(unknown("magFilter", code)),
    };
    let (min_linear, mip_linear) = match json.min_filter {
        None | Some(9987) => (true, Some(true)),
        Some(9728) => (false, None),
        Some(9729) => (true, None),
        Some(9984) => (false, Some(false)),
        Some(9985) => (true, Some(false)),
        Some(9986) => (false, Some(true)),
        Some(code) => return Err(unknown("minFilter", code)),
    };
    let wrap = [wrap("wrapS", json.wrap_s)?, wrap("wrapT", json.wrap_t)?];
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
    let mut used = vec![false; document.images.len() + 1];
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
    for (i, json) in document.images.iter().enumerate() {
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
            (None, Some(view)) => image::decode(context, &field, accessors.view(&field, view)?, &name)?,
            (None, None) => return Err(context.error(field, "has neither uri nor bufferView; export it again")),
        };
        images.push(image);
    }
    if textures.iter().any(|texture| texture.image == document.images.len()) {
        images.push(Image { name: "none".to_owned(), ..Image::default() });
    }
    Ok(images)
}
