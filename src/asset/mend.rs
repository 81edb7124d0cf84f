//! The pre-pass: JSON text to a tree that the `gltf` crate's types take.
//!
//! Those types refuse some plain files and lose what messages name. So:
//! - The tree holds what vair reads, [`READ`]. All else is skipped, of whatever type, depth or encoding it is.
//! - `null` means absent, and lists that the types require may be absent ([`Branch::complete`]).
//! - Indices and codes, which the types cut to 32 bits, are bounded by [`LARGEST_INDEX`] instead.
//! - Codes and names that the types know only as invalid are kept beside the tree, for the message ([`Unknown`]).

use super::context::shorten;
use super::extension;
use ::gltf::json::extensions::scene::khr_lights_punctual;
use ::gltf::json::mesh::{Semantic, VALID_MODES, VALID_MORPH_TARGETS};
use ::gltf::json::validation::Checked;
use ::gltf::json::{accessor, animation, camera, material, texture};
use serde::de::value::{Error as NameError, StrDeserializer};
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, de};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::fmt;

/// What larger indices become; no list has so many entries.
pub(super) const LARGEST_INDEX: u32 = u32::MAX;

/// A texture without image, a channel without node: the types have no word for that.
pub(super) const NO_INDEX: u32 = LARGEST_INDEX - 1;

/// Bytes of a code or name that are kept for a message.
const MAX_UNKNOWN_BYTES: usize = 256;

/// Values and names that the types do not know, by the path of their field.
pub(super) type Unknown = BTreeMap<String, String>;

/// What is read of an object, by the nearest key above it. All is read of those that are not here.
const READ: [(&str, &[&str]); 37] = [
    (
        "",
        &[
            "extensionsUsed",
            "extensionsRequired",
            "scene",
            "scenes",
            "nodes",
            "meshes",
            "accessors",
            "bufferViews",
            "buffers",
            "materials",
            "textures",
            "images",
            "samplers",
            "cameras",
            "skins",
            "animations",
            "extensions",
        ],
    ),
    ("scenes", &["name", "nodes"]),
    (
        "nodes",
        &[
            "name",
            "children",
            "matrix",
            "translation",
            "rotation",
            "scale",
            "mesh",
            "skin",
            "camera",
            "weights",
            "extensions",
        ],
    ),
    ("meshes", &["name", "primitives", "weights"]),
    ("primitives", &["attributes", "indices", "material", "mode", "targets", "extensions"]),
    ("accessors", &["bufferView", "byteOffset", "componentType", "normalized", "count", "type", "sparse"]),
    ("sparse", &["count", "indices", "values"]),
    ("indices", &["bufferView", "byteOffset", "componentType"]),
    ("values", &["bufferView", "byteOffset"]),
    ("bufferViews", &["buffer", "byteOffset", "byteLength", "byteStride"]),
    ("buffers", &["uri", "byteLength"]),
    (
        "materials",
        &[
            "name",
            "pbrMetallicRoughness",
            "normalTexture",
            "occlusionTexture",
            "emissiveTexture",
            "emissiveFactor",
            "alphaMode",
            "alphaCutoff",
            "doubleSided",
            "extensions",
            "extras",
        ],
    ),
    (
        "pbrMetallicRoughness",
        &["baseColorFactor", "baseColorTexture", "metallicFactor", "roughnessFactor", "metallicRoughnessTexture"],
    ),
    ("baseColorTexture", TEXTURE_INFO),
    ("metallicRoughnessTexture", TEXTURE_INFO),
    ("normalTexture", &["index", "texCoord", "extensions", "scale"]),
    ("occlusionTexture", &["index", "texCoord", "extensions", "strength"]),
    ("emissiveTexture", TEXTURE_INFO),
    ("textures", &["sampler", "source"]),
    ("images", &["name", "uri", "bufferView"]),
    // Those of textures and those of animations.
    ("samplers", &["magFilter", "minFilter", "wrapS", "wrapT", "input", "output", "interpolation"]),
    ("cameras", &["name", "type", "perspective", "orthographic"]),
    ("perspective", &["aspectRatio", "yfov", "zfar", "znear"]),
    ("orthographic", &["xmag", "ymag", "zfar", "znear"]),
    ("skins", &["joints", "inverseBindMatrices"]),
    ("animations", &["name", "channels", "samplers"]),
    ("channels", &["sampler", "target"]),
    ("target", &["node", "path"]),
    ("KHR_lights_punctual", &["lights", "light"]),
    ("lights", &["name", "color", "intensity", "range", "type", "spot"]),
    ("spot", &["innerConeAngle", "outerConeAngle"]),
    ("KHR_materials_variants", &["variants", "mappings"]),
    ("variants", &["name"]),
    ("mappings", &["material", "variants"]),
    ("KHR_materials_unlit", &[]),
    ("KHR_materials_emissive_strength", &["emissiveStrength"]),
    ("KHR_texture_transform", &["offset", "rotation", "scale", "texCoord"]),
];

