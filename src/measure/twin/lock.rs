//! Twin of `lock.glsl`: locks of strands.

use super::domain::{Domain, UNIT};
use super::strand::PLACE;
use super::{Rule, Twin, hash};
use glam::DVec3;
use std::f64::consts::TAU;

/// Strand spacings across a lock.
pub const SIZE: f64 = 9.0;
/// Jitter of a lock's middle, in locks.
pub const JITTER: f64 = 0.25;

/// The middle of the lock that a place belongs to, relative to it and in locks, and the lock's random number.
pub fn middle(in_locks: DVec3) -> (DVec3, f64) {
    let mut nearest = (DVec3::INFINITY, 0.0);
    let mut look_at = |cell: DVec3| {
        let random = hash::cell(cell.to_array().map(|coordinate| coordinate as i32 + 7919));
        let offset = cell + 0.5 + (DVec3::from_array(random) * 2.0 - 1.0) * JITTER - in_locks;
        if offset.length_squared() < nearest.0.length_squared() {
            nearest = (offset, random[0]);
        }
        nearest
    };
    let corner = (in_locks - 0.5).floor();
    for index in 0..8 {
        look_at(corner + DVec3::new(f64::from(index % 2), f64::from(index / 2 % 2), f64::from(index / 4)));
    }
    // The middles of all other cells are at least this far away.
    if look_at(corner).0.length() < 1.0 - JITTER {
        return nearest;
    }
    for index in 0..125 {
        let step = DVec3::new(f64::from(index % 5), f64::from(index / 5 % 5), f64::from(index / 25)) - 2.0;
        look_at(in_locks.floor() + step);
    }
    nearest
}

/// From the middle of its lock to a place (in strand spacings), across the strands; and the lock's random number.
pub fn at(position: DVec3, normal: DVec3) -> (DVec3, f64) {
    let (middle, random) = middle(position / SIZE);
    ((middle.dot(normal) * normal - middle) * SIZE, random)
}

/// Root that the strand passing at `position` (in strand spacings) and `height` grew from.
pub fn root(position: DVec3, normal: DVec3, height: f64, clump: f64, curl: f64) -> DVec3 {
    let (from_middle, random) = at(position, normal);
    position + way_to_root(from_middle, random, normal, height, clump, curl)
}

/// From a place to that root; see the shader.
pub fn way_to_root(from_middle: DVec3, random: f64, normal: DVec3, height: f64, clump: f64, curl: f64) -> DVec3 {
    let gather = 1.0 / (1.0 - 0.85 * clump * height).max(0.1);
    let away = if normal.y.abs() < 0.9 { DVec3::Y } else { DVec3::X };
    let side = normal.cross(away).normalize();
    let (sine, cosine) = (2.0 * TAU * if random < 0.5 { -height } else { height } + TAU * random).sin_cos();
    from_middle * (gather - 1.0) + curl * height * (cosine * side + sine * normal.cross(side))
}

/// A component of the way from a lock's middle, in strand spacings.
const FROM_MIDDLE: Domain = Domain::Uniform(-7.0, 7.0, &[0.0, 1e-40, 7.0]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    // Places in locks keep 2^-21, and a lock is nine strands wide; the eight locks that the shader looks at hold the
    // nearest but in very few places.
    Twin::new("lock_at", &[PLACE, Domain::Direction], |inputs| {
        let (from_middle, random) = at(inputs.vec3(), inputs.vec3());
        [from_middle.to_array().as_slice(), &[random]].concat()
    })
    .limit(2e-5, 2e-5)
    .rule(Rule::Stepped(4))
    .missed(1e-5),
    // Turns of up to 19 radians keep 2^-19.
    Twin::new("lock_way_to_root", &[FROM_MIDDLE, UNIT, Domain::Direction, UNIT, UNIT, UNIT], |inputs| {
        let (from_middle, random, normal) = (inputs.vec3(), inputs.number(), inputs.vec3());
        way_to_root(from_middle, random, normal, inputs.number(), inputs.number(), inputs.number()).to_array().to_vec()
    })
    .limit(2e-5, 1e-5)
    .rule(Rule::Stepped(4)),
];

#[cfg(test)]
mod tests {
    use super::*;

    fn places() -> impl Iterator<Item = (DVec3, DVec3)> {
        (0..500).map(|index| {
            let [x, y, z] = hash::cell([index, 1, 2]);
            let normal = DVec3::new(x - 0.5, y - 0.5, z - 0.5).normalize();
            (DVec3::new(x, y, z) * 80.0 - 40.0, normal)
        })
    }

    #[test]
    fn roots_hold_still_and_strands_stay_near_them() {
        for (position, normal) in places() {
            assert_eq!(root(position, normal, 0.0, 1.0, 1.0), position);
            for height in [0.3, 1.0] {
                let moved = root(position, normal, height, 0.0, 1.0) - position;
                assert!((moved.length() - height).abs() < 1e-12, "a coil's radius is its height");
                assert!(moved.dot(normal).abs() < 1e-12, "strands are looked up along the surface");
            }
        }
    }

    #[test]
    fn a_clump_draws_tips_to_the_middle() {
        for (position, normal) in places() {
            let (middle, _) = middle(position / SIZE);
            let from_middle = (middle.dot(normal) * normal - middle) * SIZE;
            let grew_from = root(position, normal, 1.0, 1.0, 0.0) - position;
            // What stands here at the tip grew farther out, by the same direction.
            assert!((grew_from - from_middle * (1.0 / 0.15 - 1.0)).length() < 1e-9 * SIZE);
        }
    }

    #[test]
    fn the_eight_nearest_locks_are_enough() {
        let mut differ = 0;
        for (position, _) in places() {
            let in_locks = position / SIZE;
            let corner = (in_locks - 0.5).floor();
            let (nearest, _) = middle(in_locks);
            let cell = (nearest + in_locks).floor() - corner;
            differ += i32::from(cell.min_element() < 0.0 || cell.max_element() > 1.0);
        }
        assert!(differ <= 5, "{differ} of 500 places have a nearer lock than the eight that the shader looks at");
    }
}
