//! Twin of `hash.glsl`: integers, so the bits agree everywhere.

use super::Twin;
use super::domain::Domain;

/// Source: Jarzynski & Olano 2020, "Hash Functions for GPU Rendering", pcg3d.
pub fn pcg3d(key: [u32; 3]) -> [u32; 3] {
    let [mut x, mut y, mut z] = key.map(|word| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    for round in 0..2 {
        x = x.wrapping_add(y.wrapping_mul(z));
        y = y.wrapping_add(z.wrapping_mul(x));
        z = z.wrapping_add(x.wrapping_mul(y));
        if round == 0 {
            x ^= x >> 16;
            y ^= y >> 16;
            z ^= z >> 16;
        }
    }
    [x, y, z]
}

/// Three uniform numbers in [0, 1) of a lattice cell.
pub fn cell(cell: [i32; 3]) -> [f64; 3] {
    pcg3d(cell.map(|coordinate| coordinate as u32)).map(|bits| f64::from(bits >> 8) / f64::from(1u32 << 24))
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("hash_pcg3d", &[Domain::Bits], |inputs| {
        pcg3d([inputs.uint(), inputs.uint(), inputs.uint()]).map(f64::from).to_vec()
    })
    .limit(0.0, 0.0),
    Twin::new("hash_cell", &[Domain::Bits], |inputs| cell([inputs.int(), inputs.int(), inputs.int()]).to_vec())
        .limit(0.0, 0.0),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_uniform_and_independent() {
        let count = 20_000;
        let mut sums = [0.0; 6];
        for index in 0..count {
            let [x, y, z] = cell([index % 40 - 20, index / 40 % 25 - 12, index / 1000]);
            assert!([x, y, z].iter().all(|number| (0.0..1.0).contains(number)));
            for (sum, value) in sums.iter_mut().zip([x, y, z, x * y, y * z, z * x]) {
                *sum += value / f64::from(count);
            }
        }
        // Means within five standard errors: 0.2887 / sqrt(20000) = 0.002 (0.0016 for the products).
        for (mean, expected) in sums.iter().zip([0.5, 0.5, 0.5, 0.25, 0.25, 0.25]) {
            assert!((mean - expected).abs() < 0.0102, "{mean} for {expected}");
        }
    }
}
