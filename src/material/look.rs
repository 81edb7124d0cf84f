//! Look files: which materials of a scene get which parameters.
//!
//! ```toml
//! [material."Fur Body"]     # glTF material name; "*" is every material, and is applied first
//! preset = "fox"            # optional start; the keys below override it
//! kind = "fur"              # or "standard", "satin", ...; left out: what the preset or the material is
//! length = 0.03
//! distribution_map = { file = "noise.png", tiling = [20, 20] }
//! surface.roughness = 0.8   # the skin, where fur has a key of the same name
//! ```
//!
//! A key belongs to the material's kind if that has such a key, otherwise to the standard surface; `surface.KEY` is always
//! the surface.

use super::error::MaterialError;
use super::kind::TextureSource;
use super::nearest::nearest;
use super::parameter::{Parameter, ParameterError, ParameterSet};
use super::preset;
use super::texture::{Appended, ReadImage};
use super::value::Value;
use super::{Family, Fur, KINDS, Material, Standard};
use crate::asset::Asset;
use toml::de::{DeTable, DeValue};

/// A look file, or a preset taken as one: read, but not yet matched against a scene.
#[derive(Debug, Clone)]
pub struct Look {
    sections: Vec<Section>,
}

/// The keys for one material.
#[derive(Debug, Clone)]
pub(crate) struct Section {
    place: String,
    /// Name of the material, `"*"`, or of the preset.
    pub(crate) material: String,
    preset: Option<Entry>,
    kind: Option<&'static str>,
    pub(crate) entries: Vec<Entry>,
    surface: Vec<Entry>,
}

/// One key.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    place: String,
    pub(crate) key: String,
    pub(crate) value: Value,
}

impl Look {
    /// Reads a look file. `source` is its name, for messages.
    ///
    /// # Errors
    /// Not TOML, a section that is not a material, an unknown preset or kind; with the line. Keys and values are judged
    /// by [`Look::apply`].
    pub fn parse(text: &str, source: &str) -> Result<Self, MaterialError> {
        let sections = sections(text, source, "material")?;
        for preset in sections.iter().filter_map(|section| section.preset.as_ref()) {
            find_preset(preset)?;
        }
        Ok(Self { sections })
    }

    /// The look that puts one preset on a material, or on all of them.
    ///
    /// # Errors
    /// No preset of that name.
    pub fn preset(name: &str, material: Option<&str>) -> Result<Self, MaterialError> {
        let place = "--preset".to_owned();
        preset::find(name, &place)?;
        let start = Entry { place: place.clone(), key: "preset".to_owned(), value: Value::Text(name.to_owned()) };
        let section = Section {
            place,
            material: material.unwrap_or("*").to_owned(),
            preset: Some(start),
            kind: None,
            entries: Vec::new(),
            surface: Vec::new(),
        };
        Ok(Self { sections: vec![section] })
    }

    /// Puts the look on the materials of a scene; images that it names are appended to the asset, each once. After an
    /// error the materials are partly changed and are not to be shown.
    ///
    /// # Errors
    /// A material that the scene lacks, an unknown key, a value of the wrong type or outside its range, an image that
    /// cannot be read; with the line and the nearest valid name.
    pub fn apply(
        &self,
        asset: &mut Asset,
        materials: &mut [Material],
        read_image: ReadImage,
    ) -> Result<(), MaterialError> {
        let mut textures = Appended::new(asset, read_image);
        let (every, named): (Vec<_>, Vec<_>) = self.sections.iter().partition(|section| section.material == "*");
        for section in every.into_iter().chain(named) {
            let mut matched = section.material == "*";
            for material in materials.iter_mut() {
                if section.material == "*" || section.material == material.name {
                    matched = true;
                    section.apply(material, &mut textures)?;
                }
            }
            if !matched {
                return Err(section.without_material(materials));
            }
        }
        Ok(())
    }
}

impl Material {
    /// Sets a parameter by its key in look files: of its fur or family, or of its surface where these have no such key.
    ///
    /// # Errors
    /// A key that a material of its kind has not, a value of the wrong type or outside its range, a texture that cannot be
    /// had.
    pub fn set(&mut self, key: &str, value: &Value, textures: &mut dyn TextureSource) -> Result<(), ParameterError> {
        let kind = self.kind();
        let has = |list: &[Parameter]| list.iter().any(|parameter| parameter.name == key);
        match (&mut self.fur, &mut self.family) {
            (Some(fur), _) if Fur::parameter(key).is_some() => fur.set(key, value, textures),
            (None, Some(cloth)) if has(cloth.parameters()) => cloth.set(key, value, textures),
            _ if Standard::parameter(key).is_some() => self.standard.set(key, value, textures),
            _ => Err(foreign(key, kind)),
        }
    }
}

