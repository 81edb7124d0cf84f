//! Compiles every line of `shaders_glsl/permutations` to SPIR-V, reflects it, and writes the typed table of shaders and
//! the host mirrors of their blocks that `src/shader` includes.
//!
//! Environment: `VAIR_GLSLANG` names the compiler (default `glslangValidator` on the PATH), `VAIR_SHADER_DEBUG` keeps
//! source and line information in the SPIR-V for debuggers.

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
#[path = "build/layout.rs"]
mod layout;
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
use std::sync::atomic::{AtomicUsize, Ordering};

/// One permutation, compiled and reflected.
type Built = (Permutation, Vec<u32>, Interface);

fn main() {
    for input in ["shaders_glsl", "build.rs", "build"] {
        println!("cargo::rerun-if-changed={input}");
    }
    for variable in ["VAIR_GLSLANG", "VAIR_SHADER_DEBUG"] {
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
    let permutations = permutation::parse(&text)?;

    let sources = Sources { folder: root.join("pass"), root, out: out.to_owned() };
    let built = build_all(permutations, &sources)?;
    interface::check(built.iter().map(|(permutation, _, interface)| (permutation, interface)))?;
    let comments = docs::Comments::read(root).map_err(|error| vec![error])?;
    let structs = built.iter().flat_map(|(permutation, _, interface)| {
        interface.structs.iter().map(|layout| (permutation.name(), layout.clone()))
    });
    write(&out.join("shader_layout.rs"), &layout::generate(structs, &comments)?)?;
    write(&out.join("shader_table.rs"), &table::generate(&built))?;
    // Only what judges the renderer evaluates functions one by one; an engine that embeds it carries none of this.
    if std::env::var_os("CARGO_FEATURE_MEASURE").is_some() {
        let library = function::Library::read(root)?;
        let folder = out.join("functions");
        let permutations = function_shader::write(&library, &folder)?;
        let shaders = build_all(permutations, &Sources { folder: folder.clone(), root, out: folder })?;
        write(&out.join("functions/shader_functions.rs"), &function_shader::table(&library, &shaders)?)?;
    }
    Ok(())
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
    let compiler = compile::Compiler::find().map_err(|error| vec![error])?;
    let workers = std::thread::available_parallelism().map_or(1, usize::from).min(permutations.len());
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(permutation) = permutations.get(index) else { break };
            let build = || {
                let glsl = include::expand(permutation, &sources.folder, sources.root)?;
                let spirv = compiler.compile(permutation, &glsl, &sources.out)?;
                let interface = reflect::reflect(permutation, &spirv)?;
                Ok((permutation.clone(), spirv, interface))
            };
            let result = build();
            done.push((index, result));
        }
        done
    };
    let mut results: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..workers).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().unwrap_or_default()).collect()
    });
    if results.len() != permutations.len() {
        return Err(vec!["a shader thread of build.rs panicked: see the output above".to_owned()]);
    }
    results.sort_by_key(|(index, _)| *index);
    let mut built = Vec::new();
    // One mistake shows in every permutation of its file: say it once.
    let mut errors: Vec<(String, Vec<String>)> = Vec::new();
    for ((_, result), permutation) in results.into_iter().zip(&permutations) {
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
