//! Fur as exact geometry: where its shells are, and what of them is strand.

use super::bvh::Bounds;
use crate::measure::twin::direction;
use crate::measure::twin::lock;
use crate::measure::twin::strand::{self, Strand};
use glam::DVec3;

/// One corner of a triangle of the skin, and how strands grow there.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Corner {
    /// Where it is, metres, world space.
    pub root: DVec3,
    /// Unit vector in which strands leave the skin, world space.
    pub direction: DVec3,
    /// Unit vector across it, to which strands bend; zero where they stand straight.
    pub sideways: DVec3,
    /// Turn from root to tip, radians, in [0, pi / 2].
    pub bend_angle: f64,
    /// Length of the strands, metres.
    pub length_m: f64,
    /// The root in the rest pose, in strand spacings.
    pub root_in_cells: DVec3,
    /// The direction in the rest pose, unit vector.
    pub direction_in_rest: DVec3,
}

impl Corner {
    /// Its place on the shell at a height in [0, 1].
    pub fn at(&self, height: f64) -> DVec3 {
        let [across, along] = strand::arc(height, self.bend_angle);
        self.root + (self.sideways * across + self.direction * along) * self.length_m
    }

    /// Tangent of the strand at a height.
    pub fn strand_at(&self, height: f64) -> DVec3 {
        let (sine, cosine) = (self.bend_angle * height).sin_cos();
        self.sideways * sine + self.direction * cosine
    }

    /// How far its path over a span of heights may bow from the chord, metres: an arc of curvature angle / length.
    pub(super) fn bow_m(&self, span: f64) -> f64 {
        self.length_m * self.bend_angle * span * span / 8.0
    }
}

/// A triangle of the skin and the fur above it.
pub type Triangle = [Corner; 3];

/// A box around all shells of a triangle: both coordinates of the arc grow with the height.
pub(super) fn bounds(triangle: &Triangle) -> Bounds {
    Bounds::around(triangle.iter().flat_map(|corner| {
        let [across, along] = strand::arc(1.0, corner.bend_angle).map(|share| share * corner.length_m);
        [(0.0, 0.0), (across, 0.0), (0.0, along), (across, along)]
            .map(|(across, along)| corner.root + corner.sideways * across + corner.direction * along)
    }))
}

/// Mean of a value of the corners.
pub(super) fn mixed(barycentric: DVec3, value: impl Fn(usize) -> DVec3) -> DVec3 {
    value(0) * barycentric.x + value(1) * barycentric.y + value(2) * barycentric.z
}

/// What decides which places in fur are strand. The names are those of [`crate::material::Fur`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FurGeometry {
    /// Root radius of the strands, in spacings.
    pub radius: f64,
    /// Threshold of the profile at the root.
    pub cutoff_start: f64,
    /// Threshold at the tip.
    pub cutoff_end: f64,
    /// Strands keep their thickness for longer.
    pub is_paraboloid: bool,
    /// How fast strands thin beside that.
    pub taper: f64,
    /// How far tips draw together.
    pub clump: f64,
    /// How far strands coil.
    pub curl: f64,
}

/// The lock that a place belongs to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lock {
    /// Its middle, in strand spacings.
    middle: DVec3,
    random: f64,
}

/// A place of the skin in the strands' lattice, in strand spacings, and the unit normal there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Skin {
    pub place: DVec3,
    pub normal: DVec3,
}

impl FurGeometry {
    /// Threshold of the profile at a height.
    pub fn threshold(&self, height: f64) -> f64 {
        strand::threshold(height, self.cutoff_start, self.cutoff_end, self.is_paraboloid)
            + 0.5 * self.taper * height * height
    }

    /// Profile of the strongest strand at a place of the shell at a height, and that strand's random number. The place is
    /// strand where the profile reaches the threshold.
    pub fn profile(&self, triangle: &Triangle, barycentric: DVec3, height: f64) -> (f64, f64) {
        let skin = self.skin(triangle, barycentric);
        let root = self.root(skin, self.lock(skin), height);
        strand::field(root, skin.normal, self.radius)
    }

    pub(super) fn skin(&self, triangle: &Triangle, barycentric: DVec3) -> Skin {
        let normal = mixed(barycentric, |corner| triangle[corner].direction_in_rest);
        let place = mixed(barycentric, |corner| triangle[corner].root_in_cells);
        Skin { place, normal: direction::or(normal, DVec3::Y) }
    }

    /// `None` where strands do not gather.
    pub(super) fn lock(&self, skin: Skin) -> Option<Lock> {
        (self.clump > 0.0 || self.curl > 0.0).then(|| {
            let (offset, random) = lock::middle(skin.place / lock::SIZE);
            Lock { middle: skin.place + offset * lock::SIZE, random }
        })
    }

    /// Root of the strand that passes over a place of the skin, if it belongs to that lock.
    pub(super) fn root(&self, skin: Skin, lock: Option<Lock>, height: f64) -> DVec3 {
        lock.map_or(skin.place, |Lock { middle, random }| {
            let to_middle = middle - skin.place;
            let from_middle = to_middle.dot(skin.normal) * skin.normal - to_middle;
            skin.place + lock::way_to_root(from_middle, random, skin.normal, height, self.clump, self.curl)
        })
    }

    /// How far inside a strand a root is at a height, in strand spacings; negative outside.
    pub(super) fn margin(&self, strand: &Strand, root: DVec3, normal: DVec3, height: f64) -> f64 {
        let (in_plane, shrink) = strand.offset(root, normal);
        let left = 1.0 - self.threshold(height) / strand.full_length();
        // Out of reach both factors may be negative, and a strand must not come of that.
        self.radius * shrink * if shrink > 0.0 { left } else { 1.0 } - in_plane.length()
    }
}

impl Lock {
    pub(super) fn distance_squared(self, skin: Skin) -> f64 {
        (self.middle - skin.place).length_squared()
    }

    pub(super) fn is(self, other: Self) -> bool {
        (self.middle - other.middle).length_squared() < 1e-6
    }
}
