//! What names a shader: its file and a set of defines.

use super::{Shader, table};
use std::fmt;
use std::ops::BitOr;

include!(concat!(env!("OUT_DIR"), "/shader_key.rs"));

/// Names one line of `shaders_glsl/permutations`, or a combination that has none. Displayed as
/// `<file>[+DEFINE...]`, for example `standard.frag+UV+COLOR`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ShaderKey {
    /// The file with the entry point.
    pub file: ShaderFile,
    /// What is defined when it is compiled.
    pub defines: Defines,
}

impl ShaderKey {
    /// The shader of `file` with `defines`.
    pub const fn new(file: ShaderFile, defines: Defines) -> Self {
        Self { file, defines }
    }

    /// The compiled shader, or `None` where `shaders_glsl/permutations` does not list it.
    pub fn find(self) -> Option<&'static Shader> {
        let index = table::ALL.binary_search_by_key(&self, |(key, _)| *key).ok()?;
        Some(&table::ALL[index].1)
    }

    /// The compiled shader.
    ///
    /// # Panics
    /// When `shaders_glsl/permutations` does not list it; a test walks every combination that a frame plan makes.
    pub fn shader(self) -> &'static Shader {
        self.find().unwrap_or_else(|| panic!("shaders_glsl/permutations has no line for {self}"))
    }
}

impl fmt::Display for ShaderKey {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.file.name())?;
        self.defines.names().try_for_each(|name| write!(formatter, "+{name}"))
    }
}

/// A set of defines, of those that `shaders_glsl/permutations` has.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Defines(pub(super) u64);

impl Defines {
    /// No define.
    pub const NONE: Self = Self(0);

    /// These and, where `holds`, those.
    pub const fn with(self, defines: Self, holds: bool) -> Self {
        if holds { Self(self.0 | defines.0) } else { self }
    }

    /// Whether all of `defines` are among these.
    pub const fn contains(self, defines: Self) -> bool {
        self.0 & defines.0 == defines.0
    }

    /// What is in both.
    pub const fn intersection(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Names, in the order of the list's lines.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        (0..).zip(Self::NAMES).filter(move |(bit, _)| self.0 >> bit & 1 == 1).map(|(_, name)| name)
    }
}

impl BitOr for Defines {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl fmt::Debug for Defines {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.names().collect::<Vec<_>>().join("+"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_go_by_the_names_of_the_list() {
        let key = ShaderKey::new(ShaderFile::StandardFrag, Defines::COLOR | Defines::UV);
        assert_eq!(key.to_string(), "standard.frag+UV+COLOR");
        assert_eq!((key.file.name(), key.file.stem()), ("standard.frag", "standard"));
        assert_eq!(key.shader().name, "standard.frag+UV+COLOR");
        assert_eq!(ShaderKey::new(ShaderFile::StrandDynamicsComp, Defines::UV).find().map(|shader| shader.name), None);
    }

    #[test]
    fn every_key_finds_its_shader() {
        assert!(table::ALL.is_sorted_by(|(a, _), (b, _)| a < b));
        for (key, shader) in table::ALL {
            assert_eq!(key.shader().name, shader.name);
            assert_eq!(key.to_string(), shader.name);
        }
    }

    #[test]
    fn defines_are_a_set() {
        let both = Defines::NONE.with(Defines::UV, true).with(Defines::MAPS, true).with(Defines::COLOR, false);
        assert_eq!(both, Defines::UV | Defines::MAPS);
        assert!(both.contains(Defines::UV) && both.contains(Defines::NONE) && !both.contains(Defines::COLOR));
        assert_eq!(both.intersection(Defines::MAPS | Defines::COLOR), Defines::MAPS);
        assert_eq!(format!("{both:?}{:?}", Defines::NONE), "UV+MAPS");
    }
}
