//! The first strand that a ray meets over one triangle.
//!
//! The ray meets the shell at height k in one place, whose barycentric coordinates have a closed form: k is the parameter
//! of the search. A span of heights is halved until the roots of the places in it run nearly straight for at most a
//! lattice cell; there a strand is met over one interval, whose ends are bracketed and found to rounding.

use super::fur::{FurGeometry, Lock, Skin, Triangle};
use super::ray::Ray;
use crate::measure::twin::strand::{REACH, Strand};
use glam::{DVec2, DVec3};
use std::cell::OnceCell;

/// Where a ray first meets a strand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// Metres from the ray's origin.
    pub distance_m: f64,
    /// Height in the fur, [0, 1].
    pub height: f64,
    /// Place on the shell at that height.
    pub barycentric: DVec3,
}

/// Longest path of roots in one leaf, in strand spacings.
const LEAF_LENGTH: f64 = 1.0;
/// How far it may bow from its chord, in strand spacings, and its barycentric coordinates from theirs.
const LEAF_BOW: f64 = 0.02;
/// Spans below this are given up: what is left of them lies where a shell is seen edge-on, or where two locks meet.
const SMALLEST_SPAN: f64 = 1e-10;
/// Places this far outside a triangle still count, so that rounding leaves no gap between neighbours.
const EDGE: f64 = 1e-12;
/// 1 / golden ratio.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

impl FurGeometry {
    /// The first place of a ray in a strand over this triangle, nearer than `limit_m`.
    pub fn first_hit(&self, triangle: &Triangle, ray: &Ray, limit_m: f64) -> Option<Hit> {
        let mut search = Search { fur: self, triangle, ray, limit_m, hit: None };
        let ends = [0.0, 1.0].map(|height| search.station(height));
        search.walk(&ends[0], &ends[1]);
        search.hit
    }
}

/// The shell at one height, as the ray sees it.
struct Station {
    height: f64,
    /// The corners across the ray, which is the origin.
    corners: [DVec2; 3],
    /// The corners along the ray, metres.
    depths: DVec3,
    /// Where the ray meets the triangle's plane; not finite where it is seen edge-on.
    barycentric: DVec3,
    distance_m: f64,
    /// Twice the triangle's area as it is seen.
    area: f64,
    /// Where the skin is that the ray passes over.
    skin: Skin,
    /// Its lock, once somebody asked.
    lock: OnceCell<Option<Lock>>,
}

impl Station {
    /// Not negative where the ray meets the triangle and not what lies beside or before the picture.
    fn inside(&self) -> f64 {
        (self.barycentric.min_element() + EDGE).min(self.distance_m)
    }
}

/// A station of a leaf, and the root of the strand there.
struct Rooted<'a> {
    at: &'a Station,
    root: DVec3,
}

/// What to do with a span of heights.
enum Span<'a> {
    /// Meet its strands, which are of one lock.
    Leaf([Rooted<'a>; 3], Option<Lock>),
    /// Halve it.
    Halve,
    /// Part it where one lock ends and another begins.
    Part(f64),
}

struct Search<'a> {
    fur: &'a FurGeometry,
    triangle: &'a Triangle,
    ray: &'a Ray,
    limit_m: f64,
    hit: Option<Hit>,
}

