//! Twin of `strand.glsl`: where strands stand and how they scatter light.

use super::domain::{Domain, UNIT};
use super::{Rule, TestInputs, Twin, ULP, hash};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// Share of a cell by which a strand is jittered to either side.
pub const JITTER: f64 = 0.5;
/// Farthest distance, in cells, of a strand's point from the surface.
pub const REACH: f64 = 0.5;
/// Thinner strands, in cells, are none.
pub const SMALLEST_RADIUS: f64 = 1e-3;

/// A procedural strand, if a surface passes close by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strand {
    /// Where it roots, in cells.
    pub point: DVec3,
    /// Its own number in [0, 1).
    pub random: f64,
}

impl Strand {
    /// The one of a lattice cell, given by its lower corner.
    pub fn of_cell(cell: DVec3) -> Self {
        let random = hash::cell(cell.to_array().map(|coordinate| coordinate as i32));
        let point = cell + 0.5 + (DVec3::from_array(random) * 2.0 - 1.0) * JITTER;
        Self { point, random: (random[0] * 97.0 + random[1] * 57.0).fract() }
    }

    /// Profile on its axis: how far up the thresholds it reaches.
    pub fn full_length(&self) -> f64 {
        0.75 + 0.25 * self.random
    }

    /// Its point seen from a place on the surface: the offset along the surface, and the share of the root radius that
    /// its height off the surface leaves; the share is not positive where it is out of reach.
    pub fn offset(&self, position: DVec3, normal: DVec3) -> (DVec3, f64) {
        let offset = self.point - position;
        let height = offset.dot(normal);
        (offset - height * normal, 1.0 - (height / REACH).powi(2))
    }
}

/// All strands within `reach` cells of a place, and some beyond.
pub fn around(position: DVec3, reach: f64) -> impl Iterator<Item = Strand> {
    let home = position.floor();
    let cells = (reach + JITTER + REACH).ceil() as i32;
    let steps = move || (-cells..=cells).map(f64::from);
    let steps = steps().flat_map(move |x| steps().flat_map(move |y| steps().map(move |z| DVec3::new(x, y, z))));
    steps.map(move |step| Strand::of_cell(home + step))
}

/// Profile and random number of the strongest procedural strand at a place: 1 on the axis of a full-length strand,
/// falling linearly to 0 at its root radius and below it outside. `position` is in cells, `normal` a unit vector, `radius`
/// in cells. Looks at every cell that can matter.
pub fn field(position: DVec3, normal: DVec3, radius: f64) -> (f64, f64) {
    let mut nearest = (-1e3, 0.0);
    for strand in around(position, 0.5) {
        let (across, share) = strand.offset(position, normal);
        let profile = strand.full_length() * (1.0 - across.length() / (radius * share));
        if share > 0.0 && profile > nearest.0 {
            nearest = (profile, strand.random);
        }
    }
    nearest
}

/// The part of a view ray that a shell stands for; see the shader. Lengths in cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Path {
    /// Root that the ray passes in the slab's middle.
    pub middle: DVec3,
    /// Of the profile there.
    pub threshold: f64,
    /// From the middle to the upper boundary, across the strands.
    pub half_segment: DVec3,
    /// From the middle to the upper boundary.
    pub threshold_rise: f64,
    /// Unit vector.
    pub normal: DVec3,
    /// Of strands at their root.
    pub radius: f64,
    /// 1 where the ray comes in from above, -1 from below.
    pub entry: f64,
    /// Half a pixel in root radii: the margin from which on a strand fills it, > 0.
    pub enough: f64,
}

/// What a ray meets in a slab.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// How far inside a strand the ray comes, in root radii.
    pub margin: f64,
    /// Where in [-1, 1] the ray enters the first strand, if it meets one.
    pub place: f64,
    /// Of that strand.
    pub random: f64,
}

/// No strand.
const NONE: Hit = Hit { margin: -1e3, place: 0.0, random: 0.0 };

