//! Presets: looks with a name, in the same syntax as look files.

use super::error::MaterialError;
use super::look::{Section, sections};
use super::nearest::nearest;
use super::value::Value;
use std::sync::OnceLock;

/// A look with a name.
#[derive(Debug, Clone)]
pub struct Preset {
    /// Name; hyphens and spaces are the same when it is asked for.
    pub name: String,
    /// One line.
    pub help: String,
    pub(crate) section: Section,
}

impl Preset {
    /// Its name with hyphens, as command lines and files have it.
    pub fn hyphenated(&self) -> String {
        self.name.replace(' ', "-")
    }

    /// The kind of material that it makes, one of [`KINDS`](super::KINDS).
    pub fn kind(&self) -> &'static str {
        self.section.kind().unwrap_or("standard")
    }

    /// Whether it is what `name` asks for: hyphens, spaces and case are the same.
    pub fn is_named(&self, name: &str) -> bool {
        let plain = |name: &str| name.trim().to_lowercase().replace(['-', '_'], " ");
        plain(&self.name) == plain(name)
    }

    /// The keys that it sets, with their values.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, &Value)> {
        self.section.entries.iter().map(|entry| (entry.key.as_str(), &entry.value))
    }
}

/// All presets.
pub fn presets() -> &'static [Preset] {
    static PRESETS: OnceLock<Vec<Preset>> = OnceLock::new();
    PRESETS.get_or_init(|| {
        // A test of this module keeps the embedded file free of errors.
        let all = sections(include_str!("presets.toml"), "presets.toml", "preset").unwrap_or_default();
        all.into_iter()
            .map(|mut section| {
                let mut help = String::new();
                section.entries.retain(|entry| match (entry.key.as_str(), &entry.value) {
                    ("help", Value::Text(text)) => {
                        help.clone_from(text);
                        false
                    }
                    _ => true,
                });
                Preset { name: section.material.clone(), help, section }
            })
            .collect()
    })
}

/// The preset of that name.
pub(crate) fn find(name: &str, place: &str) -> Result<&'static Preset, MaterialError> {
    presets().iter().find(|preset| preset.is_named(name)).ok_or_else(|| {
        let names = || presets().iter().map(|preset| preset.name.as_str());
        MaterialError::UnknownPreset {
            place: place.to_owned(),
            name: name.to_owned(),
            nearest: nearest(name, names()).map(str::to_owned),
            known: names().collect::<Vec<_>>().join(", "),
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_embedded_file_has_no_errors() {
        let all = sections(include_str!("presets.toml"), "presets.toml", "preset").unwrap();
        assert_eq!(all.len(), presets().len());
        for preset in presets() {
            assert!(!preset.help.is_empty(), "{} has no help", preset.name);
        }
    }

    #[test]
    fn names_are_found_with_hyphens_and_spaces() {
        assert_eq!(find("Plush-Toy", "test").unwrap().name, "plush toy");
        let error = find("foks", "--preset").unwrap_err().to_string();
        assert_eq!(error, "--preset: unknown preset `foks`, did you mean `fox`?");
    }
}
