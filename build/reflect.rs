//! Reads a SPIR-V module's interface with naga. Its validator tells which globals the entry point really uses, so that
//! a binding that a permutation declares but does not touch is not asked of the pipeline.

use super::interface::{Binding, BindingKind, Field, FieldType, Interface, Slot, SpecConstant, Struct};
use super::permutation::{Permutation, Stage};
use super::spirv;
use naga::valid::{Capabilities, GlobalUse, ModuleInfo, ValidationFlags, Validator};
use naga::{
    AddressSpace, ArraySize, Expression, Handle, ImageClass, ImageDimension, Literal, Module, ScalarKind, Type,
    TypeInner,
};

/// Vertex inputs that `shader::VertexFormat` has a name for.
const VERTEX_FORMATS: [&str; 5] = ["float", "vec2", "vec3", "vec4", "uint"];

/// The interface of one compiled permutation.
pub(crate) fn reflect(permutation: &Permutation, words: &[u32]) -> Result<Interface, String> {
    let at = |error: String| format!("shaders_glsl/pass/{}: {error}", permutation.file);
    let bytes: Vec<u8> = spirv::for_reflection(words).iter().flat_map(|word| word.to_le_bytes()).collect();
    let options = naga::front::spv::Options { adjust_coordinate_space: false, ..Default::default() };
    let module = naga::front::spv::parse_u8_slice(&bytes, &options).map_err(|error| {
        at(format!(
            "naga cannot read it: {error:?} (known: no combined samplers, no textureQueryLod, no modf or frexp)"
        ))
    })?;
    // Nothing here translates the module, so what WGSL forbids and Vulkan allows is left unchecked: vectors made of
    // specialization constants, derivatives outside uniform control flow, scalar block layout.
    let flags = ValidationFlags::EXPRESSIONS | ValidationFlags::BLOCKS | ValidationFlags::BINDINGS;
    let info = Validator::new(flags, Capabilities::all()).validate(&module).map_err(|error| {
        let mut text = format!("naga refuses it: {}", error.as_inner());
        let mut cause = std::error::Error::source(error.as_inner());
        while let Some(error) = cause {
            text.push_str(&format!(": {error}"));
            cause = error.source();
        }
        at(text)
    })?;
    read(&module, &info, permutation).map_err(at)
}

