//! What is made of an environment, as plain data, and as the bytes of a file.

use glam::Vec3;

/// Coefficients of the harmonics: bands 0 to 4.
pub const SH_COEFFICIENTS: usize = 25;

/// An environment as shaders read it.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedEnvironment {
    /// Side of the faces of level 0, texels; half of it in each further level.
    pub face_px: u32,
    /// Radiance over `scale` under the lobe of each level's roughness: RGBA half floats, six faces in Vulkan's order of
    /// each level, their rows from the top.
    pub levels: Vec<Vec<u8>>,
    /// Linear RGB radiance of a texel of 1.
    pub scale: Vec3,
    /// Linear RGB radiance in orthonormal real spherical harmonics, coefficient `l * l + l + m` (`environment_sh`).
    pub harmonics: [Vec3; SH_COEFFICIENTS],
}

impl PreparedEnvironment {
    /// Number of the last level.
    pub fn last_level(&self) -> u32 {
        self.levels.len().saturating_sub(1) as u32
    }

    /// All of it, little-endian.
    pub(super) fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        bytes.extend(self.face_px.to_le_bytes());
        bytes.extend((self.levels.len() as u32).to_le_bytes());
        let numbers = self.harmonics.iter().chain([&self.scale]).flat_map(|vector| vector.to_array());
        bytes.extend(numbers.flat_map(f32::to_le_bytes));
        bytes.extend(self.levels.iter().flatten());
        bytes
    }

    /// The inverse; `None` where the bytes are not such a thing.
    pub(super) fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let mut rest = bytes;
        let mut word = || {
            let (word, others) = rest.split_first_chunk::<4>()?;
            rest = others;
            Some(*word)
        };
        let face_px = u32::from_le_bytes(word()?);
        let level_count = u32::from_le_bytes(word()?);
        let mut vectors = [Vec3::ZERO; SH_COEFFICIENTS + 1];
        for number in vectors.iter_mut().flat_map(|vector| vector.as_mut()) {
            *number = f32::from_le_bytes(word()?);
        }
        let mut levels = Vec::new();
        for level in 0..level_count {
            let side = u64::from(face_px.checked_shr(level)?);
            let (texels, others) = rest.split_at_checked(usize::try_from(6 * 8 * side * side).ok()?)?;
            rest = others;
            levels.push(texels.to_vec());
        }
        let (scale, harmonics) = (vectors[SH_COEFFICIENTS], std::array::from_fn(|index| vectors[index]));
        (rest.is_empty() && level_count > 0).then_some(Self { face_px, levels, scale, harmonics })
    }
}
