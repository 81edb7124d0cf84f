//! The sRGB transfer curve (IEC 61966-2-1), one channel.

/// Linear light of a coded value, both in [0, 1].
pub fn linear_from_srgb(coded: f32) -> f32 {
    if coded <= 0.04045 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }
}

/// Linear light of a coded byte, rounded once.
pub fn linear_from_srgb_byte(coded: u8) -> f32 {
    let coded = f64::from(coded) / 255.0;
    (if coded <= 0.04045 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }) as f32
}

/// Coded value of linear light, both in [0, 1].
pub fn srgb_from_linear(linear: f32) -> f32 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_comes_back() {
        for byte in 0..=255u8 {
            let linear = linear_from_srgb(f32::from(byte) / 255.0);
            assert_eq!((srgb_from_linear(linear) * 255.0).round() as u8, byte);
            assert!((linear_from_srgb_byte(byte) - linear).abs() < 1e-6);
        }
        assert!((linear_from_srgb(0.5) - 0.214_041).abs() < 1e-6);
    }
}
