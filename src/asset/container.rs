//! Splits a file into its JSON and, for a GLB, its binary chunk (glTF 2.0, section 4).

use super::AssetError;
use super::context::Context;

const MAGIC: &[u8; 4] = b"glTF";
const CHUNK_JSON: u32 = u32::from_le_bytes(*b"JSON");
const CHUNK_BIN: u32 = u32::from_le_bytes(*b"BIN\0");
const HEADER_BYTES: usize = 12;
const CHUNK_HEADER_BYTES: usize = 8;

/// Borrowed parts of the file's bytes.
#[derive(Debug)]
pub(super) struct Container<'a> {
    pub(super) json: &'a [u8],
    /// Buffer 0 of a GLB.
    pub(super) binary: Option<&'a [u8]>,
}

fn u32_at(bytes: &[u8], offset: usize) -> Option<u32> {
    let four = bytes.get(offset..offset.checked_add(4)?)?;
    Some(u32::from_le_bytes(four.try_into().ok()?))
}

/// The content decides, not the file's extension.
///
/// # Errors
/// Neither GLB nor JSON; a GLB that is cut short or whose lengths contradict each other.
pub(super) fn split<'a>(context: &Context, bytes: &'a [u8]) -> Result<Container<'a>, AssetError> {
    if bytes.is_empty() {
        return Err(context.error("file", "is empty; export it again"));
    }
    if bytes.starts_with(MAGIC) {
        return split_glb(context, bytes);
    }
    let json = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    match json.iter().find(|byte| !byte.is_ascii_whitespace()) {
        Some(b'{') => Ok(Container { json, binary: None }),
        _ => {
            let start = bytes.iter().take(4).map(|byte| format!("{byte:02x}")).collect::<Vec<_>>().join(" ");
            Err(context.error(
                "file",
                format_args!("is no glTF: it starts with bytes {start}, not with `glTF` (GLB) or `{{` (JSON)"),
            ))
        }
    }
}

fn split_glb<'a>(context: &Context, bytes: &'a [u8]) -> Result<Container<'a>, AssetError> {
    let truncated = |what: &str, needs: u64| {
        let has = bytes.len();
        context
            .error("GLB", format_args!("is truncated: {what} needs {needs} bytes, the file has {has}; copy it again"))
    };
    let (Some(version), Some(length)) = (u32_at(bytes, 4), u32_at(bytes, 8)) else {
        return Err(truncated("the header", HEADER_BYTES as u64));
    };
    if version != 2 {
        return Err(context.error("GLB header", format_args!("version {version} is not read; convert the file to 2")));
    }
    let Some(body) = bytes.get(..length as usize) else {
        return Err(truncated("the header's length", u64::from(length)));
    };
    if body.len() < HEADER_BYTES + CHUNK_HEADER_BYTES {
        return Err(context.error("GLB header", format_args!("length {length} leaves no room for a JSON chunk")));
    }
    if body.len() < bytes.len() {
        context.warn("GLB", format_args!("{} bytes after its end are ignored", bytes.len() - body.len()));
    }

    let mut json = None;
    let mut binary = None;
    let mut offset = HEADER_BYTES;
    let mut chunk = 0;
    while offset < body.len() {
        let (Some(chunk_length), Some(kind)) = (u32_at(body, offset), u32_at(body, offset + 4)) else {
            return Err(truncated(&format!("chunk {chunk}"), (offset + CHUNK_HEADER_BYTES) as u64));
        };
        let start = offset + CHUNK_HEADER_BYTES;
        let end = start as u64 + u64::from(chunk_length);
        let content = match usize::try_from(end).ok().and_then(|end| body.get(start..end)) {
            Some(content) => content,
            None => return Err(truncated(&format!("chunk {chunk}"), end)),
        };
        match (chunk, kind) {
            (0, CHUNK_JSON) => json = Some(content),
            (0, _) => return Err(context.error("GLB", format_args!("chunk 0 is of type {kind:#010x}, not JSON"))),
            (1, CHUNK_BIN) => binary = Some(content),
            _ => context.warn("GLB", format_args!("chunk {chunk} of type {kind:#010x} is ignored")),
        }
        chunk += 1;
        offset = start + content.len();
    }
    match json {
        Some(json) => Ok(Container { json, binary }),
        None => Err(context.error("GLB", "has no JSON chunk")),
    }
}