const TEXTURE_INFO: &[&str] = &["index", "texCoord", "extensions"];

/// Keys whose numbers the types keep in 32 bits; so do all of attributes and morph targets.
const IN_32_BITS: [&str; 28] = [
    "scene",
    "nodes",
    "children",
    "mesh",
    "skin",
    "camera",
    "light",
    "indices",
    "material",
    "variants",
    "mode",
    "bufferView",
    "buffer",
    "componentType",
    "sampler",
    "source",
    "index",
    "texCoord",
    "magFilter",
    "minFilter",
    "wrapS",
    "wrapT",
    "joints",
    "inverseBindMatrices",
    "input",
    "output",
    "node",
    "accessor",
];

/// Parses a whole document.
///
/// # Errors
/// Broken JSON; a key twice in one object; a buffer without length, which the types take for an empty one.
pub(super) fn parse(text: &[u8]) -> Result<(Value, Unknown), serde_json::Error> {
    let mut unknown = Unknown::new();
    let mut deserializer = serde_json::Deserializer::from_slice(text);
    let root = Branch {
        place: Place { above: None, step: Step::Root },
        object: "",
        key: "",
        is_free: false,
        unknown: &mut unknown,
    };
    let tree = root.deserialize(&mut deserializer)?;
    deserializer.end()?;
    Ok((tree, unknown))
}

/// Whether attributes of this name have a meaning, and this is its one spelling.
fn is_semantic(name: &str) -> bool {
    let name_deserializer: StrDeserializer<'_, NameError> = name.into_deserializer();
    match Checked::<Semantic>::deserialize(name_deserializer) {
        Ok(Checked::Valid(semantic)) => semantic.to_string() == name,
        _ => false,
    }
}

/// Where a value stands, as errors spell it.
#[derive(Clone, Copy)]
struct Place<'a> {
    above: Option<&'a Place<'a>>,
    step: Step<'a>,
}

#[derive(Clone, Copy)]
enum Step<'a> {
    Root,
    Key(&'a str),
    Index(usize),
}

impl fmt::Display for Place<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(above) = self.above else { return Ok(()) };
        above.fmt(f)?;
        match self.step {
            Step::Root => Ok(()),
            Step::Key(key) if above.above.is_none() => f.write_str(key),
            Step::Key(key) => write!(f, ".{key}"),
            Step::Index(index) => write!(f, "[{index}]"),
        }
    }
}

/// All codes that a field may have.
enum Codes {
    Numbers(&'static [u32]),
    Words(&'static [&'static str]),
}

/// One value of the tree under construction.
struct Branch<'a> {
    place: Place<'a>,
    /// The nearest key above the object that holds this value.
    object: &'a str,
    /// The nearest key at or above this value; `object` of what it holds.
    key: &'a str,
    /// Inside an object whose keys are any: what looks like a known field there is none.
    is_free: bool,
    unknown: &'a mut Unknown,
}

