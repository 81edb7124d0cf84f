//! Judges `lock.glsl`.

use super::super::domain::{Domain, UNIT};
use super::super::twin::{Rule, Twin};
use super::strand::PLACE;
use crate::material::reference::lock;

/// A component of the way from a lock's middle, in strand spacings.
const FROM_MIDDLE: Domain = Domain::Uniform(-7.0, 7.0, &[0.0, 1e-40, 7.0]);

pub(super) const TWINS: &[Twin] = &[
    // Places in locks keep 2^-21, and a lock is nine strands wide; the eight locks that the shader looks at hold the
    // nearest but in very few places.
    Twin::new("lock_at", &[PLACE, Domain::Direction], |given| {
        let (from_middle, random) = lock::at(given.vec3(), given.vec3());
        [from_middle.to_array().as_slice(), &[random]].concat()
    })
    .limit(2e-5, 2e-5)
    .rule(Rule::Stepped(4))
    .missed(1e-5),
    // Turns of up to 19 radians keep 2^-19.
    Twin::new("lock_way_to_root", &[FROM_MIDDLE, UNIT, Domain::Direction, UNIT, UNIT, UNIT], |given| {
        let (from_middle, random, normal) = (given.vec3(), given.number(), given.vec3());
        lock::way_to_root(from_middle, random, normal, given.number(), given.number(), given.number())
            .to_array()
            .to_vec()
    })
    .limit(2e-5, 1e-5)
    .rule(Rule::Stepped(4)),
];
