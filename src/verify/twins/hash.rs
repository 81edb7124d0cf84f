//! Judges `hash.glsl`: the same bits everywhere.

use super::super::domain::Domain;
use super::super::twin::Twin;
use crate::material::reference::hash;

pub(super) const TWINS: &[Twin] = &[
    Twin::new("hash_pcg3d", &[Domain::Bits], |given| {
        hash::pcg3d([given.uint(), given.uint(), given.uint()]).map(f64::from).to_vec()
    })
    .limit(0.0, 0.0),
    Twin::new("hash_cell", &[Domain::Bits], |given| hash::cell([given.int(), given.int(), given.int()]).to_vec())
        .limit(0.0, 0.0),
];
