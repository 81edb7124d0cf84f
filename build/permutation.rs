//! The list of permutations: `shaders_glsl/permutations`.

use std::collections::BTreeMap;

/// A file of `shaders_glsl/pass` with a set of defines.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Permutation {
    /// File name under `shaders_glsl/pass`, for example `standard.frag`.
    pub(crate) file: String,
    /// Defines in the order of the list, with their values.
    pub(crate) defines: Vec<(String, Option<String>)>,
    /// Line in the list, from 1.
    pub(crate) line: usize,
}

/// Pipeline stage, by the extension of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stage {
    /// `.vert`
    Vertex,
    /// `.frag`
    Fragment,
    /// `.comp`
    Compute,
}

impl Permutation {
    /// `standard.frag+UV+LAYERS=3`.
    pub(crate) fn name(&self) -> String {
        format!("{}{}", self.file, self.variant())
    }

    /// The defines part of the name: `+UV+LAYERS=3`, or nothing.
    pub(crate) fn variant(&self) -> String {
        let defines = self.defines.iter().map(|(name, value)| match value {
            Some(value) => format!("+{name}={value}"),
            None => format!("+{name}"),
        });
        defines.collect()
    }

    /// The name as a Rust static: `STANDARD_FRAG_UV_LAYERS_3`.
    pub(crate) fn ident(&self) -> String {
        let word = |letter: char| if letter.is_ascii_alphanumeric() { letter.to_ascii_uppercase() } else { '_' };
        self.name().chars().map(word).collect()
    }

    /// File name without its extension: what the stages of one pass share.
    pub(crate) fn stem(&self) -> &str {
        self.file.rsplit_once('.').map_or(self.file.as_str(), |(stem, _)| stem)
    }

    /// Stage, or `None` for an unknown extension, which [`parse`] refuses.
    pub(crate) fn stage(&self) -> Option<Stage> {
        match self.file.rsplit_once('.')?.1 {
            "vert" => Some(Stage::Vertex),
            "frag" => Some(Stage::Fragment),
            "comp" => Some(Stage::Compute),
            _ => None,
        }
    }
}

/// Reads the list; every bad line is reported.
pub(crate) fn parse(text: &str) -> Result<Vec<Permutation>, Vec<String>> {
    let mut permutations: Vec<Permutation> = Vec::new();
    let mut lines_of_ident: BTreeMap<String, usize> = BTreeMap::new();
    let mut errors = Vec::new();
    for (line, text) in (1..).zip(text.lines()) {
        let mut words = text.split('#').next().unwrap_or_default().split_whitespace();
        let Some(file) = words.next() else { continue };
        for defines in products(words) {
            let permutation = Permutation { file: file.to_owned(), defines, line };
            let mut refuse = |why: String| errors.push(format!("shaders_glsl/permutations:{line}: {why}"));
            if permutation.stage().is_none() {
                refuse(format!("`{file}` must end in .vert, .frag or .comp"));
            } else if !permutation.ident().starts_with(|first: char| first.is_ascii_alphabetic()) {
                refuse(format!("`{file}` must start with a letter"));
            } else if let Some((name, _)) = permutation.defines.iter().find(|(name, _)| !is_identifier(name)) {
                refuse(format!("`{name}` is not the name of a define"));
            } else if let Some(first) = lines_of_ident.insert(permutation.ident(), line) {
                refuse(format!("`{}` has the same Rust name as line {first}", permutation.name()));
            } else {
                permutations.push(permutation);
            }
        }
    }
    if errors.is_empty() { Ok(permutations) } else { Err(errors) }
}

/// Defines of a line; each `[WORD]` doubles them: without it and with it.
fn products<'a>(words: impl Iterator<Item = &'a str>) -> Vec<Vec<(String, Option<String>)>> {
    let mut products = vec![Vec::new()];
    for word in words {
        let optional = word.strip_prefix('[').and_then(|word| word.strip_suffix(']'));
        let define = match optional.unwrap_or(word).split_once('=') {
            Some((name, value)) => (name.to_owned(), Some(value.to_owned())),
            None => (optional.unwrap_or(word).to_owned(), None),
        };
        let without = if optional.is_some() { products.clone() } else { Vec::new() };
        products.iter_mut().for_each(|product| product.push(define.clone()));
        products.splice(0..0, without);
    }
    products
}

fn is_identifier(text: &str) -> bool {
    text.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_')
        && text.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
}
