//! Images for the device: mip levels by box filter, in linear light for colour.

use crate::asset;
use crate::math::{linear_from_srgb, srgb_from_linear};
use std::borrow::Cow;
use std::sync::LazyLock;

/// All mip levels of an image, 8-bit RGBA, the largest first. Colour is averaged in linear light, data as it is.
pub fn mip_levels(image: &asset::Image, srgb: bool) -> Vec<Cow<'_, [u8]>> {
    let mut levels = vec![Cow::Borrowed(&image.rgba[..])];
    let (mut width, mut height) = (image.width as usize, image.height as usize);
    while width > 1 || height > 1 {
        let next = halve(&levels[levels.len() - 1], width, height, srgb);
        levels.push(Cow::Owned(next));
        width = (width / 2).max(1);
        height = (height / 2).max(1);
    }
    levels
}

/// Every target texel is the mean of the source area that it covers, so odd sizes lose nothing.
fn halve(source: &[u8], width: usize, height: usize, srgb: bool) -> Vec<u8> {
    let (target_width, target_height) = ((width / 2).max(1), (height / 2).max(1));
    let columns = coverage(width, target_width);
    let rows = coverage(height, target_height);
    let mut target = Vec::with_capacity(target_width * target_height * 4);
    for row in &rows {
        for column in &columns {
            let mut sum = [0.0f32; 4];
            for &(y, weight_y) in row {
                for &(x, weight_x) in column {
                    let texel = &source[(y * width + x) * 4..][..4];
                    for (channel, &byte) in texel.iter().enumerate() {
                        let value = if srgb && channel < 3 { linear(byte) } else { f32::from(byte) / 255.0 };
                        sum[channel] += weight_x * weight_y * value;
                    }
                }
            }
            for (channel, value) in sum.into_iter().enumerate() {
                let coded = if srgb && channel < 3 { srgb_from_linear(value) } else { value };
                target.push((coded * 255.0 + 0.5) as u8);
            }
        }
    }
    target
}

/// For each target texel: the source texels that it covers and their shares.
fn coverage(source: usize, target: usize) -> Vec<Vec<(usize, f32)>> {
    let ratio = source as f32 / target as f32;
    (0..target)
        .map(|index| {
            let (start, end) = (index as f32 * ratio, (index + 1) as f32 * ratio);
            (start as usize..(end.ceil() as usize).min(source))
                .map(|texel| {
                    let covered = end.min((texel + 1) as f32) - start.max(texel as f32);
                    (texel, covered / ratio)
                })
                .collect()
        })
        .collect()
}

/// Tabulated: a megapixel asks four million times.
fn linear(byte: u8) -> f32 {
    static TABLE: LazyLock<[f32; 256]> =
        LazyLock::new(|| std::array::from_fn(|byte| linear_from_srgb(byte as f32 / 255.0)));
    TABLE[usize::from(byte)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: u32, height: u32, rgba: Vec<u8>) -> asset::Image {
        asset::Image { name: "test".to_owned(), width, height, rgba }
    }

    #[test]
    fn colour_is_averaged_in_linear_light_and_data_is_not() {
        let half_black = image(2, 1, vec![0, 0, 0, 255, 255, 255, 255, 255]);
        assert_eq!(*mip_levels(&half_black, true)[1], [188, 188, 188, 255]);
        assert_eq!(*mip_levels(&half_black, false)[1], [128, 128, 128, 255]);
    }

    #[test]
    fn odd_sizes_keep_the_mean() {
        let rgba = [0u8, 90, 180].iter().flat_map(|&v| [v, v, v, v]).collect();
        let image = image(3, 1, rgba);
        let levels = mip_levels(&image, false);
        assert_eq!(levels.len(), 2);
        assert_eq!(*levels[1], [90, 90, 90, 90]);
    }

    #[test]
    fn levels_end_at_one_texel() {
        let image = image(8, 2, vec![7; 64]);
        let levels = mip_levels(&image, true);
        assert_eq!(levels.iter().map(|level| level.len()).collect::<Vec<_>>(), [64, 16, 8, 4]);
        assert!(levels.iter().all(|level| level.iter().all(|&byte| byte == 7)));
    }
}
