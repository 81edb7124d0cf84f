//! Textures that looks bring along: their syntax, and the list of images that they append to an asset.

use super::kind::{TextureSource, wrong_type};
use super::nearest::nearest;
use super::parameter::{Parameter, ParameterError};
use super::procedural;
use super::value::Value;
use crate::asset::{self, Asset, Image, MAX_UV_SETS, Sampler, TextureRef};
use glam::Vec2;
use std::collections::HashMap;

/// Which image a texture shows.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum ImageName {
    /// A file, relative to the folder of the look or scene.
    File(String),
    /// One of [`procedural::ALL`].
    Procedural(String),
}

/// Reads an image file that a look names; the error is one line. The caller decides which folders may be read.
pub type ReadImage<'a> = &'a mut dyn FnMut(&str) -> Result<Image, String>;

const KEYS: [&str; 6] = ["file", "procedural", "tiling", "offset", "rotation", "uv_set"];

/// Reads the syntax of a texture, see [`Map`](super::kind::Map).
pub(crate) fn read(
    value: &Value,
    parameter: &Parameter,
    textures: &mut dyn TextureSource,
) -> Result<TextureRef, ParameterError> {
    let fail = |reason: String| ParameterError::Texture { key: parameter.name.to_owned(), reason };
    let mut reference = TextureRef { texture: 0, uv_set: 0, offset: Vec2::ZERO, rotation: 0.0, scale: Vec2::ONE };
    let mut name = None;
    match value {
        Value::Text(file) => name = Some(ImageName::File(file.clone())),
        Value::Table(entries) => {
            for (key, value) in entries {
                match (key.as_str(), value) {
                    ("file", Value::Text(file)) => name = Some(ImageName::File(file.clone())),
                    ("procedural", Value::Text(pattern)) => name = Some(ImageName::Procedural(pattern.clone())),
                    ("tiling", _) => reference.scale = pair(value).ok_or_else(|| fail(malformed(key, value)))?,
                    ("offset", _) => reference.offset = pair(value).ok_or_else(|| fail(malformed(key, value)))?,
                    ("rotation", Value::Number(degrees)) if (*degrees as f32).is_finite() => {
                        reference.rotation = (*degrees as f32).to_radians();
                    }
                    ("uv_set", Value::Number(set)) if set.fract() == 0.0 && (0.0..MAX_UV_SETS as f64).contains(set) => {
                        reference.uv_set = *set as u32;
                    }
                    _ if KEYS.contains(&key.as_str()) => return Err(fail(malformed(key, value))),
                    _ => {
                        let near = nearest(key, KEYS).map(|name| format!(", did you mean `{name}`?"));
                        return Err(fail(format!("unknown texture key `{key}`{}", near.unwrap_or_default())));
                    }
                }
            }
        }
        _ => return Err(wrong_type(parameter, value)),
    }
    if let Value::Table(entries) = value {
        let has = |wanted: &str| entries.iter().any(|(key, _)| key == wanted);
        if has("file") && has("procedural") {
            return Err(fail("a texture has `file` or `procedural`, not both".to_owned()));
        }
    }
    let name = name.ok_or_else(|| fail("a texture needs `file` or `procedural`".to_owned()))?;
    reference.texture = textures.texture(&name).map_err(fail)?;
    Ok(reference)
}

fn malformed(key: &str, value: &Value) -> String {
    let expected = match key {
        "file" => "the name of a PNG or JPEG file".to_owned(),
        "procedural" => format!("one of {}", procedural::names().collect::<Vec<_>>().join(", ")),
        "rotation" => "degrees".to_owned(),
        "uv_set" => format!("0 to {}", MAX_UV_SETS - 1),
        _ => "a number or [u, v]".to_owned(),
    };
    format!("texture key `{key}` is {}, but takes {expected}", value.kind())
}

/// Two finite numbers, or one for both.
fn pair(value: &Value) -> Option<Vec2> {
    let pair = match value {
        Value::Number(both) => Vec2::splat(*both as f32),
        Value::List(items) => match items.as_slice() {
            [Value::Number(u), Value::Number(v)] => Vec2::new(*u as f32, *v as f32),
            _ => return None,
        },
        _ => return None,
    };
    pair.is_finite().then_some(pair)
}

/// Appends the images of looks to the lists of an asset, each once.
pub(crate) struct Appended<'a> {
    images: &'a mut Vec<Image>,
    textures: &'a mut Vec<asset::Texture>,
    read_image: ReadImage<'a>,
    known: HashMap<ImageName, usize>,
}

impl<'a> Appended<'a> {
    pub(crate) fn new(asset: &'a mut Asset, read_image: ReadImage<'a>) -> Self {
        Self { images: &mut asset.images, textures: &mut asset.textures, read_image, known: HashMap::new() }
    }
}

impl TextureSource for Appended<'_> {
    fn texture(&mut self, name: &ImageName) -> Result<usize, String> {
        if let Some(&texture) = self.known.get(name) {
            return Ok(texture);
        }
        let image = match name {
            ImageName::File(file) => (self.read_image)(file)?,
            ImageName::Procedural(pattern) => procedural::image(pattern).ok_or_else(|| {
                let near = nearest(pattern, procedural::names()).map(|name| format!(", did you mean `{name}`?"));
                let known = || format!("; there are {}", procedural::names().collect::<Vec<_>>().join(", "));
                format!("unknown procedural image `{pattern}`{}", near.unwrap_or_else(known))
            })?,
        };
        let texture = self.textures.len();
        self.textures.push(asset::Texture { image: self.images.len(), sampler: Sampler::default() });
        self.images.push(image);
        self.known.insert(name.clone(), texture);
        Ok(texture)
    }
}
