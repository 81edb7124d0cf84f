//! Doc comments of the host structs: the comments that stand beside them in the GLSL.

use std::collections::BTreeMap;
use std::path::Path;

/// Comments by (struct, member); the empty member is the struct itself.
#[derive(Debug, Default)]
pub(crate) struct Comments(BTreeMap<(String, String), String>);

impl Comments {
    /// Reads every file under `root`.
    pub(crate) fn read(root: &Path) -> Result<Self, String> {
        let mut comments = Self::default();
        let failed = |path: &Path, error: std::io::Error| format!("{}: {error}", path.display());
        let mut folders = vec![root.to_owned()];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(&folder).map_err(|error| failed(&folder, error))? {
                let path = entry.map_err(|error| failed(&folder, error))?.path();
                if path.is_dir() {
                    folders.push(path);
                } else if path.file_name().is_some_and(|name| name != "permutations") {
                    comments.add(&std::fs::read_to_string(&path).map_err(|error| failed(&path, error))?);
                }
            }
        }
        Ok(comments)
    }

    /// Takes the comments of one GLSL text: the lines above a struct or block, and the end of each member's line.
    pub(crate) fn add(&mut self, glsl: &str) {
        let mut above: Vec<&str> = Vec::new();
        let mut open: Option<String> = None;
        for line in glsl.lines() {
            let (code, comment) = match line.split_once("//") {
                Some((code, comment)) => (code.trim(), Some(comment.trim_start_matches('/').trim())),
                None => (line.trim(), None),
            };
            if code.starts_with('}') {
                open = None;
            } else if let Some(name) = &open {
                let declaration = code.split(['[', ';']).next().unwrap_or_default();
                if let (Some(member), Some(comment)) = (declaration.split_whitespace().last(), comment) {
                    self.0.entry((name.clone(), member.to_owned())).or_insert_with(|| comment.to_owned());
                }
            } else if let Some(name) = opened(code) {
                let text = above.join(" ");
                if !text.is_empty() {
                    self.0.entry((name.clone(), String::new())).or_insert(text);
                }
                open = Some(name);
            }
            match comment {
                Some(comment) if code.is_empty() && open.is_none() => above.push(comment),
                _ => above.clear(),
            }
        }
    }

    /// The comment of a struct (empty `member`) or of its member.
    pub(crate) fn of(&self, name: &str, member: &str) -> Option<&str> {
        self.0.get(&(name.to_owned(), member.to_owned())).map(String::as_str)
    }
}

/// Name of the struct or block whose body this line opens.
fn opened(code: &str) -> Option<String> {
    let head = code.strip_suffix('{')?.trim();
    let mut words = head.split_whitespace().rev();
    let name = words.next()?;
    words.any(|word| ["struct", "uniform", "buffer"].contains(&word)).then(|| name.to_owned())
}
