//! Accessors to numbers (glTF 2.0, section 3.6): every component type, normalised or not, sparse,
//! interleaved, with every range checked before it is read.

use super::AssetError;
use super::context::Context;
use super::document::Document;
use super::uri;
use ::gltf::json::Accessor;
use ::gltf::json::accessor::{ComponentType, GenericComponentType, IndexComponentType, Type, VALID_ACCESSOR_TYPES};
use ::gltf::json::buffer::Stride;
use ::gltf::json::validation::{Checked, USize64};
use std::borrow::Cow;

/// `bytes` little-endian, of the component's size.
fn to_f32(component: ComponentType, bytes: [u8; 4], normalized: bool) -> f32 {
    let [a, b, ..] = bytes;
    // Section 3.11: signed values are symmetric, so the lowest one clamps to -1.
    let scale = |value: f32, max: f32| if normalized { (value / max).max(-1.0) } else { value };
    match component {
        ComponentType::I8 => scale(f32::from(a as i8), 127.0),
        ComponentType::U8 => scale(f32::from(a), 255.0),
        ComponentType::I16 => scale(f32::from(i16::from_le_bytes([a, b])), 32_767.0),
        ComponentType::U16 => scale(f32::from(u16::from_le_bytes([a, b])), 65_535.0),
        ComponentType::U32 if normalized => (f64::from(u32::from_le_bytes(bytes)) / f64::from(u32::MAX)) as f32,
        ComponentType::U32 => u32::from_le_bytes(bytes) as f32,
        ComponentType::F32 => f32::from_le_bytes(bytes),
    }
}

/// How integers become floats.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Normalize {
    /// As the accessor says.
    AsFlagged,
    /// Always: colours and weights have no other meaning.
    Always,
}

/// How a file spells the type of elements of `components` components, among those vair reads.
fn type_name(components: usize) -> &'static str {
    match components {
        1 => "SCALAR",
        2 => "VEC2",
        3 => "VEC3",
        4 => "VEC4",
        _ => "MAT4",
    }
}

/// Elements at a stride; `bytes` starts at element 0 and holds the last one whole.
struct Strided<'a, const N: usize> {
    bytes: &'a [u8],
    stride: usize,
    component: ComponentType,
}

impl<const N: usize> Strided<'_, N> {
    /// Little-endian bytes of each component of element `i`, zero-extended to 4. `i` is below the
    /// count that this was made for.
    fn element(&self, i: usize) -> [[u8; 4]; N] {
        let size = self.component.size();
        let start = i * self.stride;
        std::array::from_fn(|c| {
            let mut bytes = [0; 4];
            let at = start + c * size;
            bytes[..size].copy_from_slice(&self.bytes[at..at + size]);
            bytes
        })
    }
}

/// All buffers of a file and the accessors over them.
pub(super) struct Accessors<'a> {
    context: &'a Context,
    document: &'a Document,
    /// `None`: a buffer without data, an error only for who reads it.
    buffers: Vec<Option<Cow<'a, [u8]>>>,
}

impl<'a> Accessors<'a> {
    /// Fetches the buffers.
    pub(super) fn new(
        context: &'a Context,
        document: &'a Document,
        binary: Option<&'a [u8]>,
    ) -> Result<Self, AssetError> {
        let mut buffers = Vec::with_capacity(document.root.buffers.len());
        for (i, buffer) in document.root.buffers.iter().enumerate() {
            let data = match (&buffer.uri, i, binary) {
                (Some(uri), ..) => Some(Cow::Owned(uri::read(context, &format!("buffers[{i}].uri"), uri)?)),
                (None, 0, Some(binary)) => Some(Cow::Borrowed(binary)),
                _ => None,
            };
            if let Some(data) = &data
                && (data.len() as u64) < buffer.byte_length.0
            {
                let (has, says) = (data.len(), buffer.byte_length.0);
                let problem = format_args!("is {says}, but the buffer has {has} bytes; it is truncated").to_string();
                return Err(context.error(format_args!("buffers[{i}].byteLength"), problem));
            }
            buffers.push(data);
        }
        Ok(Self { context, document, buffers })
    }

