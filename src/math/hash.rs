//! Hashes: a checksum that finds damage and tells contents apart, no defence against those who forge; and random bits of a
//! lattice.

/// FNV-1a, 64 bits (Fowler, Noll and Vo 1991), of pieces one after the other.
pub fn fnv1a<'a>(pieces: impl IntoIterator<Item = &'a [u8]>) -> u64 {
    pieces
        .into_iter()
        .flatten()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}

/// Three random words of three: pcg3d (Jarzynski & Olano 2020, "Hash Functions for GPU Rendering").
pub fn pcg3d(key: [u32; 3]) -> [u32; 3] {
    let mixed = |[x, y, z]: [u32; 3]| {
        let x = x.wrapping_add(y.wrapping_mul(z));
        let y = y.wrapping_add(z.wrapping_mul(x));
        [x, y, z.wrapping_add(x.wrapping_mul(y))]
    };
    let spread = key.map(|word| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    mixed(mixed(spread).map(|word| word ^ word >> 16))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_values() {
        assert_eq!(fnv1a([]), 0xcbf2_9ce4_8422_2325);
        assert_eq!(fnv1a([b"foo".as_slice(), b"bar"]), 0x8594_4171_f739_67e8);
    }
}
