//! Formats: size of a texel block, aspect, and the arithmetic of mip levels.

use ash::vk;

/// Bytes and side lengths of a texel block, for the formats that this crate uploads or reads back.
pub(crate) fn block(format: vk::Format) -> Option<(u64, u32)> {
    use vk::Format as F;
    Some(match format {
        F::R8_UNORM | F::R8_SNORM | F::R8_UINT => (1, 1),
        F::R8G8_UNORM | F::R8G8_SNORM | F::R16_SFLOAT | F::R16_UNORM | F::R16_UINT | F::D16_UNORM => (2, 1),
        F::R8G8B8A8_UNORM
        | F::R8G8B8A8_SRGB
        | F::R8G8B8A8_SNORM
        | F::R8G8B8A8_UINT
        | F::B8G8R8A8_UNORM
        | F::B8G8R8A8_SRGB
        | F::A2B10G10R10_UNORM_PACK32
        | F::B10G11R11_UFLOAT_PACK32
        | F::E5B9G9R9_UFLOAT_PACK32
        | F::R16G16_SFLOAT
        | F::R16G16_UNORM
        | F::R16G16_SNORM
        | F::R32_SFLOAT
        | F::R32_UINT
        | F::D32_SFLOAT => (4, 1),
        F::R16G16B16A16_SFLOAT | F::R16G16B16A16_UNORM | F::R32G32_SFLOAT | F::R32G32_UINT => (8, 1),
        F::R32G32B32A32_SFLOAT | F::R32G32B32A32_UINT => (16, 1),
        F::BC1_RGB_UNORM_BLOCK
        | F::BC1_RGB_SRGB_BLOCK
        | F::BC1_RGBA_UNORM_BLOCK
        | F::BC1_RGBA_SRGB_BLOCK
        | F::BC4_UNORM_BLOCK
        | F::BC4_SNORM_BLOCK => (8, 4),
        F::BC2_UNORM_BLOCK
        | F::BC2_SRGB_BLOCK
        | F::BC3_UNORM_BLOCK
        | F::BC3_SRGB_BLOCK
        | F::BC5_UNORM_BLOCK
        | F::BC5_SNORM_BLOCK
        | F::BC6H_UFLOAT_BLOCK
        | F::BC6H_SFLOAT_BLOCK
        | F::BC7_UNORM_BLOCK
        | F::BC7_SRGB_BLOCK => (16, 4),
        _ => return None,
    })
}

/// All aspects of a format, as barriers name them.
pub(crate) fn aspects(format: vk::Format) -> vk::ImageAspectFlags {
    use vk::Format as F;
    match format {
        F::D16_UNORM | F::X8_D24_UNORM_PACK32 | F::D32_SFLOAT => vk::ImageAspectFlags::DEPTH,
        F::D16_UNORM_S8_UINT | F::D24_UNORM_S8_UINT | F::D32_SFLOAT_S8_UINT => {
            vk::ImageAspectFlags::DEPTH | vk::ImageAspectFlags::STENCIL
        }
        _ => vk::ImageAspectFlags::COLOR,
    }
}

/// The one aspect that views and copies see.
pub(crate) fn view_aspect(format: vk::Format) -> vk::ImageAspectFlags {
    aspects(format) & !vk::ImageAspectFlags::STENCIL
}

/// Width and height of mip level `level` of an image of `size` texels, at least 1.
pub fn level_size(size: [u32; 2], level: u32) -> [u32; 2] {
    size.map(|side| side.checked_shr(level).unwrap_or(0).max(1))
}

/// Bytes of a tightly packed level of `size` texels; `None` for a format without a known layout.
pub fn format_bytes(format: vk::Format, size: [u32; 2]) -> Option<u64> {
    let (bytes, side) = block(format)?;
    Some(size.iter().map(|texels| u64::from(texels.div_ceil(side))).product::<u64>() * bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_halve_down_to_one() {
        assert_eq!(level_size([5, 2], 1), [2, 1]);
        assert_eq!(level_size([5, 2], 9), [1, 1]);
        assert_eq!(level_size([5, 2], 40), [1, 1]);
    }

    #[test]
    fn blocks_round_up() {
        assert_eq!(format_bytes(vk::Format::BC7_SRGB_BLOCK, [5, 4]), Some(32));
        assert_eq!(format_bytes(vk::Format::R8G8B8A8_UNORM, [5, 4]), Some(80));
        assert_eq!(format_bytes(vk::Format::G8B8G8R8_422_UNORM, [4, 4]), None);
    }

    #[test]
    fn a_view_never_sees_stencil() {
        assert_eq!(view_aspect(vk::Format::D24_UNORM_S8_UINT), vk::ImageAspectFlags::DEPTH);
        assert_eq!(view_aspect(vk::Format::R8_UNORM), vk::ImageAspectFlags::COLOR);
    }
}
