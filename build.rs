//! Compiles every line of `shaders_glsl/permutations` to SPIR-V, reflects it, and writes the typed table of shaders and
//! the host mirrors of their blocks that `src/shader` includes.
//!
//! Environment: `VAIR_GLSLANG` names the compiler (default `glslangValidator` on the PATH), `VAIR_SHADER_DEBUG` keeps
//! names, source and line information in the SPIR-V for debuggers, `VAIR_NO_SHADERS` builds without a compiler and without
//! shaders, as docs.rs does (`DOCS_RS`).

#[path = "build/compile.rs"]
mod compile;
#[path = "build/docs.rs"]
mod docs;
#[path = "build/function.rs"]
mod function;
#[path = "build/function_shader.rs"]
mod function_shader;
#[path = "build/include.rs"]
mod include;
#[path = "build/interface.rs"]
mod interface;
#[path = "build/key.rs"]
mod key;
#[path = "build/layout.rs"]
mod layout;
#[path = "build/pack.rs"]
mod pack;
#[path = "build/parallel.rs"]
mod parallel;
#[path = "build/permutation.rs"]
mod permutation;
#[path = "build/reflect.rs"]
mod reflect;
#[path = "build/spirv.rs"]
mod spirv;
#[path = "build/table.rs"]
mod table;

use interface::Interface;
use permutation::Permutation;
use std::path::{Path, PathBuf};

/// One permutation, compiled and reflected.
struct Built {
    permutation: Permutation,
    /// What the program carries.
    spirv: Vec<u32>,
    interface: Interface,
}

fn main() {
    for input in ["shaders_glsl", "build.rs", "build"] {
        println!("cargo::rerun-if-changed={input}");
    }
    for variable in ["DOCS_RS", "VAIR_GLSLANG", "VAIR_NO_SHADERS", "VAIR_SHADER_DEBUG"] {
        println!("cargo::rerun-if-env-changed={variable}");
    }
    // Cargo shows each `cargo::error` on a line of its own, without the noise of a panicking build script.
    if let Err(errors) = build() {
        for line in errors.iter().flat_map(|error| error.lines()) {
            println!("cargo::error={line}");
        }
    }
}

fn build() -> Result<(), Vec<String>> {
    let out = std::env::var("OUT_DIR").map_err(|_| vec!["OUT_DIR is not set: build.rs runs under cargo".to_owned()])?;
    let out = Path::new(&out);
    let root = Path::new("shaders_glsl");
    let list = root.join("permutations");
    let text = std::fs::read_to_string(&list).map_err(|error| vec![format!("{}: {error}", list.display())])?;
    let list = permutation::parse(&text)?;
    let keys = key::Keys::new(&list).map_err(|error| vec![error])?;
    write(&out.join("shader_key.rs"), &keys.generate())?;

    let sources = Sources { folder: root.join("pass"), root, out: out.to_owned() };
    let mut built = build_all(list.permutations, &sources)?;
    let layout = if has_compiler() {
        interface::check(built.iter().map(|shader| (&shader.permutation, &shader.interface)))?;
        let comments = docs::Comments::read(root).map_err(|error| vec![error])?;
        let structs = |Built { permutation, interface, .. }: &Built| {
            let named = |layout: &interface::Struct| (permutation.name(), layout.clone());
            interface.structs.iter().map(named).collect::<Vec<_>>()
        };
        layout::generate(built.iter().flat_map(structs), &comments)?
    } else {
        include_str!("build/shader_layout.rs").to_owned()
    };
    write(&out.join("shader_layout.rs"), &layout)?;
    built.sort_by_key(|shader| keys.sort_key(&shader.permutation));
    write(&out.join("shader_table.rs"), &table::generate(&built, &keys, out)?)?;
    // Only what judges the renderer evaluates functions one by one; an engine that embeds it carries none of this.
    if std::env::var_os("CARGO_FEATURE_MEASURE").is_some() {
        let library = function::Library::read(root)?;
        let folder = out.join("functions");
        let permutations = function_shader::write(&library, &folder)?;
        let shaders = build_all(permutations, &Sources { folder: folder.clone(), root, out: folder.clone() })?;
        write(&folder.join("shader_functions.rs"), &function_shader::table(&library, &shaders, &folder)?)?;
    }
    Ok(())
}

/// Whether shaders are compiled at all. Without, everything is made that documentation and type checks need: the shaders
/// are empty, and the host structs are those that `build/shader_layout.rs` keeps.
fn has_compiler() -> bool {
    ["DOCS_RS", "VAIR_NO_SHADERS"].iter().all(|variable| std::env::var_os(variable).is_none())
}

/// Where shaders are read and where what is made of them goes.
struct Sources<'a> {
    /// Folder of the permutations' files.
    folder: PathBuf,
    /// `shaders_glsl`.
    root: &'a Path,
    out: PathBuf,
}

/// Compiles and reflects on every core, keeping the order of the list and reporting every failure at once.
fn build_all(permutations: Vec<Permutation>, sources: &Sources) -> Result<Vec<Built>, Vec<String>> {
    if permutations.is_empty() {
        return Ok(Vec::new());
    }
    if !has_compiler() {
        let empty = |permutation| Built { permutation, spirv: Vec::new(), interface: Interface::default() };
        return Ok(permutations.into_iter().map(empty).collect());
    }
    let compiler = compile::Compiler::find().map_err(|error| vec![error])?;
    let keeps_debug_info = std::env::var_os("VAIR_SHADER_DEBUG").is_some();
    let results = parallel::map(&permutations, |permutation| {
        let glsl = include::expand(permutation, &sources.folder, sources.root)?;
        let spirv = compiler.compile(permutation, &glsl, &sources.out)?;
        let interface = reflect::reflect(permutation, &spirv)?;
        let spirv = if keeps_debug_info { spirv } else { spirv::stripped(&spirv) };
        Ok(Built { permutation: permutation.clone(), spirv, interface })
    });
    let results = results.map_err(|error| vec![error])?;
    let mut built = Vec::new();
    // One mistake shows in every permutation of its file: say it once.
    let mut errors: Vec<(String, Vec<String>)> = Vec::new();
    for (result, permutation) in results.into_iter().zip(&permutations) {
        match result {
            Ok(shader) => built.push(shader),
            Err(error) => match errors.iter_mut().find(|(known, _)| *known == error) {
                Some((_, names)) => names.push(permutation.name()),
                None => errors.push((error, vec![permutation.name()])),
            },
        }
    }
    if errors.is_empty() {
        return Ok(built);
    }
    let say = |(error, names): (String, Vec<String>)| match names.as_slice() {
        [name] => format!("{error} (in {name})"),
        [name, others @ ..] => format!("{error} (in {name} and {} more)", others.len()),
        [] => error,
    };
    Err(errors.into_iter().map(say).collect())
}

fn write(path: &Path, text: &str) -> Result<(), Vec<String>> {
    std::fs::write(path, text).map_err(|error| vec![format!("{}: {error}", path.display())])
}