impl Section {
    /// The kind that it makes of its material, if it says one: one of [`KINDS`].
    pub(crate) fn kind(&self) -> Option<&'static str> {
        self.kind
    }

    pub(crate) fn apply(&self, material: &mut Material, textures: &mut dyn TextureSource) -> Result<(), MaterialError> {
        if let Some(entry) = &self.preset {
            let preset = find_preset(entry)?;
            // A preset starts from the defaults of its kind, whatever fur or cloth was there.
            if preset.section.kind.is_some() {
                (material.fur, material.family) = (None, None);
            }
            // Cloth brings its own colour and shine, where fur shows the surface's.
            if preset.section.kind.is_some_and(|kind| Family::KINDS.contains(&kind)) {
                material.standard = material.standard.undyed();
            }
            preset.section.apply(material, textures)?;
        }
        if let Some(kind) = self.kind.filter(|kind| *kind != material.kind()) {
            material.family = Family::of_kind(kind);
            material.fur = (kind == "fur").then(Fur::default);
        }
        for entry in &self.entries {
            material.set(&entry.key, &entry.value, textures).map_err(|problem| entry.error(problem))?;
        }
        for entry in &self.surface {
            material.standard.set(&entry.key, &entry.value, textures).map_err(|problem| entry.error(problem))?;
        }
        Ok(())
    }

    fn without_material(&self, materials: &[Material]) -> MaterialError {
        const SHOWN: usize = 8;
        let mut names: Vec<_> = materials.iter().map(|material| material.name.as_str()).collect();
        let nearest = nearest(&self.material, names.iter().copied()).map(str::to_owned);
        let more = names.len() > SHOWN;
        names.truncate(SHOWN);
        let known = match names.as_slice() {
            [] => "none".to_owned(),
            names => format!("`{}`{}", names.join("`, `"), if more { " and more" } else { "" }),
        };
        MaterialError::UnknownMaterial { place: self.place.clone(), name: self.material.clone(), nearest, known }
    }

    /// Sorts one key into the section.
    fn take(&mut self, entry: Entry) -> Result<(), MaterialError> {
        match (entry.key.as_str(), &entry.value) {
            ("preset", Value::Text(_)) => self.preset = Some(entry),
            ("kind", Value::Text(kind)) => {
                let known = || KINDS.iter().map(|(kind, _)| *kind);
                self.kind = known().find(|known| known == kind);
                if self.kind.is_none() {
                    return Err(entry.error(ParameterError::NotAChoice {
                        key: "kind".to_owned(),
                        found: kind.clone(),
                        choices: known().collect(),
                        nearest: nearest(kind, known()).map(str::to_owned),
                    }));
                }
            }
            ("surface", Value::Table(keys)) => {
                for (key, value) in keys {
                    self.surface.push(Entry { place: entry.place.clone(), key: key.clone(), value: value.clone() });
                }
            }
            (key @ ("preset" | "kind" | "surface"), value) => {
                let expected = if key == "surface" { "a table of surface keys" } else { "a name" };
                return Err(entry.error(ParameterError::WrongType {
                    key: key.to_owned(),
                    expected: expected.to_owned(),
                    found: value.kind(),
                }));
            }
            _ => self.entries.push(entry),
        }
        Ok(())
    }

    fn empty(place: String, material: String) -> Self {
        Self { place, material, preset: None, kind: None, entries: Vec::new(), surface: Vec::new() }
    }
}

impl Entry {
    fn error(&self, problem: ParameterError) -> MaterialError {
        MaterialError::Parameter { place: self.place.clone(), problem }
    }
}

fn find_preset(entry: &Entry) -> Result<&'static preset::Preset, MaterialError> {
    let Value::Text(name) = &entry.value else {
        return Err(entry.error(ParameterError::WrongType {
            key: entry.key.clone(),
            expected: "a name".to_owned(),
            found: entry.value.kind(),
        }));
    };
    preset::find(name, &entry.place)
}

/// The error for a key that neither the material's kind nor the surface has.
fn foreign(key: &str, kind: &'static str) -> ParameterError {
    let has = |list: &[Parameter]| list.iter().any(|parameter| parameter.name == key);
    let kinds: Vec<_> = KINDS.iter().filter(|(_, list)| has(list)).map(|(kind, _)| *kind).collect();
    if !kinds.is_empty() {
        return ParameterError::OfOtherKind { key: key.to_owned(), kinds, kind };
    }
    let names = KINDS.iter().flat_map(|(_, list)| list.iter().map(|parameter| parameter.name));
    let names = names.chain(["preset", "kind", "surface"]);
    ParameterError::Unknown { key: key.to_owned(), nearest: nearest(key, names).map(str::to_owned) }
}

/// The look keys that a glTF material carries.
pub(crate) fn section_of_file(
    material: &str,
    keys: &serde_json::Map<String, serde_json::Value>,
) -> Result<Section, MaterialError> {
    let place = format!("material `{material}`");
    let mut section = Section::empty(place.clone(), material.to_owned());
    for (key, value) in keys {
        section.take(Entry { place: place.clone(), key: key.clone(), value: value.into() })?;
    }
    Ok(section)
}

fn unknown_section(place: String, section: &str) -> MaterialError {
    MaterialError::UnknownSection { place, section: section.to_owned() }
}

/// The sections `[HEAD.NAME]` of a file.
pub(crate) fn sections(text: &str, source: &str, head: &str) -> Result<Vec<Section>, MaterialError> {
    let place = |at: usize| {
        let line = 1 + text.bytes().take(at).filter(|&byte| byte == b'\n').count();
        format!("{source}:{line}")
    };
    let document = DeTable::parse(text).map_err(|error| MaterialError::Syntax {
        place: place(error.span().map_or(0, |span| span.start)),
        message: error.message().trim().replace('\n', ", "),
    })?;
    let mut out = Vec::new();
    for (key, value) in document.get_ref().iter() {
        let DeValue::Table(named) = value.get_ref() else {
            return Err(unknown_section(place(key.span().start), key.get_ref()));
        };
        if key.get_ref() != head {
            return Err(unknown_section(place(key.span().start), key.get_ref()));
        }
        for (name, value) in named.iter() {
            let place_of_name = place(name.span().start);
            let DeValue::Table(keys) = value.get_ref() else {
                return Err(unknown_section(place_of_name, &format!("{head}.{}", name.get_ref())));
            };
            let mut section = Section::empty(place_of_name, name.get_ref().to_string());
            for (key, value) in keys.iter() {
                section.take(Entry {
                    place: place(key.span().start),
                    key: key.get_ref().to_string(),
                    value: value.get_ref().into(),
                })?;
            }
            out.push(section);
        }
    }
    Ok(out)
}
