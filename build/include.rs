//! Expands `#include` and the defines of a permutation into one GLSL text, so that every compiler back end reads the
//! same text. `#line` directives keep the compiler's messages on the files that people edit.

use super::permutation::Permutation;
use std::path::{Path, PathBuf};

/// Where `#include` looks, under `shaders_glsl`: functions, mirrored structs, and what entry points share.
const FOLDERS: [&str; 3] = ["lib", "host", "pass"];

/// The whole text of one permutation, whose file is in `folder`. `root` is the `shaders_glsl` folder.
pub(crate) fn expand(permutation: &Permutation, folder: &Path, root: &Path) -> Result<String, String> {
    let path = folder.join(&permutation.file);
    let source = read(&path)?;
    // GLSL wants #version first; comments may precede it.
    let Some(version) = source.lines().position(|line| line.trim_start().starts_with("#version")) else {
        return Err(format!("{}:1: must start with #version 460", slashed(&path)));
    };
    let mut text = String::new();
    for line in source.lines().take(version + 1) {
        text.push_str(line);
        text.push('\n');
    }
    text.push_str("#extension GL_GOOGLE_cpp_style_line_directive : require\n");
    for define in &permutation.defines {
        text.push_str(&format!("#define {define} 1\n"));
    }
    append(&mut text, &path, &source, version + 1, root, &mut Vec::new())?;
    Ok(text)
}

/// Appends the lines of `source` from `first` (counted from 0), with its includes in place.
fn append(
    text: &mut String,
    path: &Path,
    source: &str,
    first: usize,
    root: &Path,
    open: &mut Vec<PathBuf>,
) -> Result<(), String> {
    let mark = |text: &mut String, line: usize| text.push_str(&format!("#line {line} \"{}\"\n", slashed(path)));
    open.push(path.to_owned());
    mark(text, first + 1);
    for (index, line) in source.lines().enumerate().skip(first) {
        let Some(name) = included(line) else {
            text.push_str(line);
            text.push('\n');
            continue;
        };
        let here = || format!("{}:{}", slashed(path), index + 1);
        let Some(name) = name else {
            return Err(format!("{}: write #include \"file.glsl\"", here()));
        };
        let folders = FOLDERS.map(|folder| root.join(folder).join(name));
        let found: Vec<_> = FOLDERS.iter().zip(&folders).filter(|(_, candidate)| candidate.is_file()).collect();
        let [(_, target)] = found[..] else {
            let all = FOLDERS.map(shown).join(" nor ");
            let several = found.iter().map(|(folder, _)| shown(folder)).collect::<Vec<_>>().join(" and ");
            return Err(match found.as_slice() {
                [] => format!("{}: `{name}` is in neither {all}", here()),
                _ => format!("{}: `{name}` is in both {several}: rename one", here()),
            });
        };
        if open.contains(target) {
            return Err(format!("{}: `{name}` includes itself", here()));
        }
        append(text, target, &read(target)?, 0, root, open)?;
        mark(text, index + 2);
    }
    open.pop();
    Ok(())
}

/// `Some(Some(name))` for a well-formed include, `Some(None)` for a malformed one.
fn included(line: &str) -> Option<Option<&str>> {
    let rest = line.trim_start().strip_prefix('#')?.trim_start().strip_prefix("include")?;
    let name = rest.trim().strip_prefix('"').and_then(|rest| rest.split_once('"')).map(|(name, _)| name);
    Some(name.filter(|name| !name.contains("..")))
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", slashed(path)))
}

fn slashed(path: &Path) -> String {
    path.display().to_string().replace('\\', "/")
}

fn shown(folder: &str) -> String {
    format!("shaders_glsl/{folder}")
}
