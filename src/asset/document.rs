//! A glTF 2.0 document in the `gltf` crate's types.
//!
//! They only say what the JSON may look like. Indices are unchecked here and floats may be infinite (1e39 overflows 32
//! bits): each reader checks what it takes. The crate's own validation is not used because it panics on some files. What
//! it refuses or loses without need, [`mend`] keeps.

use super::AssetError;
use super::context::{Context, shorten};
use super::mend::{self, NO_INDEX, Unknown};
use ::gltf::json::extensions::scene::khr_lights_punctual::Light;
use ::gltf::json::extensions::scene::khr_materials_variants::Variant;
use ::gltf::json::validation::Checked;
use ::gltf::json::{Index, Root};
use serde::Deserialize;

/// Read before all else, so that a glTF 1.0 file is refused for what it is.
#[derive(Deserialize)]
struct Version {
    asset: AssetVersion,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct AssetVersion {
    version: String,
    min_version: Option<String>,
}

/// Refuses what is no glTF 2.
///
/// # Errors
/// Broken JSON; another version.
pub(super) fn check_version(context: &Context, json: &[u8]) -> Result<(), AssetError> {
    let Version { asset } = serde_json::from_slice(json).map_err(|error| broken(context, error))?;
    for text in std::iter::once(&asset.version).chain(&asset.min_version) {
        if text.split('.').next() != Some("2") {
            return Err(context.error("asset.version", format_args!("{text} is not read; convert the file to 2.0")));
        }
    }
    Ok(())
}

fn broken(context: &Context, error: impl std::fmt::Display) -> AssetError {
    context.error("JSON", format_args!("{error}; repair or export it again"))
}

/// A document, and what the types could not hold of it.
pub(super) struct Document {
    pub(super) root: Root,
    unknown: Unknown,
}

/// Bytes of a name that are kept. Names are copied into messages, labels and lists; a longer one tells no more.
const MAX_NAME_BYTES: usize = 256;

impl Document {
    /// Gives JSON its shape. Names longer than [`MAX_NAME_BYTES`] are cut, with a warning for each list.
    ///
    /// # Errors
    /// Broken JSON, or values of another type than their field's.
    pub(super) fn parse(context: &Context, json: &[u8]) -> Result<Self, AssetError> {
        let (tree, unknown) = mend::parse(json).map_err(|error| broken(context, error))?;
        let root = serde_path_to_error::deserialize(tree).map_err(|error| broken(context, error))?;
        let mut document = Self { root, unknown };
        document.shorten_names(context);
        Ok(document)
    }

    fn shorten_names(&mut self, context: &Context) {
        fn cut<'a>(context: &Context, list: &str, names: impl Iterator<Item = &'a mut String>) {
            let long = names.filter_map(|name| shorten(name, MAX_NAME_BYTES).then_some(())).count();
            if long > 0 {
                context.warn(list, format_args!("{long} names are longer than {MAX_NAME_BYTES} bytes; they are cut"));
            }
        }
        let Root { scenes, nodes, meshes, materials, images, cameras, animations, extensions, .. } = &mut self.root;
        cut(context, "scenes", scenes.iter_mut().filter_map(|scene| scene.name.as_mut()));
        cut(context, "nodes", nodes.iter_mut().filter_map(|node| node.name.as_mut()));
        cut(context, "meshes", meshes.iter_mut().filter_map(|mesh| mesh.name.as_mut()));
        cut(context, "materials", materials.iter_mut().filter_map(|material| material.name.as_mut()));
        cut(context, "images", images.iter_mut().filter_map(|image| image.name.as_mut()));
        cut(context, "cameras", cameras.iter_mut().filter_map(|camera| camera.name.as_mut()));
        cut(context, "animations", animations.iter_mut().filter_map(|animation| animation.name.as_mut()));
        let Some(extensions) = extensions else { return };
        let lights = extensions.khr_lights_punctual.iter_mut().flat_map(|extension| &mut extension.lights);
        cut(context, "lights", lights.filter_map(|light| light.name.as_mut()));
        let variants = extensions.khr_materials_variants.iter_mut().flat_map(|extension| &mut extension.variants);
        cut(context, "variants", variants.map(|variant| &mut variant.name));
    }

    /// KHR_lights_punctual.
    pub(super) fn lights(&self) -> &[Light] {
        let extensions = self.root.extensions.as_ref().and_then(|extensions| extensions.khr_lights_punctual.as_ref());
        extensions.map_or(&[], |extension| &extension.lights)
    }

    /// KHR_materials_variants.
    pub(super) fn variants(&self) -> &[Variant] {
        let extensions = self.root.extensions.as_ref();
        let variants = extensions.and_then(|extensions| extensions.khr_materials_variants.as_ref());
        variants.map_or(&[], |extension| &extension.variants)
    }

    /// The code at `field`, or what the file has there instead of one.
    pub(super) fn code<T: Copy>(&self, field: &str, code: &Checked<T>) -> Result<T, &str> {
        match code {
            Checked::Valid(code) => Ok(*code),
            Checked::Invalid => Err(self.unknown.get(field).map_or("", String::as_str)),
        }
    }

    /// Names directly under `field` that the types do not know.
    pub(super) fn unknown_names(&self, field: &str) -> impl Iterator<Item = &str> {
        let prefix = format!("{field}.");
        let from = self.unknown.range(prefix.clone()..);
        from.take_while(move |(path, _)| path.starts_with(&prefix)).map(|(_, name)| name.as_str())
    }
}

/// An index that may be absent although its type has no word for that.
pub(super) fn present<T>(index: Index<T>) -> Option<usize> {
    Some(index.value()).filter(|value| *value != NO_INDEX as usize)
}
