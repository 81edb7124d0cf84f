//! Writes the table of shaders.

use super::interface::{Binding, Interface, Slot, SpecConstant};
use super::permutation::{Permutation, Stage};

/// Rust text of `src/shader/table.rs`: one static a permutation, and `ALL`.
pub(crate) fn generate(shaders: &[(Permutation, Vec<u32>, Interface)]) -> String {
    let statics: String = shaders.iter().map(|(permutation, _, shader)| one(permutation, shader)).collect();
    let all: String = shaders.iter().map(|(permutation, ..)| format!("    &{},\n", permutation.ident())).collect();
    format!(
        "{statics}/// Every permutation, in the order of the list.\npub static ALL: &[&super::Shader] = &[\n{all}];\n"
    )
}

/// Rust text of one static, which lies beside its SPIR-V.
pub(crate) fn one(permutation: &Permutation, shader: &Interface) -> String {
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
    let ident = permutation.ident();
    let spirv = format!("{name}.spv");
    format!(
        "/// `{name}`.
pub static {ident}: super::Shader = super::Shader {{
    name: {name:?},
    stage: super::Stage::{stage},
    spirv: include_bytes!({spirv:?}),
    bindings: &[{bindings}],
    push_constant_bytes: {push_constant_bytes},
    constants: &[{constants}],
    inputs: &[{inputs}],
    workgroup_size: {workgroup_size:?},
}};
"
    )
}

fn list<T>(items: &[T], text: impl Fn(&T) -> String) -> String {
    items.iter().map(text).collect::<Vec<_>>().join(", ")
}