/// What the ray meets of one strand, found by halving. What is thinner than a pixel counts by its width.
pub fn meet(path: &Path, strand: &Strand) -> Hit {
    let (across, share) = strand.offset(path.middle, path.normal);
    let (radius, full_length) = (path.radius * share, strand.full_length());
    if radius < SMALLEST_RADIUS {
        return NONE;
    }
    let threshold = |place: f64| path.threshold + place * path.threshold_rise;
    let distance = |place: f64| (across - place * path.half_segment).length();
    let margin = |place: f64| full_length * (1.0 - distance(place) / radius) - threshold(place);
    let best = maximum(&margin);
    let largest = margin(best);
    let place = if largest > 0.0 { first_inside(&margin, path.entry, best) } else { best };
    // Lengths of the profile as lengths across the strand, in root radii.
    let in_radii = share / full_length;
    let width = 2.0 * (full_length - threshold(best)) * in_radii;
    Hit { margin: (largest * in_radii).min(width - path.enough), place, random: strand.random }
}

/// Of two hits the first, or where neither is inside a strand the nearer; with the larger margin.
pub fn first(a: Hit, b: Hit, entry: f64) -> Hit {
    let is_b = match (a.margin > 0.0, b.margin > 0.0) {
        (true, true) => b.place * entry > a.place * entry,
        _ => b.margin > a.margin,
    };
    Hit { margin: a.margin.max(b.margin), ..if is_b { b } else { a } }
}

/// What the ray meets first, or comes closest to, and the largest margin of all strands, at most `enough`. The segment is
/// taken across the strands.
pub fn walk(path: &Path) -> Hit {
    let half_segment = path.half_segment - path.half_segment.dot(path.normal) * path.normal;
    let path = &Path { half_segment, ..*path };
    let strands = around(path.middle, half_segment.length() + 0.5).filter(|strand| is_near(path, strand));
    let hit = strands.fold(NONE, |hit, strand| first(hit, meet(path, &strand), path.entry));
    Hit { margin: hit.margin.min(path.enough), ..hit }
}

/// Whether a path comes within a cell of a strand that reaches the surface: what is farther away is missed by more than a strand's
/// thickness.
fn is_near(path: &Path, strand: &Strand) -> bool {
    let (across, share) = strand.offset(path.middle, path.normal);
    let squared = path.half_segment.length_squared();
    let along = if squared > 0.0 { (across.dot(path.half_segment) / squared).clamp(-1.0, 1.0) } else { 0.0 };
    share > 0.0 && (across - along * path.half_segment).length() < 1.0
}

/// Place in [-1, 1] of the maximum of a concave function.
fn maximum(value: &impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (-1.0f64, 1.0f64);
    for _ in 0..80 {
        let third = (high - low) / 3.0;
        if value(low + third) < value(high - third) { low += third } else { high -= third }
    }
    [-1.0, 1.0, 0.5 * (low + high)].into_iter().max_by(|a, b| value(*a).total_cmp(&value(*b))).unwrap_or(0.0)
}

/// Place nearest to `entry` where a concave function that is positive at `inside` is not negative.
fn first_inside(value: &impl Fn(f64) -> f64, entry: f64, inside: f64) -> f64 {
    if value(entry) >= 0.0 {
        return entry;
    }
    let (mut out, mut within) = (entry, inside);
    for _ in 0..60 {
        let middle = 0.5 * (out + within);
        if value(middle) >= 0.0 { within = middle } else { out = middle }
    }
    within
}

/// Mean over full lengths in [0.75, 1] of what a threshold >= 0 leaves of strands: of their radius, and of their
/// cross-section.
pub fn left(threshold: f64) -> [f64; 2] {
    let least = threshold.max(0.75);
    if least >= 1.0 {
        return [0.0; 2];
    }
    // Antiderivatives of 1 - t / f and of its square.
    let radius = |f: f64| f - threshold * f.ln();
    let section = |f: f64| f - 2.0 * threshold * f.ln() - threshold * threshold / f;
    [(radius(1.0) - radius(least)) / 0.25, (section(1.0) - section(least)) / 0.25]
}

/// Mean cross-section of strands a cell of surface. A strand whose point lies h off the surface has the radius 1 - h^2:
/// over [-1, 1] its square has the mean 8/15.
pub fn cross_section(threshold: f64, radius: f64) -> f64 {
    PI * radius * radius * 8.0 / 15.0 * left(threshold)[1]
}

