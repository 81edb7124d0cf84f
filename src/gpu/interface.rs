//! What the stages of a pipeline ask for together.

use super::error::GpuError;
use crate::shader::{Binding, BindingKind, Shader, Stage, VertexInput};
use ash::vk;
use std::fmt::Write;

/// Descriptor sets that every device has.
pub(crate) const SET_COUNT: usize = 4;
/// Push-constant bytes that every device has.
pub(crate) const PUSH_BYTES: u32 = 128;
/// Vertex bindings that every device has.
pub(crate) const VERTEX_BINDINGS: u32 = 16;

/// One descriptor of the merged stages.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Slot {
    pub(crate) binding: u32,
    pub(crate) name: &'static str,
    pub(crate) descriptor: vk::DescriptorType,
    /// Smallest buffer range that serves, bytes; 0 where the shader does not say.
    pub(crate) bytes: u64,
    /// A texture that a direction looks up.
    pub(crate) is_cube: bool,
}

/// The merged interface of all stages.
#[derive(Debug, Clone)]
pub(crate) struct Interface {
    /// Slots of each set, by binding.
    pub(crate) sets: [Vec<Slot>; SET_COUNT],
    pub(crate) push_bytes: u32,
    pub(crate) push_stages: vk::ShaderStageFlags,
    pub(crate) inputs: &'static [VertexInput],
}

pub(crate) fn stage_flags(stage: Stage) -> vk::ShaderStageFlags {
    match stage {
        Stage::Vertex => vk::ShaderStageFlags::VERTEX,
        Stage::Fragment => vk::ShaderStageFlags::FRAGMENT,
        Stage::Compute => vk::ShaderStageFlags::COMPUTE,
    }
}

fn slot(binding: &Binding) -> Slot {
    let (descriptor, bytes) = match binding.kind {
        // Dynamic: a block is a slice of a larger buffer, so that a group stays while its values change.
        BindingKind::Uniform { bytes } => (vk::DescriptorType::UNIFORM_BUFFER_DYNAMIC, u64::from(bytes)),
        BindingKind::Storage { .. } => (vk::DescriptorType::STORAGE_BUFFER, 0),
        BindingKind::Texture | BindingKind::Cube => (vk::DescriptorType::SAMPLED_IMAGE, 0),
        BindingKind::Sampler => (vk::DescriptorType::SAMPLER, 0),
        BindingKind::StorageImage => (vk::DescriptorType::STORAGE_IMAGE, 0),
    };
    let is_cube = binding.kind == BindingKind::Cube;
    Slot { binding: binding.binding, name: binding.name, descriptor, bytes, is_cube }
}

fn problem(pipeline: &str, problem: String) -> GpuError {
    GpuError::Interface { pipeline: pipeline.to_owned(), problem }
}