impl Branch<'_> {
    fn codes(&self) -> Option<Codes> {
        if self.is_free {
            return None;
        }
        Some(match (self.object, self.key) {
            ("accessors", "componentType") => Codes::Numbers(accessor::VALID_COMPONENT_TYPES),
            ("accessors", "type") => Codes::Words(accessor::VALID_ACCESSOR_TYPES),
            ("primitives", "mode") => Codes::Numbers(VALID_MODES),
            ("materials", "alphaMode") => Codes::Words(material::VALID_ALPHA_MODES),
            ("samplers", "magFilter") => Codes::Numbers(texture::VALID_MAG_FILTERS),
            ("samplers", "minFilter") => Codes::Numbers(texture::VALID_MIN_FILTERS),
            ("samplers", "wrapS" | "wrapT") => Codes::Numbers(texture::VALID_WRAPPING_MODES),
            ("samplers", "interpolation") => Codes::Words(animation::VALID_INTERPOLATIONS),
            ("target", "path") => Codes::Words(animation::VALID_PROPERTIES),
            ("cameras", "type") => Codes::Words(camera::VALID_CAMERA_TYPES),
            ("lights", "type") => Codes::Words(khr_lights_punctual::VALID_TYPES),
            _ => return None,
        })
    }

    fn keep_unknown(&mut self, place: Place<'_>, mut text: String) {
        shorten(&mut text, MAX_UNKNOWN_BYTES);
        self.unknown.insert(place.to_string(), text);
    }

    fn is_in_32_bits(&self) -> bool {
        matches!(self.object, "attributes" | "targets") || IN_32_BITS.contains(&self.key)
    }

    /// Fills in what the types require and glTF, or vair, does not.
    fn complete<E: Error>(&self, object: &mut Map<String, Value>) -> Result<(), E> {
        let defaults: &[(&str, Value)] = match self.key {
            "" => &[("asset", json!({ "version": "2.0" }))],
            "scenes" => &[("nodes", json!([]))],
            "animations" => &[("channels", json!([])), ("samplers", json!([]))],
            "textures" => &[("source", json!(NO_INDEX))],
            "target" => &[("node", json!(NO_INDEX))],
            // Of nodes and primitives, too, where a list more does no harm.
            "KHR_lights_punctual" => &[("lights", json!([]))],
            "KHR_materials_variants" => &[("variants", json!([])), ("mappings", json!([]))],
            "variants" => &[("name", json!(""))],
            "buffers" if !object.contains_key("byteLength") => return Err(E::missing_field("byteLength")),
            _ => &[],
        };
        for (key, value) in defaults {
            object.entry(*key).or_insert_with(|| value.clone());
        }
        Ok(())
    }
}

impl<'de> DeserializeSeed<'de> for Branch<'_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Value, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Branch<'_> {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("any JSON value")
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(mut self, value: u64) -> Result<Value, E> {
        if let Some(Codes::Numbers(known)) = self.codes()
            && !known.iter().any(|code| u64::from(*code) == value)
        {
            self.keep_unknown(self.place, value.to_string());
        }
        let is_cut = self.is_in_32_bits() && value >= NO_INDEX.into();
        Ok(if is_cut { LARGEST_INDEX.into() } else { value.into() })
    }

    fn visit_str<E>(mut self, value: &str) -> Result<Value, E> {
        if let Some(Codes::Words(known)) = self.codes()
            && !known.contains(&value)
        {
            self.keep_unknown(self.place, value.to_owned());
        }
        Ok(value.into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Value, A::Error> {
        let mut values = Vec::new();
        loop {
            let place = Place { above: Some(&self.place), step: Step::Index(values.len()) };
            let Branch { object, key, is_free, .. } = self;
            let branch = Branch { place, object, key, is_free, unknown: &mut *self.unknown };
            match list.next_element_seed(branch)? {
                Some(value) => values.push(value),
                None => return Ok(Value::Array(values)),
            }
        }
    }

    fn visit_map<A: MapAccess<'de>>(mut self, mut entries: A) -> Result<Value, A::Error> {
        let read = READ.iter().find(|(key, _)| *key == self.key).map(|(_, read)| *read);
        let is_open = matches!(self.key, "attributes" | "targets" | "extensions");
        let is_free = self.is_free || read.is_none() && !is_open;
        let mut object = Map::new();
        while let Some(key) = entries.next_key::<String>()? {
            let above = self.place;
            let place = Place { above: Some(&above), step: Step::Key(&key) };
            let is_read = match (self.key, read) {
                (_, Some(read)) => read.contains(&key.as_str()),
                ("extensions", _) => extension::READ.contains(&key.as_str()),
                ("attributes", _) if !is_free && !is_semantic(&key) => {
                    self.keep_unknown(place, key.clone());
                    false
                }
                ("targets", _) if !is_free && !VALID_MORPH_TARGETS.contains(&key.as_str()) => {
                    self.keep_unknown(place, key.clone());
                    false
                }
                _ => true,
            };
            if !is_read {
                entries.next_value::<IgnoredAny>()?;
                continue;
            }
            // The user's own words stay as they are.
            let value = if matches!(key.as_str(), "extras" | "VAIR_material") {
                entries.next_value::<Value>()?
            } else {
                let branch = Branch { place, object: self.key, key: &key, is_free, unknown: &mut *self.unknown };
                entries.next_value_seed(branch)?
            };
            // Some exporters write an empty list for an object without keys.
            let is_absent = value.is_null() && !matches!(self.key, "attributes" | "targets");
            let is_empty = is_absent || key == "extensions" && value.as_array().is_some_and(Vec::is_empty);
            if !is_empty && read.is_some() && object.contains_key(&key) {
                return Err(de::Error::custom(format_args!("duplicate field `{key}`")));
            }
            if !is_empty {
                object.insert(key, value);
            }
        }
        self.complete(&mut object)?;
        Ok(Value::Object(object))
    }
}
