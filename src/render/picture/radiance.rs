//! Linear radiance as floats, from the texels of the HDR target.

use crate::render::options::HdrFormat;
use glam::Vec4;

/// HDR texels as floats.
pub(super) fn decode_radiance(format: HdrFormat, bytes: &[u8]) -> Vec<Vec4> {
    match format {
        HdrFormat::Rgba16f => bytes
            .chunks_exact(8)
            .map(|texel| {
                let half = |index: usize| half::f16::from_le_bytes([texel[index * 2], texel[index * 2 + 1]]).to_f32();
                Vec4::new(half(0), half(1), half(2), half(3))
            })
            .collect(),
        HdrFormat::B10g11r11 => bytes
            .chunks_exact(4)
            .map(|texel| {
                let word = u32::from_le_bytes([texel[0], texel[1], texel[2], texel[3]]);
                Vec4::new(
                    small_float(word & 0x7ff, 6),
                    small_float((word >> 11) & 0x7ff, 6),
                    small_float(word >> 22, 5),
                    1.0,
                )
            })
            .collect(),
    }
}

/// Unsigned float of five exponent bits and `mantissa_bits` (Vulkan 1.3, "Unsigned 11-Bit Floating-Point Numbers").
fn small_float(bits: u32, mantissa_bits: u32) -> f32 {
    let mantissa = (bits & ((1 << mantissa_bits) - 1)) as f32 / (1 << mantissa_bits) as f32;
    match bits >> mantissa_bits {
        0 => mantissa * 2f32.powi(-14),
        31 if mantissa == 0.0 => f32::INFINITY,
        31 => f32::NAN,
        exponent => (1.0 + mantissa) * 2f32.powi(exponent as i32 - 15),
    }
}
