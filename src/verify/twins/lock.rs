//! Judges `lock.glsl`.

use super::super::domain::{Domain, UNIT};
use super::super::twin::{Rule, Twin};
use super::strand::PLACE;
use crate::material::reference::lock;

pub(super) const TWINS: &[Twin] = &[
    // Places in locks keep 2^-21; nine strands a lock, and a gathered tip is 1 / 0.15 - 1 times as far: 9 * 5.7 * 2^-20,
    // and 2e-5 for the rest.
    Twin::new("lock_root", &[PLACE, Domain::Direction, UNIT, UNIT, UNIT], |given| {
        let (position, normal) = (given.vec3(), given.vec3());
        lock::root(position, normal, given.number(), given.number(), given.number()).to_array().to_vec()
    })
    .limit(2e-5, 7e-5)
    .rule(Rule::Stepped(4)),
];