/// The same of their widths seen from the side; 1 - h^2 has the mean 2/3.
pub fn width(threshold: f64, radius: f64) -> f64 {
    4.0 / 3.0 * radius * left(threshold)[0]
}

/// Mean opacity of a slab of strands placed by chance.
pub fn slab_opacity(cap: f64, width: f64, length_in_cells: f64) -> f64 {
    -(-(cap.max(0.0) + width * length_in_cells)).exp_m1()
}

/// How far strands are below the eye's resolution; `slope` is the change of the profile over a pixel.
pub fn unresolved(slope: f64) -> f64 {
    let x = ((slope - 0.75) / 1.25).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// Opacity at a margin, one pixel wide at the edge.
pub fn opacity(margin: f64, slope: f64, mean: f64) -> f64 {
    let edge = (margin / slope.max(1e-6) + 0.5).clamp(0.0, 1.0);
    edge + (mean - edge) * unresolved(slope)
}

/// Threshold of the profile at a height in the fur.
pub fn threshold(height: f64, cutoff_start: f64, cutoff_end: f64, paraboloid: bool) -> f64 {
    cutoff_start + (cutoff_end - cutoff_start) * if paraboloid { height * height } else { height }
}

/// Circular arc of a strand of length 1: sideways and along the root direction at `height`, for a turn of `angle`
/// radians from root to tip.
pub fn arc(height: f64, angle: f64) -> [f64; 2] {
    let turn = angle * height;
    if turn.abs() < 1e-9 {
        return [0.5 * angle * height * height, height];
    }
    // The half-angle form of 1 - cos, which would cancel.
    [2.0 * (0.5 * turn).sin().powi(2) / angle, turn.sin() / angle]
}

/// Turn from root to tip under a force of unit direction times strength.
pub fn bend_angle(root_direction: DVec3, force: DVec3) -> f64 {
    let along = root_direction.dot(force);
    let sideways = (force - along * root_direction).length();
    if sideways < 1e-6 {
        return 0.0;
    }
    (force.length() * sideways.atan2(along)).min(FRAC_PI_2 * sideways)
}

/// Optical depth of the fur above a height along the light.
pub fn optical_depth(height: f64, occlusion: f64, cosine_to_light: f64) -> f64 {
    let chord = 0.5 * (cosine_to_light + cosine_to_light.hypot(0.3));
    -(1.0 - occlusion).max(1e-3).ln() * (1.0 - height) / chord
}

/// A coordinate in cells.
pub(super) const PLACE: Domain = Domain::Uniform(-32.0, 32.0, &[-31.0, -0.5, 0.0, 0.5, 31.0]);
/// Over the spacing of strands.
const RADIUS: Domain = Domain::Uniform(0.02, 0.5, &[0.02, 0.5]);
/// A component of half a view ray's segment, in cells: what is walked at most.
const SEGMENT: Domain = Domain::Uniform(-1.7, 1.7, &[0.0, 1e-40, 1e-7, 1.7]);
/// Of a threshold, over half a slab.
const RISE: Domain = Domain::Uniform(-0.2, 0.2, &[0.0, 1e-40, 0.2]);
/// In the middle of a path: at both ends it is not negative.
const THRESHOLD: Domain = Domain::Uniform(0.2, 1.2, &[0.2, 0.5, 1.0, 9.0]);
const ENOUGH: Domain = Domain::Uniform(0.0, 1.0, &[1e-3, 0.25, 1.0]);
const MARGIN: Domain = Domain::Uniform(-1.0, 1.0, &[-1e3, -1e-40, 0.0, 1.0]);
const PLACE_ON_PATH: Domain = Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1.0]);
/// In the order of the shader's struct.
const PATH: &[Domain] = &[PLACE, THRESHOLD, SEGMENT, RISE, Domain::Direction, RADIUS, Domain::Sign, ENOUGH];
/// Cells around the place, so that strands are met.
const PATH_AND_CELL: &[Domain] = &[
    Domain::Uniform(0.0, 2.0, &[0.0, 0.5, 1.0]),
    THRESHOLD,
    SEGMENT,
    RISE,
    Domain::Direction,
    RADIUS,
    Domain::Sign,
    ENOUGH,
    Domain::Choice(&[0, 1]),
];
/// Offsets of up to 6 cells keep 2^-22, and root radii are 0.02 or more: 1.2e-5 for a margin; places, where the ray slants
/// into a strand's side, some times that.
const WALK: f64 = 1e-4;

