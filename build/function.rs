//! Reads the function definitions of `shaders_glsl/lib`: what `vair verify` evaluates one by one on a device.
//!
//! Understands the style of these files: definitions start at the beginning of a line, bodies are indented, a line of
//! its own closes them. What it does not understand is an error, so that no function stays out unnoticed.

use std::collections::BTreeMap;
use std::path::Path;

/// One function of the shader library.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Function {
    /// File name under `shaders_glsl/lib`.
    pub(crate) file: String,
    /// Name.
    pub(crate) name: String,
    /// Parameters in their order.
    pub(crate) parameters: Vec<Declaration>,
    /// GLSL type of the result.
    pub(crate) result: String,
}

/// A parameter or a member: a GLSL type and a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Declaration {
    pub(crate) ty: String,
    pub(crate) name: String,
}

/// Number, vector or matrix with its place in an argument or result: `surface.f0`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Value {
    /// Path from the parameter; empty where the result is no struct.
    pub(crate) path: String,
    /// GLSL type.
    pub(crate) ty: String,
    /// `Float`, `Int`, `Uint` or `Bool`.
    pub(crate) scalar: &'static str,
    /// 32-bit words.
    pub(crate) words: u32,
}

/// The functions of the library and the structs of library and host.
#[derive(Debug, Default)]
pub(crate) struct Library {
    pub(crate) functions: Vec<Function>,
    structs: BTreeMap<String, Vec<Declaration>>,
}

impl Library {
    /// Reads the folders `lib` and `host` under `root`, files in the order of their names.
    pub(crate) fn read(root: &Path) -> Result<Self, Vec<String>> {
        let mut library = Self::default();
        let mut errors = Vec::new();
        for folder in ["host", "lib"] {
            let folder = root.join(folder);
            let failed = |error: std::io::Error| vec![format!("{}: {error}", folder.display())];
            let entries: Result<Vec<_>, _> = std::fs::read_dir(&folder).map_err(failed)?.collect();
            let mut paths: Vec<_> = entries.map_err(failed)?.into_iter().map(|entry| entry.path()).collect();
            paths.sort();
            for path in paths {
                let text = std::fs::read_to_string(&path).map_err(failed)?;
                let file = path.file_name().unwrap_or_default().to_string_lossy();
                // Functions of the host folder need bindings: they are no part of the library.
                let has_functions = folder.ends_with("lib");
                if let Err(error) = library.add(&file, &text, has_functions) {
                    errors.push(format!("{}:{error}", path.display()));
                }
            }
        }
        if errors.is_empty() { Ok(library) } else { Err(errors) }
    }

    /// Takes the structs of one file, and its functions where it has some of the library. The error starts with the line.
    pub(crate) fn add(&mut self, file: &str, text: &str, has_functions: bool) -> Result<(), String> {
        let mut lines = (1..).zip(text.lines().map(|line| line.split("//").next().unwrap_or_default().trim_end()));
        while let Some((number, line)) = lines.next() {
            let inside = line.is_empty() || line.starts_with([' ', '#', '}', '{']);
            if inside || line.starts_with("const ") {
                continue;
            }
            let mut head = line.to_owned();
            // A long list of parameters may go on; no statement stands at the beginning of a line.
            while !head.ends_with(['{', ';']) {
                let Some((_, more)) = lines.next() else { break };
                head = format!("{head} {}", more.trim());
            }
            if let Some(name) = head.strip_prefix("struct ").and_then(|rest| rest.strip_suffix('{')) {
                let body = lines.by_ref().map(|(_, line)| line).take_while(|line| !line.starts_with('}'));
                let lines: Vec<_> = body.filter(|line| !line.is_empty()).collect();
                // Of arrays no function of the library can be handed one.
                if lines.iter().any(|line| line.contains('[')) {
                    continue;
                }
                let members = lines.iter().map(|line| declaration(line.trim_end_matches(';')));
                let members = members.collect::<Result<_, _>>().map_err(|error| format!("{number}: {error}"))?;
                self.structs.insert(name.trim().to_owned(), members);
                continue;
            }
            if !has_functions {
                continue;
            }
            let function = function(file, &head).map_err(|error| format!("{number}: {error}"))?;
            if self.functions.iter().any(|known| known.name == function.name) {
                return Err(format!("{number}: `{}` is defined twice; overloads cannot be told apart", function.name));
            }
            self.functions.push(function);
        }
        Ok(())
    }

    /// The numbers, vectors and matrices that a type is made of, with their paths.
    pub(crate) fn flatten(&self, ty: &str, path: &str) -> Result<Vec<Value>, String> {
        let (scalar, words) = match ty {
            "float" => ("Float", 1),
            "vec2" => ("Float", 2),
            "vec3" => ("Float", 3),
            "vec4" => ("Float", 4),
            "mat3" => ("Float", 9),
            "int" => ("Int", 1),
            "ivec2" => ("Int", 2),
            "ivec3" => ("Int", 3),
            "uint" => ("Uint", 1),
            "uvec2" => ("Uint", 2),
            "uvec3" => ("Uint", 3),
            "bool" => ("Bool", 1),
            _ => {
                let members = self.structs.get(ty).ok_or_else(|| {
                    format!("`{ty}` is no type that verify can hand over; teach build/function.rs about it")
                })?;
                // Padding is no part of the value.
                let members = members.iter().filter(|member| !member.name.starts_with("_reserved"));
                let parts = members.map(|member| {
                    let dot = if path.is_empty() { "" } else { "." };
                    self.flatten(&member.ty, &format!("{path}{dot}{}", member.name))
                });
                return Ok(parts.collect::<Result<Vec<_>, _>>()?.concat());
            }
        };
        Ok(vec![Value { path: path.to_owned(), ty: ty.to_owned(), scalar, words }])
    }
}

/// `float f(vec3 a, uint b) {`
fn function(file: &str, head: &str) -> Result<Function, String> {
    let unknown = || format!("`{head}` is no definition of a function that build/function.rs can read");
    let (start, rest) = head.split_once('(').ok_or_else(unknown)?;
    let parameters = rest.strip_suffix('{').and_then(|rest| rest.trim_end().strip_suffix(')')).ok_or_else(unknown)?;
    let Declaration { ty: result, name } = declaration(start)?;
    let parameters = parameters.split(',').filter(|text| !text.trim().is_empty()).map(declaration);
    Ok(Function { file: file.to_owned(), name, parameters: parameters.collect::<Result<_, _>>()?, result })
}

/// `vec3 color`; qualifiers such as `inout` and arrays are refused.
fn declaration(text: &str) -> Result<Declaration, String> {
    let mut words = text.split_whitespace();
    match (words.next(), words.next(), words.next()) {
        (Some(ty), Some(name), None) if !name.contains('[') => {
            Ok(Declaration { ty: ty.to_owned(), name: name.to_owned() })
        }
        _ => Err(format!("`{}` is not a type and a name", text.trim())),
    }
}