fn read(module: &Module, info: &ModuleInfo, permutation: &Permutation) -> Result<Interface, String> {
    let Some(entry) = module.entry_points.first() else {
        return Err("has no entry point".to_owned());
    };
    let uses = info.get_entry_point(0);
    let mut interface = Interface {
        bindings: Vec::new(),
        push_constant_bytes: 0,
        constants: constants(module)?,
        inputs: Vec::new(),
        outputs: Vec::new(),
        workgroup_size: [0; 3],
        structs: Vec::new(),
    };
    for (handle, variable) in module.global_variables.iter() {
        let used = uses[handle];
        let ty = &module.types[variable.ty];
        let kind = match (variable.space, &ty.inner) {
            (AddressSpace::Uniform, TypeInner::Struct { span, .. }) => {
                BindingKind::Uniform { bytes: span.next_multiple_of(16) }
            }
            (AddressSpace::Storage { .. }, _) => {
                BindingKind::Storage { readonly: !used.intersects(GlobalUse::WRITE | GlobalUse::ATOMIC) }
            }
            (AddressSpace::Handle, TypeInner::Sampler { .. }) => BindingKind::Sampler,
            (AddressSpace::Handle, TypeInner::Image { class: ImageClass::Storage { .. }, .. }) => {
                BindingKind::StorageImage
            }
            (AddressSpace::Handle, TypeInner::Image { dim: ImageDimension::Cube, .. }) => BindingKind::Cube,
            (AddressSpace::Handle, TypeInner::Image { .. }) => BindingKind::Texture,
            (AddressSpace::Handle, TypeInner::BindingArray { .. }) => {
                return Err(format!(
                    "`{}`: descriptor arrays are not supported",
                    variable.name.as_deref().unwrap_or("")
                ));
            }
            (AddressSpace::Immediate, TypeInner::Struct { span, .. }) => {
                collect(module, variable.ty, &mut interface.structs)?;
                if !used.is_empty() {
                    interface.push_constant_bytes = *span;
                }
                continue;
            }
            _ => continue,
        };
        if matches!(kind, BindingKind::Uniform { .. } | BindingKind::Storage { .. }) {
            collect(module, variable.ty, &mut interface.structs)?;
        }
        let Some(at) = &variable.binding else { continue };
        if !used.is_empty() {
            // A block without an instance name goes by the block's name.
            let name = variable.name.as_deref().filter(|name| !name.is_empty()).or(ty.name.as_deref());
            let name = name.unwrap_or_default().to_owned();
            interface.bindings.push(Binding { set: at.group, binding: at.binding, name, kind });
        }
    }
    interface.bindings.sort_by_key(|binding| (binding.set, binding.binding));
    if let Some(pair) = interface.bindings.windows(2).find(|pair| {
        let [first, second] = pair else { return false };
        (first.set, first.binding) == (second.set, second.binding)
    }) {
        return Err(format!("two descriptors share set {} binding {}", pair[0].set, pair[0].binding));
    }

    for argument in &entry.function.arguments {
        slots(module, argument.name.as_deref(), argument.ty, argument.binding.as_ref(), &mut interface.inputs)?;
    }
    if let Some(result) = &entry.function.result {
        slots(module, None, result.ty, result.binding.as_ref(), &mut interface.outputs)?;
    }
    interface.inputs.sort_by_key(|slot| slot.location);
    interface.outputs.sort_by_key(|slot| slot.location);
    match permutation.stage() {
        Some(Stage::Compute) if entry.workgroup_size_overrides.is_some() => {
            return Err("the workgroup size must be a plain number".to_owned());
        }
        Some(Stage::Compute) => interface.workgroup_size = entry.workgroup_size,
        Some(Stage::Vertex) => {
            if let Some(slot) = interface.inputs.iter().find(|slot| !VERTEX_FORMATS.contains(&slot.glsl_type.as_str()))
            {
                let known = VERTEX_FORMATS.join(", ");
                return Err(format!("vertex input `{}` is {}; supported are {known}", slot.name, slot.glsl_type));
            }
        }
        _ => {}
    }
    Ok(interface)
}

/// Adds the user inputs or outputs that a value with that binding, or a struct of such values, holds.
fn slots(
    module: &Module,
    name: Option<&str>,
    ty: Handle<Type>,
    binding: Option<&naga::Binding>,
    found: &mut Vec<Slot>,
) -> Result<(), String> {
    if let Some(naga::Binding::Location { location, .. }) = binding {
        let glsl_type = glsl_type(&module.types[ty].inner)
            .ok_or_else(|| format!("location {location} has a type that does not pass between stages"))?;
        found.push(Slot { location: *location, name: name.unwrap_or_default().to_owned(), glsl_type });
    } else if let (None, TypeInner::Struct { members, .. }) = (binding, &module.types[ty].inner) {
        for member in members {
            slots(module, member.name.as_deref(), member.ty, member.binding.as_ref(), found)?;
        }
    }
    Ok(())
}

/// GLSL spelling of a 32-bit scalar or vector.
fn glsl_type(inner: &TypeInner) -> Option<String> {
    let (scalar, size) = match inner {
        TypeInner::Scalar(scalar) => (scalar, None),
        TypeInner::Vector { size, scalar } => (scalar, Some(*size as u32)),
        _ => return None,
    };
    let (word, prefix) = match (scalar.kind, scalar.width) {
        (ScalarKind::Float, 4) => ("float", ""),
        (ScalarKind::Sint, 4) => ("int", "i"),
        (ScalarKind::Uint, 4) => ("uint", "u"),
        _ => return None,
    };
    Some(size.map_or_else(|| word.to_owned(), |size| format!("{prefix}vec{size}")))
}

