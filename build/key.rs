//! Writes the types that name shaders: an enum of the files and a bit for each define.

use super::permutation::{self, Define, List, Permutation, camel_case};
use std::fmt::Write;

/// Bits of `shader::Defines`.
const MAX_DEFINES: usize = 64;

/// What the list names.
#[derive(Debug)]
pub(crate) struct Keys {
    /// A file each, in the order in which the list first names them.
    files: Vec<String>,
    /// By their bits.
    defines: Vec<Define>,
}

impl Keys {
    /// Files and defines of the list.
    pub(crate) fn new(list: &List) -> Result<Self, String> {
        let count = list.defines.len();
        if count > MAX_DEFINES {
            return Err(format!("shaders_glsl/permutations: {count} defines, of which only {MAX_DEFINES} fit"));
        }
        let mut files: Vec<String> = Vec::new();
        for Permutation { file, .. } in &list.permutations {
            if !files.contains(file) {
                files.push(file.clone());
            }
        }
        Ok(Self { files, defines: list.defines.clone() })
    }

    /// What orders keys as `shader::ShaderKey` does.
    pub(crate) fn sort_key(&self, permutation: &Permutation) -> (Option<usize>, u64) {
        (self.files.iter().position(|file| *file == permutation.file), self.bits(permutation))
    }

    /// Rust text of the key.
    pub(crate) fn literal(&self, permutation: &Permutation) -> String {
        let (variant, bits) = (camel_case(&permutation.file), self.bits(permutation));
        format!("super::ShaderKey::new(super::ShaderFile::{variant}, super::Defines({bits:#x}))")
    }

    fn bits(&self, permutation: &Permutation) -> u64 {
        (0..)
            .zip(&self.defines)
            .filter(|(_, define)| permutation.defines.contains(&define.name))
            .map(|(bit, _)| 1 << bit)
            .sum()
    }

    /// Rust text that `src/shader/key.rs` includes.
    pub(crate) fn generate(&self) -> String {
        let (mut variants, mut names, mut stems) = (String::new(), String::new(), String::new());
        for file in &self.files {
            let (stem, variant) = (permutation::stem(file), camel_case(file));
            // Writing to a String cannot fail.
            let _ = writeln!(variants, "    /// `{file}`.\n    {variant},");
            let _ = writeln!(names, "            Self::{variant} => {file:?},");
            let _ = writeln!(stems, "            Self::{variant} => {stem:?},");
        }
        let consts: String = (0..)
            .zip(&self.defines)
            .map(|(bit, Define { name, why })| {
                format!("    /// {why}\n    pub const {name}: Self = Self(1 << {bit});\n")
            })
            .collect();
        format!(
            "/// A file under `shaders_glsl/pass` with an entry point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ShaderFile {{
{variants}}}
impl ShaderFile {{
    /// File name: `standard.frag`.
    pub const fn name(self) -> &'static str {{
        match self {{
{names}        }}
    }}

    /// File name without its stage: `standard`, which the stages of one pass share.
    pub const fn stem(self) -> &'static str {{
        match self {{
{stems}        }}
    }}
}}
impl Defines {{
{consts}
    /// The defines by their bits.
    const NAMES: [&'static str; {count}] = {define_names:?};
}}
",
            count = self.defines.len(),
            define_names = self.defines.iter().map(|define| &define.name).collect::<Vec<_>>(),
        )
    }
}
