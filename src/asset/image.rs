//! PNG and JPEG to 8-bit RGBA.

use super::context::Context;
use super::{AssetError, Image, LoadOptions};
use ::image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::io::Cursor;
use std::path::Path;

/// Largest width or height that is decoded, in pixels; no device that vair runs on samples more.
pub const MAX_IMAGE_SIDE_PX: u32 = 32_768;

/// Decodes a PNG or JPEG (told apart by content) to RGBA8: 16-bit channels are rounded to 8, grey
/// is spread to RGB, missing alpha is 255. `name` names the picture in errors and in the result.
///
/// # Errors
/// Not PNG or JPEG; broken; a side over [`MAX_IMAGE_SIDE_PX`]; decoding would take more than
/// `limit_bytes`. Sizes are checked before anything of that size is allocated.
pub fn decode_image(bytes: &[u8], name: &str, limit_bytes: u64) -> Result<Image, AssetError> {
    let options = LoadOptions { memory_limit_bytes: limit_bytes, ..LoadOptions::default() };
    decode(&Context::new(Path::new(name), &options), "image", bytes, name)
}

/// [`decode_image`] on the budget of a load.
pub(super) fn decode(context: &Context, field: &str, bytes: &[u8], name: &str) -> Result<Image, AssetError> {
    let broken = |source: ::image::ImageError| {
        context.error(field, format_args!("`{name}` does not decode ({source}); save it again as PNG or JPEG"))
    };
    let format = match ::image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => format,
        _ => return Err(context.error(field, format_args!("`{name}` is neither PNG nor JPEG; convert it"))),
    };
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(context.left_bytes());
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(broken)?;
    let (width, height) = decoder.dimensions();
    if width == 0 || height == 0 || width > MAX_IMAGE_SIDE_PX || height > MAX_IMAGE_SIDE_PX {
        let problem = format!("`{name}` is {width} x {height} pixels; sides must be 1 to {MAX_IMAGE_SIDE_PX}");
        return Err(context.error(field, problem));
    }
    let rgba_bytes = u64::from(width) * u64::from(height) * 4;
    // The decoder's own pixels live until the conversion is done.
    context.check(field, decoder.total_bytes().saturating_add(rgba_bytes))?;
    // The smaller levels that the device gets are a third as much.
    context.spend(field, rgba_bytes + rgba_bytes / 3)?;
    let rgba = DynamicImage::from_decoder(decoder).map_err(broken)?.into_rgba8().into_raw();
    Ok(Image { name: name.to_owned(), width, height, rgba })
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::image::{ExtendedColorType, ImageEncoder, codecs::jpeg::JpegEncoder, codecs::png::PngEncoder};

    fn png(pixels: &[u8], width: u32, height: u32, color: ExtendedColorType) -> Vec<u8> {
        let mut bytes = Vec::new();
        PngEncoder::new(&mut bytes).write_image(pixels, width, height, color).unwrap();
        bytes
    }

    #[test]
    fn every_layout_becomes_rgba8() {
        let rgba = png(&[1, 2, 3, 4], 1, 1, ExtendedColorType::Rgba8);
        assert_eq!(decode_image(&rgba, "a", 1 << 20).unwrap().rgba, [1, 2, 3, 4]);
        let grey = png(&[7, 9], 2, 1, ExtendedColorType::L8);
        assert_eq!(decode_image(&grey, "a", 1 << 20).unwrap().rgba, [7, 7, 7, 255, 9, 9, 9, 255]);
        let sixteen: Vec<u8> = [0x0000u16, 0x8080, 0xffff].iter().flat_map(|v| v.to_ne_bytes()).collect();
        let sixteen = png(&sixteen, 1, 1, ExtendedColorType::Rgb16);
        assert_eq!(decode_image(&sixteen, "a", 1 << 20).unwrap().rgba, [0, 128, 255, 255]);
        let mut jpeg = Vec::new();
        JpegEncoder::new_with_quality(&mut jpeg, 100).encode(&[128; 8 * 8], 8, 8, ExtendedColorType::L8).unwrap();
        let jpeg = decode_image(&jpeg, "j", 1 << 20).unwrap();
        assert_eq!((jpeg.width, jpeg.height, jpeg.rgba.len()), (8, 8, 256));
        assert_eq!(jpeg.rgba[..4], [128, 128, 128, 255]);
    }

    #[test]
    fn bombs_and_ruins_are_refused_by_name() {
        // A PNG that claims 30000 x 30000: its size is known from the header, before any pixel.
        let mut bomb = png(&[0; 4], 1, 1, ExtendedColorType::Rgba8);
        bomb[16..20].copy_from_slice(&30_000u32.to_be_bytes());
        bomb[20..24].copy_from_slice(&30_000u32.to_be_bytes());
        let crc = crc32(&bomb[12..29]);
        bomb[29..33].copy_from_slice(&crc.to_be_bytes());
        let error = decode_image(&bomb, "bomb.png", 1 << 20).unwrap_err();
        assert!(error.to_string().starts_with("bomb.png"), "{error}");
        let error = decode_image(b"nothing", "n.webp", 1 << 20).unwrap_err().to_string();
        assert!(error.contains("n.webp") && error.contains("neither PNG nor JPEG"), "{error}");
        let good = png(&[1; 64 * 64 * 4], 64, 64, ExtendedColorType::Rgba8);
        assert!(decode_image(&good[..good.len() / 2], "cut.png", 1 << 20).is_err());
        assert!(matches!(decode_image(&good, "a", 20_000), Err(AssetError::Memory { .. } | AssetError::Format { .. })));
        assert!(decode_image(&good, "a", 40_000).is_ok());
    }

    /// CRC-32 of PNG (ISO 3309), bit by bit.
    fn crc32(bytes: &[u8]) -> u32 {
        !bytes.iter().fold(!0u32, |crc, byte| {
            (0..8).fold(crc ^ u32::from(*byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
        })
    }
}