fn path(inputs: &mut TestInputs) -> Path {
    Path {
        middle: inputs.vec3(),
        threshold: inputs.number(),
        half_segment: inputs.vec3(),
        threshold_rise: inputs.number(),
        normal: inputs.vec3(),
        radius: inputs.number(),
        entry: inputs.number(),
        enough: inputs.number(),
    }
}

fn hit(hit: Hit) -> Vec<f64> {
    vec![hit.margin, hit.place, hit.random]
}

/// Nothing reads where a strand is that the pixel hardly touches, nor which of those it is that hold the entry together.
fn met(result: &mut [f64]) {
    result[0] = result[0].max(-0.1);
    if result[0] < 0.02 {
        result[1] = 0.0;
    }
    if result[0] < 0.02 || result[1].abs() == 1.0 {
        result[2] = 0.0;
    }
}

/// A component of a force of at most unit strength.
const FORCE: Domain = Domain::Uniform(-0.57, 0.57, &[-0.57, 0.0, 1e-40, 1e-7, 0.57]);

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    // Radii are at least a thousandth of a cell, of which f32 keeps 2^-13 when offsets of a cell are rounded.
    Twin::new("strand_meet", PATH_AND_CELL, |inputs| {
        let path = path(inputs);
        let cell = DVec3::new(inputs.int().into(), inputs.int().into(), inputs.int().into());
        hit(meet(&path, &Strand::of_cell(cell)))
    })
    .limit(2e-5, WALK)
    .rule(Rule::Conditioned(4))
    .used(met),
    Twin::new("strand_first", &[MARGIN, PLACE_ON_PATH, UNIT, MARGIN, PLACE_ON_PATH, UNIT, Domain::Sign], |inputs| {
        let mut next = || Hit { margin: inputs.number(), place: inputs.number(), random: inputs.number() };
        let (a, b) = (next(), next());
        hit(first(a, b, inputs.number()))
    })
    .limit(0.0, 0.0),
    Twin::new("strand_walk", PATH, |inputs| hit(walk(&path(inputs))))
        .limit(2e-5, WALK)
        .rule(Rule::Stepped(4))
        .used(met),
    // Eight times log, which near 1 is off by up to 2^-21.
    Twin::new("strand_left", &[UNIT], |inputs| left(inputs.number()).to_vec()).limit(2e-5, 8.0 / 2_097_152.0),
    Twin::new("strand_cross_section", &[UNIT, RADIUS], |inputs| vec![cross_section(inputs.number(), inputs.number())]),
    Twin::new("strand_width", &[UNIT, RADIUS], |inputs| vec![width(inputs.number(), inputs.number())]),
    Twin::new(
        "strand_slab_opacity",
        &[
            Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-40, 1e-7, 1.0]),
            UNIT,
            Domain::Log(1e-3, 1e2, &[0.0, 1e-40, 1e-7, 1e30]),
        ],
        |inputs| vec![slab_opacity(inputs.number(), inputs.number(), inputs.number())],
    ),
    Twin::new("strand_threshold", &[UNIT, UNIT, UNIT, Domain::Choice(&[0, 1])], |inputs| {
        vec![threshold(inputs.number(), inputs.number(), inputs.number(), inputs.uint() == 1)]
    }),
    Twin::new("strand_unresolved", &[Domain::Log(1e-3, 1e2, &[0.0, 1e-40, 0.75, 2.0, 1e30])], |inputs| {
        vec![unresolved(inputs.number())]
    }),
    Twin::new(
        "strand_opacity",
        &[
            Domain::Uniform(-2.0, 1.0, &[-1e30, -1e3, 0.0, 0.5, 1.0]),
            Domain::Log(1e-4, 10.0, &[0.0, 1e-40, 1e-6, 0.75, 2.0, 1e30]),
            UNIT,
        ],
        |inputs| vec![opacity(inputs.number(), inputs.number(), inputs.number())],
    ),
    Twin::new(
        "strand_arc",
        &[
            UNIT,
            Domain::Uniform(
                0.0,
                std::f32::consts::FRAC_PI_2,
                &[0.0, 1e-40, 1e-8, 1e-3, 1.9999e-3, 2e-3, std::f32::consts::FRAC_PI_2],
            ),
        ],
        |inputs| arc(inputs.number(), inputs.number()).to_vec(),
    ),
    // Vulkan lets atan be off by 4096 units in the last place.
    Twin::new("strand_bend_angle", &[Domain::Direction, FORCE], |inputs| {
        vec![bend_angle(inputs.vec3(), inputs.vec3())]
    })
    .limit(4096.0 * ULP, 1e-6),
    // The chord's slant costs a digit below the horizon, in single precision as in the twin's inputs.
    Twin::new(
        "strand_optical_depth",
        &[UNIT, UNIT, Domain::Uniform(-1.0, 1.0, &[-1.0, 0.0, 1e-40, 1e-7, 0.05, 1.0])],
        |inputs| vec![optical_depth(inputs.number(), inputs.number(), inputs.number())],
    )
    .limit(2e-5, 1e-5),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arc_keeps_its_length_and_rises_steadily() {
        for angle in [0.0, 1e-8, 1e-3, 0.3, 1.0, FRAC_PI_2, 1.6, 2.5, PI] {
            let steps = 4000;
            let (mut length, mut before, mut rises) = (0.0, arc(0.0, angle), true);
            assert_eq!(before, [0.0, 0.0], "the root stays where it is");
            for step in 1..=steps {
                let now = arc(f64::from(step) / f64::from(steps), angle);
                rises &= now[1] >= before[1];
                length += (now[0] - before[0]).hypot(now[1] - before[1]);
                before = now;
            }
            assert_eq!(rises, angle <= FRAC_PI_2, "height at angle {angle}");
            assert!((length - 1.0).abs() < 1e-5, "length {length} at angle {angle}");
        }
    }

    #[test]
    fn a_force_bends_towards_itself_and_never_past() {
        let root = DVec3::Y;
        assert_eq!(bend_angle(root, DVec3::ZERO), 0.0);
        assert_eq!(bend_angle(root, -DVec3::Y), 0.0);
        assert_eq!(bend_angle(root, DVec3::Y), 0.0);
        assert!((bend_angle(root, DVec3::X) - FRAC_PI_2).abs() < 1e-12);
        for degrees in 1..180 {
            let (sine, cosine) = f64::from(degrees).to_radians().sin_cos();
            let angle = bend_angle(root, DVec3::new(sine, cosine, 0.0));
            assert!(angle <= f64::from(degrees).to_radians() + 1e-12 && angle <= FRAC_PI_2 + 1e-12);
        }
    }

    /// Two unit vectors across a normal.
    fn planes() -> [(DVec3, DVec3); 2] {
        [(DVec3::Z, DVec3::X), (DVec3::new(0.48, 0.6, 0.64), DVec3::new(0.8, 0.0, -0.6))]
    }

    /// Places spread over a plane; about 900 strands stand among them, which makes the noise of a mean 0.01.
    fn places(normal: DVec3, tangent: DVec3, side: u32) -> impl Iterator<Item = DVec3> {
        let (bitangent, step) = (normal.cross(tangent), 30.0 / f64::from(side));
        (0..side * side)
            .map(move |index| tangent * f64::from(index % side) * step + bitangent * f64::from(index / side) * step)
    }

    #[test]
    fn mean_opacity_is_that_of_the_strands() {
        for (normal, tangent) in planes() {
            for (threshold, half_length) in [(0.0, 0.0), (0.25, 0.0), (0.5, 0.0), (0.8, 0.0), (0.5, 0.5), (0.25, 1.0)] {
                let met = |middle| {
                    let half_segment = tangent * half_length;
                    let path = Path {
                        middle,
                        threshold,
                        half_segment,
                        threshold_rise: 0.0,
                        normal,
                        radius: 0.35,
                        entry: 1.0,
                        enough: 1e-3,
                    };
                    f64::from(u8::from(walk(&path).margin > 0.0))
                };
                let side = 60;
                let measured = places(normal, tangent, side).map(met).sum::<f64>() / f64::from(side * side);
                let (cap, width) = (cross_section(threshold, 0.35), width(threshold, 0.35));
                let expected = slab_opacity(cap, width, 2.0 * half_length);
                // Points stratified by cell overlap less than chance.
                assert!((measured - expected).abs() < 0.045, "{measured} for {expected} at {threshold}, {half_length}");
            }
        }
    }

    #[test]
    fn fur_of_means_does_not_depend_on_its_shells() {
        let (radius, length, tangent_of_view) = (0.35, 6.0, 1.7);
        let transmittance = |shells: u32| {
            (0..shells).fold(1.0, |left, shell| {
                let at = |boundary: u32| f64::from(boundary) / f64::from(shells);
                let above = if shell + 1 == shells { 0.0 } else { cross_section(at(shell + 1), radius) };
                let cap = cross_section(at(shell), radius) - above;
                let middle = width(0.5 * (at(shell) + at(shell + 1)), radius);
                left * (1.0 - slab_opacity(cap, middle, length * tangent_of_view / f64::from(shells)))
            })
        };
        let (few, many) = (transmittance(8), transmittance(64));
        assert!((few - many).abs() < 0.01 * (1.0 - many), "{few} {many}");
    }

    #[test]
    fn slabs_meet_what_a_fine_march_meets() {
        for (normal, tangent) in planes() {
            for (index, middle) in places(normal, tangent, 24).enumerate() {
                let entry = if index % 3 == 0 { -1.0 } else { 1.0 };
                let half_segment = (tangent * (index % 7) as f64 + normal.cross(tangent)) * 0.2;
                let path = Path {
                    middle,
                    threshold: 0.3,
                    half_segment,
                    threshold_rise: 0.15,
                    normal,
                    radius: 0.4,
                    entry,
                    enough: 1e-3,
                };
                let hit = walk(&path);
                let marched = (0..=2000)
                    .map(|step| entry * (1.0 - f64::from(step) / 1000.0))
                    .find(|place| field(middle + *place * half_segment, normal, 0.4).0 >= 0.3 + 0.15 * place);
                match marched {
                    Some(place) => assert!((hit.place - place).abs() < 1.1e-3, "{hit:?}, marched {place}"),
                    // The march may step over the edge of a strand.
                    None => assert!(hit.margin < 1e-3, "{hit:?}, marched through"),
                }
            }
        }
    }

    #[test]
    fn opacity_keeps_its_mean_at_every_distance() {
        for threshold in [0.025, 0.125, 0.4] {
            let mean = slab_opacity(cross_section(threshold, 0.35), 0.0, 0.0);
            for slope in [0.05, 0.1, 0.3, 0.6, 0.75, 1.0, 1.5, 2.0, 4.0] {
                let side = 200;
                let sum: f64 = places(DVec3::Z, DVec3::X, side)
                    .map(|place| opacity(field(place, DVec3::Z, 0.35).0 - threshold, slope, mean))
                    .sum();
                let found = sum / f64::from(side * side);
                // The edge is filtered where strands end in all directions, so a slope of one reaches half a radius out.
                assert!((found - mean).abs() < 0.06, "{found} for {mean} at threshold {threshold}, slope {slope}");
            }
        }
    }

    #[test]
    fn depth_falls_with_height_and_grows_with_slant() {
        assert_eq!(optical_depth(1.0, 0.9, 0.2), 0.0);
        assert_eq!(optical_depth(0.0, 0.0, -1.0), 0.0);
        let at = |cosine| optical_depth(0.0, 0.7, cosine);
        // The wider view past the horizon takes a fiftieth off.
        assert!((at(1.0) / -(0.3f64.ln()) - 1.0).abs() < 0.025);
        assert!((1..200).all(|step| at(f64::from(step) * 0.01 - 1.0) < at(f64::from(step) * 0.01 - 1.01)));
    }
}