impl Interface {
    /// Merges the stages of the pipeline `name`.
    pub(crate) fn merge(name: &str, shaders: &[&'static Shader]) -> Result<Self, GpuError> {
        let mut sets: [Vec<Slot>; SET_COUNT] = Default::default();
        let (mut push_bytes, mut push_stages) = (0, vk::ShaderStageFlags::empty());
        let mut inputs: &'static [VertexInput] = &[];
        for shader in shaders {
            for binding in shader.bindings {
                let set = sets.get_mut(binding.set as usize).ok_or_else(|| {
                    let what = format!("set {} of '{}' in {}", binding.set, binding.name, shader.name);
                    problem(name, format!("{what}: sets are 0 to {}", SET_COUNT - 1))
                })?;
                let new = slot(binding);
                match set.iter_mut().find(|old| old.binding == new.binding) {
                    None => set.push(new),
                    Some(old) if (old.name, old.descriptor, old.is_cube) == (new.name, new.descriptor, new.is_cube) => {
                        old.bytes = old.bytes.max(new.bytes);
                    }
                    Some(old) => {
                        let place = format!("set {} binding {}", binding.set, binding.binding);
                        let (a, b) = (describe(old), describe(&new));
                        return Err(problem(name, format!("{place} is {a} in one stage and {b} in {}", shader.name)));
                    }
                }
            }
            if shader.push_constant_bytes > PUSH_BYTES || !shader.push_constant_bytes.is_multiple_of(4) {
                let bytes = shader.push_constant_bytes;
                let rule = format!("push constants are a multiple of 4 up to {PUSH_BYTES} bytes");
                return Err(problem(name, format!("{} has {bytes} bytes; {rule}", shader.name)));
            }
            if shader.push_constant_bytes > 0 {
                push_bytes = push_bytes.max(shader.push_constant_bytes);
                push_stages |= stage_flags(shader.stage);
            }
            if shader.stage == Stage::Vertex {
                inputs = shader.inputs;
            }
        }
        if let Some(input) = inputs.iter().find(|input| input.location >= VERTEX_BINDINGS) {
            let rule = format!("locations are 0 to {}", VERTEX_BINDINGS - 1);
            return Err(problem(name, format!("vertex input '{}' at {}: {rule}", input.name, input.location)));
        }
        for set in &mut sets {
            set.sort_by_key(|slot| slot.binding);
        }
        Ok(Self { sets, push_bytes, push_stages, inputs })
    }

    /// The interface as stable text, a line each.
    pub(crate) fn describe(&self) -> String {
        let mut text = String::new();
        for (set, slots) in self.sets.iter().enumerate() {
            for slot in slots {
                let _ = writeln!(text, "  set {set} binding {}: {}", slot.binding, describe(slot));
            }
        }
        for input in self.inputs {
            let _ = writeln!(text, "  input {}: {:?} {}", input.location, input.format, input.name);
        }
        let _ = writeln!(text, "  push constants: {} bytes", self.push_bytes);
        text
    }
}

fn describe(slot: &Slot) -> String {
    let size = if slot.bytes > 0 { format!(" of {} bytes", slot.bytes) } else { String::new() };
    format!("{:?} '{}'{size}", slot.descriptor, slot.name)
}

/// The specialization constants of each shader, (id, bits), where `values` are given by name.
pub(crate) fn specialize(
    name: &str,
    shaders: &[&'static Shader],
    values: &[(&str, u32)],
) -> Result<Vec<Vec<(u32, u32)>>, GpuError> {
    for (constant, _) in values {
        if !shaders.iter().any(|shader| shader.constants.iter().any(|known| known.name == *constant)) {
            let known: Vec<_> = shaders.iter().flat_map(|shader| shader.constants).map(|known| known.name).collect();
            let list = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
            return Err(problem(name, format!("no stage has the constant '{constant}'; there are: {list}")));
        }
    }
    let of = |shader: &&'static Shader| {
        let value = |wanted: &str| values.iter().find(|(given, _)| *given == wanted).map(|(_, bits)| *bits);
        shader.constants.iter().filter_map(|known| value(known.name).map(|bits| (known.id, bits))).collect()
    };
    Ok(shaders.iter().map(of).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shader::{SpecConstant, Spirv};

    static VERTEX: Shader = Shader {
        name: "a.vert",
        stage: Stage::Vertex,
        spirv: Spirv::Plain(&[]),
        spirv_hash: 0,
        bindings: &[Binding { set: 0, binding: 0, name: "frame", kind: BindingKind::Uniform { bytes: 64 } }],
        push_constant_bytes: 16,
        constants: &[SpecConstant { name: "layers", id: 3, default_bits: 1 }],
        inputs: &[],
        workgroup_size: [0; 3],
    };
    static FRAGMENT: Shader = Shader {
        name: "a.frag",
        stage: Stage::Fragment,
        bindings: &[
            Binding { set: 0, binding: 0, name: "frame", kind: BindingKind::Uniform { bytes: 96 } },
            Binding { set: 2, binding: 1, name: "base", kind: BindingKind::Texture },
        ],
        push_constant_bytes: 32,
        constants: &[],
        ..VERTEX
    };
    static OTHER: Shader = Shader {
        name: "b.frag",
        stage: Stage::Fragment,
        bindings: &[Binding { set: 0, binding: 0, name: "frame", kind: BindingKind::Texture }],
        ..VERTEX
    };
    static FAR: Shader = Shader {
        name: "c.frag",
        stage: Stage::Fragment,
        bindings: &[Binding { set: 4, binding: 0, name: "far", kind: BindingKind::Texture }],
        ..VERTEX
    };

    #[test]
    fn stages_merge_to_the_larger_of_each() {
        let interface = Interface::merge("a", &[&VERTEX, &FRAGMENT]).unwrap();
        assert_eq!(interface.sets[0][0].bytes, 96);
        assert_eq!(interface.sets[2][0].name, "base");
        assert_eq!(interface.push_bytes, 32);
        assert_eq!(interface.push_stages, vk::ShaderStageFlags::VERTEX | vk::ShaderStageFlags::FRAGMENT);
        assert!(interface.describe().contains("  set 2 binding 1: SAMPLED_IMAGE 'base'\n"));
    }

    #[test]
    fn stages_that_disagree_are_refused_with_set_and_binding() {
        let error = Interface::merge("a", &[&VERTEX, &OTHER]).unwrap_err().to_string();
        assert!(error.contains("set 0 binding 0") && error.contains("SAMPLED_IMAGE"), "{error}");
    }

    #[test]
    fn a_fifth_set_is_refused() {
        let error = Interface::merge("a", &[&VERTEX, &FAR]).unwrap_err().to_string();
        assert!(error.contains("set 4 of 'far'"), "{error}");
    }

    #[test]
    fn constants_go_by_name_to_the_stages_that_have_them() {
        let constants = specialize("a", &[&VERTEX, &FRAGMENT], &[("layers", 20)]).unwrap();
        assert_eq!(constants, [vec![(3, 20)], vec![]]);
        let error = specialize("a", &[&VERTEX, &FRAGMENT], &[("shells", 1)]).unwrap_err().to_string();
        assert!(error.contains("'shells'") && error.contains("layers"), "{error}");
    }
}
