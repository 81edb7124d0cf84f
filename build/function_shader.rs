//! One compute shader a library function, which evaluates it on words of a storage buffer, and the table of them.

use super::Built;
use super::function::{Function, Library, Value};
use super::pack::Packs;
use super::permutation::Permutation;
use super::table;
use std::fmt::Write;
use std::path::Path;

/// Invocations of a workgroup.
const GROUP: u32 = 64;

/// Writes `NAME.comp` for every function into `folder` and gives the permutations that stand for them.
pub(crate) fn write(library: &Library, folder: &Path) -> Result<Vec<Permutation>, Vec<String>> {
    let failed = |error: std::io::Error| vec![format!("{}: {error}", folder.display())];
    std::fs::create_dir_all(folder).map_err(failed)?;
    let write = |(line, function): (usize, &Function)| {
        let glsl = source(library, function)
            .map_err(|error| vec![format!("shaders_glsl/lib/{}: {}: {error}", function.file, function.name)])?;
        let file = format!("{}.comp", function.name);
        std::fs::write(folder.join(&file), glsl).map_err(failed)?;
        Ok(Permutation { file, defines: Vec::new(), line })
    };
    (1..).zip(&library.functions).map(write).collect()
}

/// Words are read in the order of the parameters' flattened members and written in the order of the result's.
fn source(library: &Library, function: &Function) -> Result<String, String> {
    let parameters: Vec<_> = function
        .parameters
        .iter()
        .map(|parameter| Ok((parameter, library.flatten(&parameter.ty, &parameter.name)?)))
        .collect::<Result<_, String>>()?;
    let results = library.flatten(&function.result, "result")?;
    let words = |values: &[Value]| values.iter().map(|value| value.words).sum::<u32>();
    let given: u32 = parameters.iter().map(|(_, values)| words(values)).sum();
    let mut body = String::new();
    // Writing to a String cannot fail.
    for (parameter, values) in &parameters {
        let _ = writeln!(body, "    {} {};", parameter.ty, parameter.name);
        for Value { path, ty, scalar, words } in values {
            let read = (0..*words).map(|_| match *scalar {
                "Float" => "uintBitsToFloat(given.at[from++])",
                "Int" => "int(given.at[from++])",
                "Bool" => "given.at[from++] != 0u",
                _ => "given.at[from++]",
            });
            // The order in which a constructor's arguments are evaluated is not defined.
            let components: Vec<_> = (0..*words).zip(read).collect();
            match components.as_slice() {
                [(_, read)] => drop(writeln!(body, "    {path} = {read};")),
                _ => components.iter().for_each(|(at, read)| {
                    let _ = writeln!(body, "    {path}{} = {read};", component(ty, *at));
                }),
            }
        }
    }
    let arguments: Vec<_> = function.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    let _ = writeln!(body, "    {} result = {}({});", function.result, function.name, arguments.join(", "));
    for Value { path, ty, scalar, words } in &results {
        for at in 0..*words {
            let place = if *words == 1 { String::new() } else { component(ty, at) };
            let value = format!("{path}{place}");
            let bits = if *scalar == "Float" { format!("floatBitsToUint({value})") } else { format!("uint({value})") };
            let _ = writeln!(body, "    found.at[to++] = {bits};");
        }
    }
    Ok(format!(
        "#version 460
#include \"{file}\"
layout(local_size_x = {GROUP}) in;
layout(set = 0, binding = 0, std430) readonly buffer Given {{ uint at[]; }} given;
layout(set = 0, binding = 1, std430) buffer Found {{ uint at[]; }} found;
void main() {{
    uint from = gl_GlobalInvocationID.x * {given}u;
    uint to = gl_GlobalInvocationID.x * {count}u;
{body}}}
",
        file = function.file,
        count = words(&results),
    ))
}

/// `[2]` of a vector, `[0][2]` of a matrix.
fn component(ty: &str, at: u32) -> String {
    if ty == "mat3" { format!("[{}][{}]", at / 3, at % 3) } else { format!("[{at}]") }
}

/// Rust text of `src/shader/function.rs`: `ALL` functions, each with its shader, which it
/// packs into `out`, and with what they take and give.
pub(crate) fn table(library: &Library, shaders: &[Built], out: &Path) -> Result<String, Vec<String>> {
    let packs = Packs::new(shaders.iter().map(|shader| ("functions", &shader.spirv[..])));
    let statics = packs.write(out)?;
    let mut text =
        format!("{statics}/// Every function of `shaders_glsl/lib`, by file.\npub static ALL: &[Function] = &[\n");
    for ((function, shader), place) in library.functions.iter().zip(shaders).zip(&packs.places) {
        let parts = function.parameters.iter().map(|parameter| library.flatten(&parameter.ty, &parameter.name));
        let arguments = parts.collect::<Result<Vec<_>, _>>().map_err(|error| vec![error])?.concat();
        let results = library.flatten(&function.result, "").map_err(|error| vec![error])?;
        let values = |values: &[Value]| {
            let one = |Value { path, scalar, words, .. }: &Value| {
                format!("Value {{ name: {path:?}, scalar: Scalar::{scalar}, words: {words} }}")
            };
            values.iter().map(one).collect::<Vec<_>>().join(", ")
        };
        let _ = writeln!(
            text,
            "    Function {{ name: {:?}, file: {:?}, arguments: &[{}], results: &[{}], shader: &{} }},",
            function.name,
            function.file,
            values(&arguments),
            values(&results),
            table::one(shader, *place),
        );
    }
    text.push_str("];\n");
    Ok(text)
}
