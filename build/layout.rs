//! Writes the host mirrors of every struct that shaders read from memory.

use super::docs::Comments;
use super::interface::{Field, FieldType, Struct};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Rust text of `src/shader/layout.rs`, from every (permutation, struct).
pub(crate) fn generate(
    structs: impl Iterator<Item = (String, Struct)>,
    comments: &Comments,
) -> Result<String, Vec<String>> {
    let mut errors = Vec::new();
    let mut by_name: BTreeMap<String, (String, Struct)> = BTreeMap::new();
    for (permutation, layout) in structs {
        let (first, known) =
            by_name.entry(layout.name.clone()).or_insert_with(|| (permutation.clone(), layout.clone()));
        let conflict = known.is_element && layout.is_element && known.bytes != layout.bytes;
        if known.fields != layout.fields || conflict {
            errors.push(format!("struct `{}` has another layout in {first} than in {permutation}", layout.name));
        } else if (layout.is_element, layout.bytes) > (known.is_element, known.bytes) {
            *known = layout;
        }
    }
    let mut text = String::new();
    for (permutation, layout) in by_name.values() {
        match one(layout, &by_name, comments) {
            Ok(item) => text.push_str(&item),
            Err(error) => errors.push(format!("struct `{}` in {permutation}: {error}", layout.name)),
        }
    }
    if errors.is_empty() { Ok(text) } else { Err(errors) }
}

fn one(layout: &Struct, known: &BTreeMap<String, (String, Struct)>, comments: &Comments) -> Result<String, String> {
    let name = &layout.name;
    let mut fields = String::new();
    let mut asserts = String::new();
    let mut end = 0;
    let mut paddings = 0;
    let mut pad = |fields: &mut String, from: u32, to: u32| {
        if from < to {
            let words = (to - from) / 4;
            let _ = writeln!(fields, "    #[doc(hidden)]\n    pub _padding_{paddings}: [u32; {words}],");
            paddings += 1;
        }
    };
    for Field { name: member, offset, ty } in &layout.fields {
        if *offset < end {
            return Err(format!("`{member}` overlaps the member before it"));
        }
        pad(&mut fields, end, *offset);
        let (rust, bytes) = rust_type(ty, known).map_err(|error| format!("`{member}`: {error}"))?;
        let doc = comments.of(name, member).map_or_else(|| format!("GLSL `{member}`."), str::to_owned);
        // Writing to a String cannot fail.
        let _ = writeln!(fields, "    /// {doc}\n    pub r#{member}: {rust},");
        let _ = writeln!(asserts, "    assert!(core::mem::offset_of!({name}, r#{member}) == {offset});");
        end = offset + bytes;
    }
    pad(&mut fields, end, layout.bytes);
    let doc = comments.of(name, "").map_or_else(|| format!("GLSL `{name}`."), str::to_owned);
    let bytes = layout.bytes.max(end);
    Ok(format!(
        "/// {doc}
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct {name} {{
{fields}}}
const _: () = {{
{asserts}    assert!(core::mem::size_of::<{name}>() == {bytes});
}};
impl Default for {name} {{
    /// All zero.
    fn default() -> Self {{
        bytemuck::Zeroable::zeroed()
    }}
}}
"
    ))
}

/// The Rust type and its size in bytes.
fn rust_type(ty: &FieldType, known: &BTreeMap<String, (String, Struct)>) -> Result<(String, u32), String> {
    match ty {
        FieldType::Numbers { scalar, count: 1 } => Ok(((*scalar).to_owned(), 4)),
        FieldType::Numbers { scalar, count } => Ok((format!("[{scalar}; {count}]"), 4 * count)),
        FieldType::Matrix { columns, column_bytes } => {
            Ok((format!("[[f32; {}]; {columns}]", column_bytes / 4), columns * column_bytes))
        }
        FieldType::Array { element, length, stride } => {
            let (element, bytes) = rust_type(element, known)?;
            if bytes != *stride {
                return Err(format!(
                    "array elements of {bytes} bytes lie {stride} apart; use vec4 elements, or std430 or scalar layout"
                ));
            }
            Ok((format!("[{element}; {length}]"), stride * length))
        }
        FieldType::Struct(name) => match known.get(name) {
            Some((_, layout)) => Ok((name.clone(), layout.bytes)),
            None => Err(format!("struct `{name}` is unknown")),
        },
    }
}