fn constants(module: &Module) -> Result<Vec<SpecConstant>, String> {
    let mut constants = Vec::new();
    for (_, constant) in module.overrides.iter() {
        // naga makes overrides without an id of expressions over specialization constants.
        let Some(id) = constant.id else { continue };
        let name = constant.name.clone().unwrap_or_default();
        let default_bits = match constant.init.map(|init| &module.global_expressions[init]) {
            Some(Expression::Literal(Literal::F32(value))) => value.to_bits(),
            Some(Expression::Literal(Literal::U32(value))) => *value,
            Some(Expression::Literal(Literal::I32(value))) => value.cast_unsigned(),
            Some(Expression::Literal(Literal::Bool(value))) => u32::from(*value),
            Some(Expression::ZeroValue(_)) => 0,
            other => return Err(format!("specialization constant `{name}` is not a 32-bit literal: {other:?}")),
        };
        constants.push(SpecConstant { name, id: u32::from(id), default_bits });
    }
    constants.sort_by_key(|constant| constant.id);
    Ok(constants)
}

/// Adds the struct at `ty` and every struct in it; a runtime array at its end stays out of the host mirror.
fn collect(module: &Module, ty: Handle<Type>, structs: &mut Vec<Struct>) -> Result<(), String> {
    let Type { name, inner: TypeInner::Struct { span, members } } = &module.types[ty] else {
        return Ok(());
    };
    let name = name.clone().unwrap_or_default();
    let mut fields = Vec::new();
    let mut bytes = *span;
    for member in members {
        let member_name = member.name.clone().unwrap_or_default();
        if let TypeInner::Array { base, size: ArraySize::Dynamic, stride } = module.types[member.ty].inner {
            bytes = member.offset;
            element(module, base, stride, structs)?;
            continue;
        }
        let ty = field_type(module, member.ty, structs).map_err(|error| format!("`{name}.{member_name}`: {error}"))?;
        fields.push(Field { name: member_name, offset: member.offset, ty });
    }
    if !fields.is_empty() {
        structs.push(Struct { name, bytes, is_element: false, fields });
    }
    Ok(())
}

/// Adds the struct that is an array's element, if it is one, with the array's stride as its size.
fn element(module: &Module, ty: Handle<Type>, stride: u32, structs: &mut Vec<Struct>) -> Result<(), String> {
    let before = structs.len();
    collect(module, ty, structs)?;
    if let (true, Some(layout)) = (structs.len() > before, structs.last_mut()) {
        layout.bytes = stride;
        layout.is_element = true;
    }
    Ok(())
}

fn field_type(module: &Module, ty: Handle<Type>, structs: &mut Vec<Struct>) -> Result<FieldType, String> {
    let numbers = |scalar: naga::Scalar, count| match (scalar.kind, scalar.width) {
        (ScalarKind::Float, 4) => Ok(FieldType::Numbers { scalar: "f32", count }),
        (ScalarKind::Sint, 4) => Ok(FieldType::Numbers { scalar: "i32", count }),
        (ScalarKind::Uint, 4) => Ok(FieldType::Numbers { scalar: "u32", count }),
        _ => Err("only float, int and uint may cross to the host".to_owned()),
    };
    match module.types[ty].inner {
        TypeInner::Scalar(scalar) | TypeInner::Atomic(scalar) => numbers(scalar, 1),
        TypeInner::Vector { size, scalar } => numbers(scalar, size as u32),
        TypeInner::Matrix { columns, rows, scalar } if (scalar.kind, scalar.width) == (ScalarKind::Float, 4) => {
            let column_bytes = if rows as u32 == 2 { 8 } else { 16 };
            Ok(FieldType::Matrix { columns: columns as u32, column_bytes })
        }
        TypeInner::Array { base, size: ArraySize::Constant(length), stride } => {
            element(module, base, stride, structs)?;
            // The element is already collected; what the second visit would add is dropped.
            let element = field_type(module, base, &mut Vec::new())?;
            Ok(FieldType::Array { element: Box::new(element), length: length.get(), stride })
        }
        TypeInner::Struct { .. } => {
            collect(module, ty, structs)?;
            Ok(FieldType::Struct(module.types[ty].name.clone().unwrap_or_default()))
        }
        _ => Err("this type may not cross to the host".to_owned()),
    }
}
