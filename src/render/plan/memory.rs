//! What a plan takes on the device, known before the device is asked.

use super::{Plan, TextureUse};
use crate::asset::Asset;
use crate::gpu::{format_bytes, level_size};
use crate::render::FrameOptions;
use crate::render::device_scene::{ABSENT, Stream};
use crate::render::light::environment_bytes;
use crate::render::pass::oit_resolve::Lists;
use crate::render::picture::{PICTURE_FORMAT, PICTURE_NAME, skybox_bytes};
use crate::scene::Scene;
use ash::vk;
use std::collections::BTreeMap;

/// Name of a primitive's stream on the device.
pub fn stream_name(asset: &Asset, index: (usize, usize), stream: Stream) -> String {
    primitive_name(asset, index, &format!("{stream:?}"))
}

/// Name of a primitive's index list on the device.
pub fn index_name(asset: &Asset, index: (usize, usize)) -> String {
    primitive_name(asset, index, "indices")
}

fn primitive_name(asset: &Asset, (mesh, primitive): (usize, usize), what: &str) -> String {
    format!("{what} of {}.{primitive}", asset.meshes[mesh].name.as_deref().unwrap_or("mesh"))
}

impl TextureUse {
    /// Bytes of all mip levels, down to one texel.
    pub fn bytes(&self, asset: &Asset) -> u64 {
        let image = &asset.images[self.image];
        let size = [image.width, image.height].map(|side| side.max(1));
        let levels = 32 - size[0].max(size[1]).leading_zeros();
        (0..levels).filter_map(|level| format_bytes(vk::Format::R8G8B8A8_UNORM, level_size(size, level))).sum()
    }
}

impl Plan {
    /// Bytes by the name of what holds them on the device, names ascending; those of one name are summed. Uniform blocks
    /// and what poses need, a few bytes an object, are not in it; nor what the device adds for alignment.
    pub fn memory(&self, scene: &Scene, options: &FrameOptions) -> BTreeMap<String, u64> {
        let asset = scene.asset();
        let mut owners = BTreeMap::new();
        let mut add = |name: String, bytes: u64| *owners.entry(name).or_default() += bytes;
        for (&index, streams) in &self.streams {
            for &stream in streams {
                add(stream_name(asset, index, stream), self.bytes_of_stream(asset, index, stream));
            }
            add(index_name(asset, index), self.bytes_of_indices(asset, index));
        }
        for texture in &self.textures {
            add(asset.images[texture.image].name.clone(), texture.bytes(asset));
        }
        for fallback in &self.fallbacks {
            add(format!("{fallback:?}"), size_of_val(&fallback.texel()) as u64);
        }
        for table in self.tables.values() {
            add(table.name.to_owned(), table.texels.len() as u64);
        }
        if self.has_absent_streams {
            add("absent stream".to_owned(), size_of_val(&ABSENT) as u64);
        }
        for attachment in &self.attachments {
            add(attachment.name.to_owned(), attachment.bytes(options.size));
        }
        for (name, format, size) in self.shadow_images() {
            add(name.to_owned(), format_bytes(format, size).unwrap_or(0));
        }
        if self.builds_lists() {
            for (name, bytes) in Lists::first_bytes(options.size) {
                add(name.to_owned(), bytes);
            }
        }
        let environment = &options.environment.map;
        if self.is_lit() {
            let maps = environment_bytes(environment, &options.environment_quality, self.binds_lobes());
            maps.for_each(|(name, bytes)| add(name.to_owned(), bytes));
        }
        if options.shows_environment() {
            let (name, bytes) = skybox_bytes(environment);
            add(name.to_owned(), bytes);
        }
        add(PICTURE_NAME.to_owned(), format_bytes(PICTURE_FORMAT, options.size).unwrap_or(0));
        owners
    }
}