    /// The bytes of a buffer view, checked.
    pub(super) fn view(&self, field: &str, view: usize) -> Result<&[u8], AssetError> {
        let context = self.context;
        context.index(
            format_args!("{field}.bufferView"),
            view,
            "bufferViews",
            self.document.root.buffer_views.len(),
        )?;
        let json = &self.document.root.buffer_views[view];
        let here = format!("bufferViews[{view}]");
        let (buffers, buffer) = (&self.document.root.buffers, json.buffer.value());
        context.index(format_args!("{here}.buffer"), buffer, "buffers", buffers.len())?;
        let (start, USize64(count), USize64(length)) =
            (offset(json.byte_offset), json.byte_length, buffers[buffer].byte_length);
        let end = start.checked_add(count).filter(|end| *end <= length);
        let Some(end) = end else {
            let problem = format!("{count} bytes from {start} run past the {length} bytes of buffers[{buffer}]");
            return Err(context.error(here, problem));
        };
        let data = self.buffers[buffer].as_deref().ok_or_else(|| {
            context.error(format_args!("buffers[{buffer}]"), "has no uri and no GLB chunk; export it again")
        })?;
        // The buffer holds at least byteLength bytes, see new().
        Ok(&data[start as usize..end as usize])
    }

    fn strided<const N: usize>(
        &self,
        field: &str,
        view: usize,
        offset: u64,
        component: ComponentType,
        count: usize,
    ) -> Result<Strided<'_, N>, AssetError> {
        let bytes = self.view(field, view)?;
        let size = N * component.size();
        let stride = match self.document.root.buffer_views[view].byte_stride {
            None => size as u64,
            Some(Stride(stride)) if stride >= size => stride as u64,
            Some(Stride(stride)) => {
                let problem = format!("{stride} is less than one element of {size} bytes of {field}");
                return Err(self.context.error(format_args!("bufferViews[{view}].byteStride"), problem));
            }
        };
        let last = (count as u64).saturating_sub(1);
        let needed = stride.checked_mul(last).and_then(|n| n.checked_add(size as u64)?.checked_add(offset));
        let Some(bytes) = needed.filter(|n| *n <= bytes.len() as u64).map(|_| &bytes[offset as usize..]) else {
            let problem = format!(
                "{count} elements of {size} bytes, {stride} apart, from byte {offset} run past the {} bytes of bufferViews[{view}]",
                bytes.len()
            );
            return Err(self.context.error(field, problem));
        };
        // A stride past the view is only possible with one element, which never uses it.
        let stride = usize::try_from(stride).unwrap_or(usize::MAX);
        Ok(Strided { bytes, stride, component })
    }

    /// Decodes N components an element; `convert` sees the accessor, the component type and its bytes.
    fn decode<T: Copy + Default, const N: usize>(
        &self,
        field: &str,
        index: usize,
        convert: impl Fn(&Accessor, ComponentType, [u8; 4]) -> T,
    ) -> Result<Vec<[T; N]>, AssetError> {
        let context = self.context;
        context.index(field, index, "accessors", self.document.root.accessors.len())?;
        let accessor = &self.document.root.accessors[index];
        let here = format!("{field} (accessors[{index}])");
        let code = self.document.code(&format!("accessors[{index}].componentType"), &accessor.component_type);
        let GenericComponentType(component) =
            code.map_err(|code| context.error(&here, format_args!("componentType {code} does not exist")))?;
        let found = self.type_name(index);
        if found != type_name(N) {
            return Err(context.error(&here, format_args!("type is {found}, must be {}", type_name(N))));
        }
        // Matrices of 1- and 2-byte components pad their columns to 4 bytes; a 4 x 4 one needs none.
        let bytes = accessor.count.0.saturating_mul((N * size_of::<T>()) as u64);
        context.spend(&here, bytes)?;
        let count = usize::try_from(accessor.count.0).map_err(|_| context.error(&here, "count is too large"))?;
        let mut values = vec![[T::default(); N]; count];
        let read = |bytes: [[u8; 4]; N]| bytes.map(|bytes| convert(accessor, component, bytes));
        if let Some(view) = accessor.buffer_view
            && count > 0
        {
            let base = self.strided::<N>(&here, view.value(), offset(accessor.byte_offset), component, count)?;
            for (i, value) in values.iter_mut().enumerate() {
                *value = read(base.element(i));
            }
        }
        if let Some(sparse) = &accessor.sparse {
            let changed = usize::try_from(sparse.count.0).unwrap_or(usize::MAX);
            if changed > count {
                let problem = format!("{changed} is more than the {count} elements of the accessor");
                return Err(context.error(format_args!("{here}.sparse.count"), problem));
            }
            let place = format!("{here}.sparse.indices");
            let Checked::Valid(IndexComponentType(kind)) = sparse.indices.component_type else {
                return Err(context.error(place, "componentType must be 5121, 5123 or 5125 (unsigned)"));
            };
            if changed > 0 {
                let (i, v) = (&sparse.indices, &sparse.values);
                let indices = self.strided::<1>(&place, i.buffer_view.value(), i.byte_offset.0, kind, changed)?;
                let place_of_values = format!("{here}.sparse.values");
                let replaced =
                    self.strided::<N>(&place_of_values, v.buffer_view.value(), v.byte_offset.0, component, changed)?;
                for k in 0..changed {
                    let [at] = indices.element(k).map(u32::from_le_bytes);
                    let at = context.index(&place, at as usize, "the accessor", count)?;
                    values[at] = read(replaced.element(k));
                }
            }
        }
        Ok(values)
    }

    /// Floats: integers converted, each number finite.
    pub(super) fn floats<const N: usize>(
        &self,
        field: &str,
        index: usize,
        normalize: Normalize,
    ) -> Result<Vec<[f32; N]>, AssetError> {
        let values = self.decode::<f32, N>(field, index, |accessor, component, bytes| {
            to_f32(component, bytes, accessor.normalized || normalize == Normalize::Always)
        })?;
        for (i, value) in values.iter().enumerate() {
            if let Some(bad) = value.iter().find(|number| !number.is_finite()) {
                let problem = format!("element {i} is {bad}; all must be finite: repair the mesh or export it again");
                return Err(self.context.error(format_args!("{field} (accessors[{index}])"), problem));
            }
        }
        Ok(values)
    }

    /// Unsigned integers.
    pub(super) fn unsigned<const N: usize>(&self, field: &str, index: usize) -> Result<Vec<[u32; N]>, AssetError> {
        let code = self.document.root.accessors.get(index).map(|accessor| accessor.component_type);
        if let Some(Checked::Valid(GenericComponentType(ComponentType::I8 | ComponentType::I16 | ComponentType::F32))) =
            code
        {
            let problem = "componentType must be 5121, 5123 or 5125 (unsigned)";
            return Err(self.context.error(format_args!("{field} (accessors[{index}])"), problem));
        }
        self.decode::<u32, N>(field, index, |_, _, bytes| u32::from_le_bytes(bytes))
    }

    /// The `type` of an accessor.
    pub(super) fn shape(&self, field: &str, index: usize) -> Result<Checked<Type>, AssetError> {
        self.context.index(field, index, "accessors", self.document.root.accessors.len())?;
        Ok(self.document.root.accessors[index].type_)
    }

    /// The `type` of an accessor as the file spells it.
    fn type_name(&self, index: usize) -> &str {
        match self.document.code(&format!("accessors[{index}].type"), &self.document.root.accessors[index].type_) {
            Ok(known) => VALID_ACCESSOR_TYPES[known as usize - Type::Scalar as usize],
            Err(unknown) => unknown,
        }
    }
}

/// An absent offset is 0.
fn offset(bytes: Option<USize64>) -> u64 {
    bytes.map_or(0, |USize64(bytes)| bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_normalise_as_section_3_11_says() {
        let f = |component, bytes: [u8; 4]| to_f32(component, bytes, true);
        assert_eq!(f(ComponentType::I8, [0x80, 0, 0, 0]), -1.0);
        assert_eq!(f(ComponentType::I8, [127, 0, 0, 0]), 1.0);
        assert_eq!(f(ComponentType::U8, [51, 0, 0, 0]), 0.2);
        assert_eq!(f(ComponentType::I16, [0x00, 0x80, 0, 0]), -1.0);
        assert_eq!(f(ComponentType::U16, [0xff, 0xff, 0, 0]), 1.0);
        assert_eq!(f(ComponentType::U32, [0xff; 4]), 1.0);
        assert_eq!(to_f32(ComponentType::I8, [0x80, 0, 0, 0], false), -128.0);
        assert_eq!(to_f32(ComponentType::U32, [1, 0, 0, 0], false), 1.0);
    }
}
