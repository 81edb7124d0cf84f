//! The entry: a path to an [`Asset`].

use super::accessor::Accessors;
use super::context::Context;
use super::document::{self, Document};
use super::mesh::Meshes;
use super::{
    Asset, AssetError, Material, animation, camera, container, extension, light, material, node, skin, texture, uri,
};
use ::gltf::json;
use std::path::Path;

/// Default of [`LoadOptions::memory_limit_bytes`]: 4 GiB.
pub const DEFAULT_MEMORY_LIMIT_BYTES: u64 = 4 << 30;

/// What a file may do while it loads.
#[derive(Debug, Clone)]
pub struct LoadOptions {
    /// Buffers and images may lie outside the folder of the file. Default: false.
    pub allow_outside: bool,
    /// Sum of the file's size and of everything decoded from it. Default:
    /// [`DEFAULT_MEMORY_LIMIT_BYTES`].
    pub memory_limit_bytes: u64,
}

impl Default for LoadOptions {
    fn default() -> Self {
        Self { allow_outside: false, memory_limit_bytes: DEFAULT_MEMORY_LIMIT_BYTES }
    }
}

/// Loads a `.gltf` or `.glb` file with its buffers and images.
///
/// # Errors
/// See [`AssetError`]: each error names the file, the field and what to do.
///
/// # Examples
/// ```no_run
/// use vair::asset::{LoadOptions, load};
///
/// let asset = load("Fox.glb".as_ref(), &LoadOptions::default())?;
/// println!("{} meshes, {} clips", asset.meshes.len(), asset.animations.len());
/// # Ok::<(), vair::asset::AssetError>(())
/// ```
pub fn load(path: &Path, options: &LoadOptions) -> Result<Asset, AssetError> {
    let context = Context::new(path, options);
    let bytes = uri::read_file(path, options.memory_limit_bytes)?;
    context.spend("file", bytes.len() as u64)?;
    let mut asset = parse(&context, &bytes)?;
    asset.loaded_bytes = context.spent_bytes();
    asset.warnings = context.into_warnings();
    Ok(asset)
}

/// What an object costs at most, as the document has it (a growing list holds up to two of each) and as the asset does:
/// that of a material, the largest.
const OBJECT_BYTES: u64 = 2 * size_of::<json::Material>() as u64 + size_of::<Material>() as u64;

/// What any other value costs at most, wherever it ends up: a joint with its matrix, or an entry of a growing object,
/// which holds up to two of each, their hashes and places.
const VALUE_BYTES: u64 = 2 * (size_of::<(String, serde_json::Value)>() as u64 + 16);

/// Bytes that a JSON text may become, counted before it becomes them: a few characters make a whole material.
fn json_bytes(json: &[u8]) -> u64 {
    let (mut objects, mut values) = (0u64, 0u64);
    let (mut in_string, mut escaped) = (false, false);
    for byte in json {
        match (in_string, byte) {
            (true, _) if escaped => escaped = false,
            (true, b'\\') => escaped = true,
            (_, b'"') => in_string = !in_string,
            (false, b'{') => objects += 1,
            (false, b'[' | b',' | b':') => values += 1,
            _ => {}
        }
    }
    // The strings are copied once.
    json.len() as u64 + objects * OBJECT_BYTES + values * VALUE_BYTES
}

fn parse(context: &Context, bytes: &[u8]) -> Result<Asset, AssetError> {
    let container = container::split(context, bytes)?;
    document::check_version(context, container.json)?;
    context.spend("JSON", json_bytes(container.json))?;
    let document = Document::parse(context, container.json)?;
    extension::check(context, &document)?;

    let nodes = node::read(context, &document)?;
    let (scenes, default_scene) = node::read_scenes(context, &document)?;
    let accessors = Accessors::new(context, &document, container.binary)?;
    let textures = texture::read(context, &document)?;
    let materials = material::read(context, &document)?;
    let skins = skin::read(context, &document, &accessors)?;
    let meshes = Meshes { context, document: &document, accessors: &accessors, materials: &materials }.read()?;
    let animations = animation::read(context, &document, &accessors)?;
    let images = texture::read_images(context, &document, &accessors, &materials, &textures)?;
    let variants = document.variants().iter().map(|variant| variant.name.clone()).collect();
    Ok(Asset {
        scenes,
        default_scene,
        nodes,
        meshes,
        materials,
        textures,
        images,
        cameras: camera::read(context, &document)?,
        lights: light::read(context, &document)?,
        skins,
        animations,
        variants,
        warnings: Vec::new(),
        loaded_bytes: 0,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::asset::{Camera, Channel, Node, Primitive};

    #[test]
    fn no_object_costs_more_than_is_charged() {
        let cost = |in_document: usize, in_asset: usize| (2 * in_document + in_asset) as u64;
        for bytes in [
            cost(size_of::<json::Node>(), size_of::<Node>()),
            cost(size_of::<json::mesh::Primitive>(), size_of::<Primitive>()),
            cost(size_of::<json::animation::Channel>(), size_of::<Channel>()),
            cost(size_of::<json::Camera>(), size_of::<Camera>()),
            cost(size_of::<json::Accessor>(), 0),
        ] {
            assert!(bytes <= OBJECT_BYTES, "{bytes} over {OBJECT_BYTES}");
        }
    }

    #[test]
    fn text_counts_values_and_skips_strings() {
        assert_eq!(json_bytes(b"\"{,\\\"{:\""), 8);
        assert_eq!(json_bytes(b"[{},{}]"), 7 + 2 * OBJECT_BYTES + 2 * VALUE_BYTES);
    }
}