impl Search<'_> {
    fn station(&self, height: f64) -> Station {
        let [(a, a_m), (b, b_m), (c, c_m)] = self.triangle.each_ref().map(|corner| self.ray.seen(corner.at(height)));
        let edges = DVec3::new(b.perp_dot(c), c.perp_dot(a), a.perp_dot(b));
        let area = edges.element_sum();
        let (depths, barycentric) = (DVec3::new(a_m, b_m, c_m), edges / area);
        let (skin, lock) = (self.fur.skin(self.triangle, barycentric), OnceCell::new());
        let distance_m = barycentric.dot(depths);
        Station { height, corners: [a, b, c], depths, barycentric, distance_m, area, skin, lock }
    }

    fn lock(&self, station: &Station) -> Option<Lock> {
        *station.lock.get_or_init(|| self.fur.lock(station.skin))
    }

    fn walk(&mut self, low: &Station, high: &Station) {
        let span = high.height - low.height;
        let bow_m = self.triangle.iter().map(|corner| corner.bow_m(span)).fold(0.0, f64::max);
        let nearest_m = low.depths.min(high.depths).min_element() - bow_m;
        if nearest_m >= self.limit_m || misses(low, high, bow_m) {
            return;
        }
        let middle = self.station(0.5 * (low.height + high.height));
        match self.span([low, &middle, high]) {
            Span::Leaf(stations, lock) => self.meet(&stations, lock),
            Span::Part(height) => {
                let [before, after] = [-1.0, 1.0].map(|side| self.station(height + side * SMALLEST_SPAN));
                self.walk_both([low, &before], [&after, high]);
            }
            Span::Halve if span > SMALLEST_SPAN => self.walk_both([low, &middle], [&middle, high]),
            Span::Halve => {}
        }
    }

    /// The nearer first: what it holds hides the other.
    fn walk_both(&mut self, lower: [&Station; 2], upper: [&Station; 2]) {
        let rises = lower[0].depths.element_sum() < upper[1].depths.element_sum();
        for [low, high] in if rises { [lower, upper] } else { [upper, lower] } {
            self.walk(low, high);
        }
    }

    /// A leaf, if the path through the stations is short and nearly straight, and runs one way along the ray and over one
    /// lock.
    fn span<'b>(&self, stations: [&'b Station; 3]) -> Span<'b> {
        let [a, m, b] = stations;
        let bow = |a: DVec3, m: DVec3, b: DVec3| (m - 0.5 * (a + b)).length();
        let one_way = (m.distance_m - a.distance_m) * (b.distance_m - m.distance_m) > 0.0;
        let one_side = m.area * a.area > 0.0 && m.area * b.area > 0.0;
        let short = (a.skin.place - b.skin.place).length() <= LEAF_LENGTH
            && bow(a.skin.place, m.skin.place, b.skin.place) <= LEAF_BOW;
        if !one_way || !one_side || !short || bow(a.barycentric, m.barycentric, b.barycentric) > LEAF_BOW {
            return Span::Halve;
        }
        let lock = self.lock(m);
        if let (Some(first), Some(middle), Some(last)) = (self.lock(a), lock, self.lock(b)) {
            for (end, other) in [(a, first), (b, last)] {
                if !other.is(middle) {
                    let height = self.boundary((end, other), (m, middle));
                    // Beside an end, the boundary is one that the span was parted at.
                    if (height - end.height).abs() > 4.0 * SMALLEST_SPAN {
                        return Span::Part(height);
                    }
                }
            }
        }
        let rooted = stations.map(|at| Rooted { at, root: self.fur.root(at.skin, lock, at.height) });
        let [a, m, b] = rooted.each_ref().map(|rooted| rooted.root);
        let straight = bow(a, m, b) <= LEAF_BOW && (a - b).length() <= LEAF_LENGTH;
        if straight { Span::Leaf(rooted, lock) } else { Span::Halve }
    }

    /// The height between two stations at which their locks are equally near (secant method: along a leaf the difference
    /// is nearly linear).
    fn boundary(&self, (from, of_from): (&Station, Lock), (to, of_to): (&Station, Lock)) -> f64 {
        let nearer = |skin: Skin| of_from.distance_squared(skin) - of_to.distance_squared(skin);
        let (mut before, mut after) = ((from.height, nearer(from.skin)), (to.height, nearer(to.skin)));
        for _ in 0..8 {
            let height = before.0 + (after.0 - before.0) * before.1 / (before.1 - after.1);
            if (height - after.0).abs() <= 0.01 * SMALLEST_SPAN || !height.is_finite() {
                break;
            }
            (before, after) = (after, (height, nearer(self.station(height).skin)));
        }
        after.0.clamp(from.height.min(to.height), from.height.max(to.height))
    }

    /// Meets all strands along a leaf.
    fn meet(&mut self, leaf: &[Rooted; 3], lock: Option<Lock>) {
        let fur = self.fur;
        let [a, m, b] = leaf;
        if a.at.distance_m.min(b.at.distance_m) >= self.limit_m {
            return;
        }
        let span = b.at.height - a.at.height;
        let least = leaf.iter().map(|at| fur.threshold(at.at.height)).fold(f64::INFINITY, f64::min)
            - (fur.taper + (fur.cutoff_end - fur.cutoff_start).abs()) * span * span;
        // What chord and middle normal leave out of the path: its bow, and turned strands.
        let slack = 2.0 * (m.root - 0.5 * (a.root + b.root)).length()
            + (a.at.skin.normal - m.at.skin.normal).length().max((b.at.skin.normal - m.at.skin.normal).length());
        let radius = fur.radius * (1.0 - least).min(1.0) + slack;
        if radius <= slack {
            return;
        }
        let across = (1.0 - m.at.skin.normal * m.at.skin.normal).max(DVec3::ZERO).map(f64::sqrt);
        let margin = across * radius + m.at.skin.normal.abs() * (REACH + slack);
        let low = (a.root.min(b.root) - margin).floor();
        let high = (a.root.max(b.root) + margin).floor();
        let chord = b.root - a.root;
        let rise = chord.dot(m.at.skin.normal);
        let along = chord - rise * m.at.skin.normal;
        let along_squared = along.length_squared().max(1e-300);
        let mut cell = low;
        while cell.z <= high.z {
            while cell.y <= high.y {
                while cell.x <= high.x {
                    let strand = Strand::of_cell(cell);
                    cell.x += 1.0;
                    let offset = strand.point - a.root;
                    let height = offset.dot(m.at.skin.normal);
                    let foot = (offset.dot(along) / along_squared).clamp(0.0, 1.0);
                    let off = offset - height * m.at.skin.normal - foot * along;
                    let is_near = off.length_squared() <= radius * radius
                        && height.max(height - rise) >= -(REACH + slack)
                        && height.min(height - rise) <= REACH + slack;
                    if is_near {
                        self.meet_strand(&strand, leaf, lock, foot);
                    }
                }
                cell.x = low.x;
                cell.y += 1.0;
            }
            cell.y = low.y;
            cell.z += 1.0;
        }
    }

    /// How far inside strand and triangle the ray is at a height, and where.
    fn exact(&self, strand: &Strand, lock: Option<Lock>, height: f64) -> (f64, Station) {
        let at = self.station(height);
        let root = self.fur.root(at.skin, lock, height);
        (self.fur.margin(strand, root, at.skin.normal, height).min(at.inside()), at)
    }

    fn meet_strand(&mut self, strand: &Strand, leaf: &[Rooted; 3], lock: Option<Lock>, foot: f64) {
        let [a, m, b] = leaf;
        let span = b.at.height - a.at.height;
        let fur = self.fur;
        // The parabola through the three stations stands in for the path where a rough answer is enough.
        let roughly = |share: f64| {
            let weights =
                [2.0 * (share - 0.5) * (share - 1.0), 4.0 * share * (1.0 - share), 2.0 * share * (share - 0.5)];
            let mix =
                |value: fn(&Rooted) -> DVec3| value(a) * weights[0] + value(m) * weights[1] + value(b) * weights[2];
            let inside = a.at.inside() * weights[0] + m.at.inside() * weights[1] + b.at.inside() * weights[2];
            let (root, normal) = (mix(|rooted| rooted.root), mix(|rooted| rooted.at.skin.normal).normalize());
            fur.margin(strand, root, normal, a.at.height + share * span).min(inside)
        };
        // The margin is nearly concave along the leaf: less concave than this is its distance from a straight path.
        let mut best = (foot, roughly(foot));
        if best.1 <= 0.0 {
            best = largest(roughly, 0.0, 1.0, 14);
        }
        let mut within = self.exact(strand, lock, a.at.height + best.0 * span);
        if within.0 <= 0.0 {
            if best.1 < -LEAF_BOW * LEAF_BOW {
                return;
            }
            // A strand that is barely touched, if at all.
            let exactly = |share: f64| self.exact(strand, lock, a.at.height + share * span).0;
            let (share, margin) = largest(exactly, 0.0, 1.0, 40);
            if margin <= 0.0 {
                return;
            }
            within = self.exact(strand, lock, a.at.height + share * span);
        }
        let near = if a.at.distance_m < b.at.distance_m { a } else { b };
        let near_margin = fur.margin(strand, near.root, near.at.skin.normal, near.at.height).min(near.at.inside());
        if near_margin >= 0.0 {
            self.keep(near.at);
        } else {
            self.keep(&self.entry(strand, lock, near_margin, near.at.height, within));
        }
    }

    fn keep(&mut self, at: &Station) {
        if at.distance_m < self.limit_m {
            self.limit_m = at.distance_m;
            let Station { distance_m, height, barycentric, .. } = *at;
            self.hit = Some(Hit { distance_m, height, barycentric });
        }
    }

    /// The first place inside a strand, between a height outside and a place inside: false position, of the Illinois kind
    /// (Dowell & Jarratt 1971, "A modified regula falsi method").
    fn entry(
        &self,
        strand: &Strand,
        lock: Option<Lock>,
        mut below: f64,
        mut outside: f64,
        mut inside: (f64, Station),
    ) -> Station {
        let mut above = inside.0;
        let mut moved_inside = None;
        for _ in 0..60 {
            let end = inside.1.height;
            if (end - outside).abs() < 1e-14 || inside.0 < 1e-13 {
                break;
            }
            let found = self.exact(strand, lock, outside + (end - outside) * (below / (below - above)).clamp(0.0, 1.0));
            // The end that stays twice counts half, or it would stay for ever.
            let is_inside = found.0 >= 0.0;
            let weight = if moved_inside.replace(is_inside) == Some(is_inside) { 0.5 } else { 1.0 };
            if is_inside {
                (above, below) = (found.0, weight * below);
                inside = found;
            } else {
                (outside, below, above) = (found.1.height, found.0, weight * above);
            }
        }
        inside.1
    }
}

