//! The list of permutations: `shaders_glsl/permutations`.

use std::collections::BTreeMap;

/// A file of `shaders_glsl/pass` with a set of defines.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Permutation {
    /// File name under `shaders_glsl/pass`, for example `standard.frag`.
    pub(crate) file: String,
    /// Defines in the order of the list.
    pub(crate) defines: Vec<String>,
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
    /// `standard.frag+UV+COLOR`.
    pub(crate) fn name(&self) -> String {
        format!("{}{}", self.file, self.variant())
    }

    /// The defines part of the name: `+UV+COLOR`, or nothing.
    pub(crate) fn variant(&self) -> String {
        self.defines.iter().map(|define| format!("+{define}")).collect()
    }

    /// File name without its extension: what the stages of one pass share.
    pub(crate) fn stem(&self) -> &str {
        stem(&self.file)
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

/// A word that a line may define, and why it is no specialization constant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Define {
    pub(crate) name: String,
    /// What of an interface it changes.
    pub(crate) why: String,
}

/// The whole list.
#[derive(Debug, Default)]
pub(crate) struct List {
    /// In the order in which every line has them.
    pub(crate) defines: Vec<Define>,
    pub(crate) permutations: Vec<Permutation>,
}

/// Reads the list; every bad line is reported.
pub(crate) fn parse(text: &str) -> Result<List, Vec<String>> {
    let mut list = List::default();
    let mut line_of_name: BTreeMap<String, usize> = BTreeMap::new();
    let mut errors = Vec::new();
    for (line, text) in (1..).zip(text.lines()) {
        let mut refuse = |why: String| errors.push(format!("shaders_glsl/permutations:{line}: {why}"));
        let text = text.split('#').next().unwrap_or_default().trim();
        if let Some(declaration) = text.strip_prefix("define ") {
            let (name, why) = declaration.trim().split_once(' ').unwrap_or((declaration.trim(), ""));
            match is_identifier(name) {
                true if why.is_empty() => refuse(format!("say what of an interface `{name}` changes")),
                true => list.defines.push(Define { name: name.to_owned(), why: why.trim().to_owned() }),
                false => refuse(format!("`{name}` is not the name of a define")),
            }
            continue;
        }
        let mut words = text.split_whitespace();
        let Some(file) = words.next() else { continue };
        for defines in products(words) {
            let permutation = Permutation { file: file.to_owned(), defines, line };
            let place = |name: &String| list.defines.iter().position(|define| define.name == *name);
            if permutation.stage().is_none() {
                refuse(format!("`{file}` must end in .vert, .frag or .comp"));
            } else if !file.starts_with(|first: char| first.is_ascii_alphabetic()) {
                refuse(format!("`{file}` must start with a letter"));
            } else if let Some(name) = permutation.defines.iter().find(|name| place(name).is_none()) {
                refuse(format!("`{name}` has no define line above"));
            } else if !permutation.defines.is_sorted_by_key(place) {
                refuse(format!("`{}` has its defines in another order than their own lines", permutation.name()));
            } else if let Some(first) = line_of_name.insert(permutation.name(), line) {
                refuse(format!("`{}` is in line {first}, too", permutation.name()));
            } else {
                list.permutations.push(permutation);
            }
        }
    }
    if errors.is_empty() { Ok(list) } else { Err(errors) }
}

/// File name without its extension.
pub(crate) fn stem(file: &str) -> &str {
    file.rsplit_once('.').map_or(file, |(stem, _)| stem)
}

/// The file's name in an enum: `StandardFrag` of `standard.frag`.
pub(crate) fn camel_case(file: &str) -> String {
    let capital = |word: &str| word[..1].to_uppercase() + &word[1..];
    file.split(['.', '_']).filter(|word| !word.is_empty()).map(capital).collect()
}

/// Defines of a line; each `[WORD]` doubles them: without it and with it.
fn products<'a>(words: impl Iterator<Item = &'a str>) -> Vec<Vec<String>> {
    let mut products = vec![Vec::new()];
    for word in words {
        let optional = word.strip_prefix('[').and_then(|word| word.strip_suffix(']'));
        let without = if optional.is_some() { products.clone() } else { Vec::new() };
        products.iter_mut().for_each(|product| product.push(optional.unwrap_or(word).to_owned()));
        products.splice(0..0, without);
    }
    products
}

fn is_identifier(text: &str) -> bool {
    text.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_')
        && text.chars().all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
}
