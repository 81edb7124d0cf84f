//! Radiance pictures (.hdr), a row at a time.
//!
//! Source: Ward 1991, "Real Pixels" (Graphics Gems II), and the file format chapter of the Radiance documentation.

use super::super::AssetError;
use super::super::context::Context;
use super::Reduction;

/// Smallest and largest width whose rows are run-length coded a channel at a time.
const CODED_WIDTH: std::ops::RangeInclusive<usize> = 8..=0x7fff;

/// Whether the file starts as Radiance pictures do.
pub(super) fn is_hdr(bytes: &[u8]) -> bool {
    bytes.starts_with(b"#?")
}

/// Decodes all rows.
pub(super) fn decode(context: &Context, bytes: &[u8]) -> Result<Reduction, AssetError> {
    let mut lines = Lines(bytes);
    let scale = read_header(context, &mut lines)?;
    let [width, height] = read_size(context, &mut lines)?;
    // A row as shared exponents and as floats.
    let mut reduction = Reduction::new(context, [width, height], width.saturating_mul(4 + 12))?;
    let mut rgbe = vec![[0u8; 4]; width as usize];
    let mut row = vec![[0f32; 3]; width as usize];
    let mut rest = lines.0;
    for y in 0..height as usize {
        let broken = |why: &str| {
            let problem = format!("row {y} of {height} {why}; the file is damaged or cut off, copy it again");
            context.error("texels", problem)
        };
        rest = read_row(rest, &mut rgbe).map_err(broken)?;
        row.iter_mut().zip(&rgbe).for_each(|(texel, rgbe)| *texel = radiance(*rgbe, scale));
        reduction.add(0, y, &row);
    }
    Ok(reduction)
}

/// The bytes after those that were read.
struct Lines<'a>(&'a [u8]);

impl Lines<'_> {
    fn next(&mut self, context: &Context) -> Result<String, AssetError> {
        let end = self.0.iter().position(|byte| *byte == b'\n');
        let end = end.ok_or_else(|| context.error("header", "does not end; the file is damaged, copy it again"))?;
        let line = String::from_utf8_lossy(&self.0[..end]).trim_end().to_owned();
        self.0 = &self.0[end + 1..];
        Ok(line)
    }
}

/// Reads up to the empty line; gives the factor from stored numbers to radiance.
fn read_header(context: &Context, lines: &mut Lines) -> Result<f32, AssetError> {
    let mut exposure = 1.0f32;
    lines.next(context)?;
    loop {
        let line = lines.next(context)?;
        if line.is_empty() {
            return Ok(1.0 / exposure);
        }
        if let Some(format) = line.strip_prefix("FORMAT=")
            && format.trim() != "32-bit_rle_rgbe"
        {
            return Err(context.error("FORMAT", format_args!("`{format}` is not read; save it as 32-bit_rle_rgbe")));
        }
        if let Some(text) = line.strip_prefix("EXPOSURE=") {
            let value = text.trim().parse::<f32>().ok().filter(|value| value.is_normal() && *value > 0.0);
            let usable = value.map(|value| exposure * value).filter(|product| product.is_normal());
            exposure =
                usable.ok_or_else(|| context.error("EXPOSURE", format_args!("`{text}` is no factor above 0")))?;
        }
    }
}

/// `-Y 512 +X 1024`: rows from the top, columns from the left.
fn read_size(context: &Context, lines: &mut Lines) -> Result<[u64; 2], AssetError> {
    let line = lines.next(context)?;
    let side = |text: Option<&str>| text.and_then(|text| text.parse::<u32>().ok()).map(u64::from);
    let mut words = line.split_whitespace();
    match (words.next(), side(words.next()), words.next(), side(words.next())) {
        (Some("-Y"), Some(height), Some("+X"), Some(width)) => Ok([width, height]),
        _ => {
            let problem = format!("`{line}` is not `-Y HEIGHT +X WIDTH`; save the picture from its top left corner");
            Err(context.error("size", problem))
        }
    }
}

/// Fills one row and gives what follows it, or says what is wrong.
fn read_row<'a>(bytes: &'a [u8], row: &mut [[u8; 4]]) -> Result<&'a [u8], &'static str> {
    let (&first, rest) = bytes.split_first_chunk::<4>().ok_or("is missing")?;
    let [2, 2, high, low] = first else { return read_plain_row(bytes, row) };
    if !CODED_WIDTH.contains(&row.len()) || high > 0x7f {
        return read_plain_row(bytes, row);
    }
    if usize::from(high) << 8 | usize::from(low) != row.len() {
        return Err("is coded for another width");
    }
    let mut rest = rest;
    for channel in 0..4 {
        let mut filled = 0;
        while filled < row.len() {
            let (&count, after) = rest.split_first().ok_or("is cut off")?;
            let is_run = count > 128;
            let length = usize::from(if is_run { count - 128 } else { count });
            let values = after.get(..if is_run { 1 } else { length }).ok_or("is cut off")?;
            if length == 0 || filled + length > row.len() {
                return Err("is not coded as it should be");
            }
            for (offset, texel) in row[filled..filled + length].iter_mut().enumerate() {
                texel[channel] = values[if is_run { 0 } else { offset }];
            }
            rest = &after[values.len()..];
            filled += length;
        }
    }
    Ok(rest)
}

/// Texels one by one, where (1, 1, 1, n) repeats the one before n times and directly after another such 256 n times.
fn read_plain_row<'a>(bytes: &'a [u8], row: &mut [[u8; 4]]) -> Result<&'a [u8], &'static str> {
    let (mut rest, mut filled, mut shift) = (bytes, 0, 0);
    while filled < row.len() {
        let (&texel, after) = rest.split_first_chunk::<4>().ok_or("is cut off")?;
        rest = after;
        let [1, 1, 1, count] = texel else {
            row[filled] = texel;
            filled += 1;
            shift = 0;
            continue;
        };
        let count = if shift < usize::BITS - 8 { usize::from(count) << shift } else { usize::MAX };
        if filled == 0 || count > row.len() - filled {
            return Err("is not coded as it should be");
        }
        let before = row[filled - 1];
        row[filled..filled + count].fill(before);
        filled += count;
        shift += 8;
    }
    Ok(rest)
}

/// Three mantissas and the exponent that they share.
fn radiance([r, g, b, exponent]: [u8; 4], scale: f32) -> [f32; 3] {
    if exponent == 0 {
        return [0.0; 3];
    }
    let factor = 2f32.powi(i32::from(exponent) - 136) * scale;
    [r, g, b].map(|mantissa| f32::from(mantissa) * factor)
}
