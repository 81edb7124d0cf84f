//! Writes the table of shaders.

use super::Built;
use super::interface::{Binding, Slot, SpecConstant};
use super::key::Keys;
use super::pack::{Packs, Place};
use super::permutation::Stage;
use std::path::Path;

/// Rust text of `src/shader/table.rs`: `ALL`, of shaders sorted by their keys, and their packs, which it writes to `out`.
pub(crate) fn generate(shaders: &[Built], keys: &Keys, out: &Path) -> Result<String, Vec<String>> {
    let packs = Packs::new(shaders.iter().map(|shader| (shader.permutation.file.as_str(), &shader.spirv[..])));
    let statics = packs.write(out)?;
    let rows: String = shaders
        .iter()
        .zip(&packs.places)
        .map(|(shader, place)| format!("    ({}, {}),\n", keys.literal(&shader.permutation), one(shader, *place)))
        .collect();
    Ok(format!(
        "{statics}/// Every permutation, by its key.\npub static ALL: &[(super::ShaderKey, super::Shader)] = &[\n{rows}];\n"
    ))
}

/// Rust text of one shader, which lies in that place of the packs.
pub(crate) fn one(shader: &Built, place: Place) -> String {
    let Built { permutation, spirv, interface: shader } = shader;
    let Place { pack, first_word, word_count } = place;
    let hash = fnv1a(spirv);
    let name = permutation.name();
    let stage = permutation.stage();
    let bindings = list(&shader.bindings, |Binding { set, binding, name, kind }| {
        format!(
            "super::Binding {{ set: {set}, binding: {binding}, name: {name:?}, kind: super::BindingKind::{kind:?} }}"
        )
    });
    let constants = list(&shader.constants, |SpecConstant { name, id, default_bits }| {
        format!("super::SpecConstant {{ name: {name:?}, id: {id}, default_bits: {default_bits:#010x} }}")
    });
    let vertex_inputs = if stage == Some(Stage::Vertex) { shader.inputs.as_slice() } else { &[] };
    let inputs = list(vertex_inputs, |Slot { location, name, glsl_type }| {
        let format = format!("{}{}", glsl_type[..1].to_uppercase(), &glsl_type[1..]);
        format!("super::VertexInput {{ name: {name:?}, location: {location}, format: super::VertexFormat::{format} }}")
    });
    let stage = stage.map_or_else(String::new, |stage| format!("{stage:?}"));
    let push_constant_bytes = shader.push_constant_bytes;
    let workgroup_size = shader.workgroup_size;
    format!(
        "super::Shader {{ name: {name:?}, stage: super::Stage::{stage}, spirv: super::Spirv::Packed {{ pack: \
         &PACK_{pack}, first_word: {first_word}, word_count: {word_count} }}, spirv_hash: {hash:#x}, bindings: \
         &[{bindings}], push_constant_bytes: {push_constant_bytes}, constants: &[{constants}], inputs: &[{inputs}], \
         workgroup_size: {workgroup_size:?} }}"
    )
}

fn list<T>(items: &[T], text: impl Fn(&T) -> String) -> String {
    items.iter().map(text).collect::<Vec<_>>().join(", ")
}

/// FNV-1a, 64 bits, of the words' bytes, as `math::fnv1a` has it.
fn fnv1a(words: &[u32]) -> u64 {
    let bytes = words.iter().flat_map(|word| word.to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}
