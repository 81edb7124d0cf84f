//! Domains that the functions of glint share, and how their structs are read.

use crate::material::Flakes;
use crate::measure::twin::domain::{ALMOST_ONE, Domain, UNIT};
use crate::measure::twin::{Rule, TestInputs};
use glam::{DVec2, DVec3, IVec2};

/// A place or tile next to another one.
pub(super) const NEAR: Domain = Domain::Choice(&[0, 1, u32::MAX]);
pub(super) const FINENESS: Domain = Domain::Choice(&[2, 3, 5, 8]);
pub(super) const LEVEL: Domain = Domain::Choice(&[0, 1, 2, 9]);
pub(super) const CHART: Domain = Domain::Choice(&[0, 1, 2]);
/// Component of a vector, in rhombi.
pub(super) const VECTOR: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-40, 0.4]);
pub(super) const RADIUS: Domain = Domain::Uniform(0.0, 0.498, &[0.0, 0.433, 0.498]);
/// As a pixel sees it.
pub(super) const WIDE_LOBE: Domain = Domain::Log(0.25, 10.0, &[0.25, 0.5, 10.0]);
pub(super) const LOBE: Domain = Domain::Uniform(0.25, 0.5, &[0.25, 0.5]);
/// In the square of normals.
pub(super) const SQUARE: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-7, 1.0]);
pub(super) const SPREAD: Domain = Domain::Log(1e-8, 10.0, &[0.0, 1e-4, 10.0]);
pub(super) const SHARE: Domain = Domain::Uniform(0.0, 0.5, &[0.0, 0.5]);

// In the order of the shader's structs.
pub(super) const FLAKES: [Domain; 5] = [RADIUS, UNIT, LOBE, UNIT, Domain::Choice(&[2, 3])];
pub(super) const FOOTPRINT: [Domain; 9] = [
    NEAR,
    Domain::Uniform(0.0, ALMOST_ONE, &[0.0, 0.5, ALMOST_ONE]),
    VECTOR,
    VECTOR,
    Domain::Uniform(0.0, 0.4, &[0.0, 0.2]),
    Domain::Log(1.0, 5e3, &[1.0, 5e3]),
    Domain::Log(0.05, 100.0, &[0.05, 1.0]),
    Domain::Uniform(0.0, 4.0, &[0.0, 4.0]),
    Domain::Uniform(0.0, 1.0, &[0.0, 0.2, 0.3, 0.45]),
];
pub(super) const TINTED: Domain = Domain::Uniform(0.0, 4.0, &[0.0, 1.0]);
pub(super) const DISC: [Domain; 2] = [TINTED, SQUARE];
pub(super) const TILES: [Domain; 7] =
    [NEAR, CHART, Domain::Choice(&[0, 1]), Domain::Bits, Domain::Bits, Domain::Bits, Domain::Bits];

/// The domains of several arguments, one after the other.
pub(super) const fn join<const N: usize>(lists: &[&[Domain]]) -> [Domain; N] {
    let mut all = [UNIT; N];
    let (mut list, mut count) = (0, 0);
    while list < lists.len() {
        let mut at = 0;
        while at < lists[list].len() {
            all[count] = lists[list][at];
            (at, count) = (at + 1, count + 1);
        }
        list += 1;
    }
    assert!(count == N, "one domain a member");
    all
}

pub(super) fn read_flakes(inputs: &mut TestInputs<'_>) -> Flakes {
    let [radius, jitter, lobe, variation] = [(); 4].map(|()| inputs.number() as f32);
    // Where flakes are and how they lean is no part of the shader's struct.
    Flakes { radius, jitter, lobe, variation, fineness: inputs.uint(), cells_per_metre: 1.0, alpha: 1.0 }
}

pub(super) fn ivec2(inputs: &mut TestInputs<'_>) -> IVec2 {
    IVec2::new(inputs.int(), inputs.int())
}

pub(super) fn uvec2(inputs: &mut TestInputs<'_>) -> [u32; 2] {
    [inputs.uint(), inputs.uint()]
}

pub(super) fn words2(vector: DVec2) -> Vec<f64> {
    vector.to_array().to_vec()
}

pub(super) fn words3(vector: DVec3) -> Vec<f64> {
    vector.to_array().to_vec()
}

/// A kernel falls from its peak to nothing over a part of a rhombus in proportion to its sharpness: rounding of offsets, and
/// of the distance made of them, counts by that.
pub(super) const KERNEL: Rule = Rule::Conditioned(4);