/// Whether the ray surely misses all shells between two stations: a line through two corners separates it from all six.
fn misses(low: &Station, high: &Station, bow_m: f64) -> bool {
    let [a, b, c] = low.corners;
    let [d, e, f] = high.corners;
    let points = [a, b, c, d, e, f];
    let separates = |across: DVec2| {
        let sides = points.map(|point| point.dot(across));
        let reach = bow_m * across.length();
        sides.iter().all(|&side| side > reach) || sides.iter().all(|&side| side < -reach)
    };
    let lines = [(a, b), (b, c), (c, a), (d, e), (e, f), (f, d), (a, d), (b, e), (c, f)];
    separates(DVec2::X) || separates(DVec2::Y) || lines.iter().any(|&(from, to)| separates((to - from).perp()))
}

/// Where a concave function is largest, by golden section, and its value there. Stops at the first value above 0.
fn largest(value: impl Fn(f64) -> f64, mut low: f64, mut high: f64, steps: usize) -> (f64, f64) {
    let mut left = high - GOLDEN * (high - low);
    let mut right = low + GOLDEN * (high - low);
    let (mut at_left, mut at_right) = (value(left), value(right));
    for _ in 0..steps {
        if at_left.max(at_right) > 0.0 {
            break;
        }
        if at_left > at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - GOLDEN * (high - low);
            at_left = value(left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + GOLDEN * (high - low);
            at_right = value(right);
        }
    }
    if at_left > at_right { (left, at_left) } else { (right, at_right) }
}
