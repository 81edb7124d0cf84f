//! What a compiled shader asks of its pipeline, as plain data, and the checks that stages agree.

use super::permutation::{Permutation, Stage};
use std::collections::BTreeMap;

/// The reflected interface of one permutation.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Interface {
    /// Used descriptors, ordered by (set, binding).
    pub(crate) bindings: Vec<Binding>,
    /// Bytes of push constants, 0 when unused.
    pub(crate) push_constant_bytes: u32,
    /// Specialization constants, ordered by id.
    pub(crate) constants: Vec<SpecConstant>,
    /// User inputs of the stage, ordered by location.
    pub(crate) inputs: Vec<Slot>,
    /// User outputs of the stage, ordered by location.
    pub(crate) outputs: Vec<Slot>,
    /// Workgroup size, 0 outside compute.
    pub(crate) workgroup_size: [u32; 3],
    /// Every struct that lies in a uniform, storage or push-constant block.
    pub(crate) structs: Vec<Struct>,
}

/// One descriptor.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Binding {
    pub(crate) set: u32,
    pub(crate) binding: u32,
    pub(crate) name: String,
    pub(crate) kind: BindingKind,
}

/// What a descriptor holds; mirrors `shader::BindingKind`, whose Rust text its `Debug` output is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BindingKind {
    Uniform { bytes: u32 },
    Storage { readonly: bool },
    Texture,
    Cube,
    Sampler,
    StorageImage,
}

/// One specialization constant.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct SpecConstant {
    pub(crate) name: String,
    pub(crate) id: u32,
    pub(crate) default_bits: u32,
}

/// One user input or output of a stage.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Slot {
    pub(crate) location: u32,
    pub(crate) name: String,
    pub(crate) glsl_type: String,
}

/// Memory layout of a GLSL struct or block.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Struct {
    pub(crate) name: String,
    /// Bytes from one array element to the next where it is one, otherwise its own size.
    pub(crate) bytes: u32,
    /// `bytes` is an array stride, which overrides sizes seen elsewhere.
    pub(crate) is_element: bool,
    pub(crate) fields: Vec<Field>,
}

/// One member with its byte offset.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Field {
    pub(crate) name: String,
    pub(crate) offset: u32,
    pub(crate) ty: FieldType,
}

/// Type of a member.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum FieldType {
    /// `count` components of a 32-bit Rust scalar: `f32`, `i32` or `u32`; 1 for a scalar.
    Numbers { scalar: &'static str, count: u32 },
    /// Column-major; a column occupies `column_bytes`.
    Matrix { columns: u32, column_bytes: u32 },
    /// `length` elements, `stride` bytes apart.
    Array { element: Box<FieldType>, length: u32, stride: u32 },
    /// A struct of that name.
    Struct(String),
}

/// Checks that the stages of one pass agree on their descriptors, that what a vertex shader hands on is what the
/// fragment shader of the same stem and defines reads, and that no define merely switches code.
pub(crate) fn check<'a>(shaders: impl Iterator<Item = (&'a Permutation, &'a Interface)>) -> Result<(), Vec<String>> {
    let shaders: Vec<_> = shaders.collect();
    let mut errors = Vec::new();
    let mut seen: BTreeMap<(&str, bool, u32, u32), (String, &Binding)> = BTreeMap::new();
    for (permutation, interface) in &shaders {
        for binding in &interface.bindings {
            // A compute shader beside a pass's vertex and fragment shaders is a pipeline of its own.
            let computes = permutation.stage() == Some(Stage::Compute);
            let key = (permutation.stem(), computes, binding.set, binding.binding);
            let (first, known) = seen.entry(key).or_insert_with(|| (permutation.name(), binding));
            if known.name != binding.name || !same_descriptor(known.kind, binding.kind) {
                errors.push(format!(
                    "set {} binding {} is {:?} `{}` in {first} but {:?} `{}` in {}: stages of one pass share their layout",
                    binding.set,
                    binding.binding,
                    known.kind,
                    known.name,
                    binding.kind,
                    binding.name,
                    permutation.name()
                ));
            }
        }
    }
    for (fragment, interface) in shaders.iter().filter(|(shader, _)| shader.stage() == Some(Stage::Fragment)) {
        let partner = shaders.iter().find(|(shader, _)| {
            shader.stage() == Some(Stage::Vertex)
                && shader.stem() == fragment.stem()
                && shader.variant() == fragment.variant()
        });
        let Some((vertex, handed_on)) = partner else { continue };
        for input in &interface.inputs {
            let Slot { location, name, glsl_type } = input;
            let reads = format!("{}: reads {glsl_type} `{name}` at location {location}", fragment.name());
            match handed_on.outputs.iter().find(|output| output.location == *location) {
                None => errors.push(format!("{reads}, which {} does not write", vertex.name())),
                Some(output) if output.glsl_type != *glsl_type => {
                    errors.push(format!("{reads}, where {} writes {}", vertex.name(), output.glsl_type));
                }
                Some(_) => {}
            }
        }
    }
    for (permutation, interface) in &shaders {
        let without = |define: &String| {
            let rest: Vec<_> = permutation.defines.iter().filter(|other| *other != define).cloned().collect();
            shaders.iter().find(|(other, _)| other.file == permutation.file && other.defines == rest)
        };
        for define in &permutation.defines {
            let Some((other, _)) = without(define).filter(|(_, other)| is_same_interface(other, interface)) else {
                continue;
            };
            errors.push(format!(
                "{}: `{define}` changes nothing of the interface of {}: make it a specialization constant",
                permutation.name(),
                other.name()
            ));
        }
    }
    if errors.is_empty() { Ok(()) } else { Err(errors) }
}

/// Whether pipelines of the two have the same to offer.
fn is_same_interface(a: &Interface, b: &Interface) -> bool {
    let of = |shader: &Interface| {
        let Interface { bindings, push_constant_bytes, inputs, outputs, .. } = shader.clone();
        (bindings, push_constant_bytes, inputs, outputs)
    };
    of(a) == of(b)
}

/// Reading or writing a storage block is each stage's own affair.
fn same_descriptor(a: BindingKind, b: BindingKind) -> bool {
    matches!((a, b), (BindingKind::Storage { .. }, BindingKind::Storage { .. })) || a == b
}
