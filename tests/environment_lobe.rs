//! How far the split of a lobe, its albedo times one prefiltered look-up or a few, is from the lobe itself under a lamp of
//! about ten degrees, whose place is averaged over the sphere: relative RMS error, over roughness, widths and views.

use glam::{DVec2, DVec3};
use std::sync::LazyLock;
use vair::material::{Sheen, SheenTable};
use vair::measure::twin::environment::{self, LobeEntry};
use vair::measure::twin::sheen::Lobe;
use vair::measure::twin::{environment_lobe, ggx};

/// Sharpness of the lamp, a von Mises-Fisher lobe: its radiance is half at 10.7 degrees from the middle.
const SHARPNESS: f64 = 40.0;
/// Places of the lamp.
const LAMPS: usize = 150;
/// Nodes of roughness, and of the sine of half the angle to the lamp, of what the prefiltered cube holds.
const NODES: (usize, usize) = (32, 96);

fn lamp(cosine: f64) -> f64 {
    (SHARPNESS * (cosine - 1.0)).exp()
}

fn lamps() -> impl Iterator<Item = DVec3> {
    (0..LAMPS).map(|index| {
        let z = 1.0 - (2 * index + 1) as f64 / LAMPS as f64;
        // The golden angle.
        let (y, x) = (2.399_963 * index as f64).sin_cos();
        DVec3::new((1.0 - z * z).sqrt() * x, (1.0 - z * z).sqrt() * y, z)
    })
}

/// Radiance of the prefiltered lamp, by roughness and angle.
static PREFILTERED: LazyLock<Vec<Vec<f64>>> = LazyLock::new(|| {
    let node = |row: usize, column: usize| {
        let alpha = ggx::alpha_of_roughness(row as f64 / NODES.0 as f64);
        let cosine = 1.0 - 2.0 * (column as f64 / NODES.1 as f64).powi(2);
        let to_lamp = DVec3::new((1.0 - cosine * cosine).max(0.0).sqrt(), 0.0, cosine);
        environment::prefiltered(DVec3::Z, alpha, |l| DVec3::splat(lamp(l.dot(to_lamp)))).x
    };
    (0..=NODES.0).map(|row| (0..=NODES.1).map(|column| node(row, column)).collect()).collect()
});

fn prefiltered(roughness: f64, cosine: f64) -> f64 {
    let row = roughness.clamp(0.0, 1.0) * NODES.0 as f64;
    let column = (0.5 * (1.0 - cosine)).clamp(0.0, 1.0).sqrt() * NODES.1 as f64;
    let (i, j) = ((row as usize).min(NODES.0 - 1), (column as usize).min(NODES.1 - 1));
    let along = |i: usize| {
        let nodes = &PREFILTERED[i];
        nodes[j] + (nodes[j + 1] - nodes[j]) * (column - j as f64)
    };
    along(i) + (along(i + 1) - along(i)) * (row - i as f64)
}

/// A look-up: direction, roughness, weight.
type LookUp = (DVec3, f64, f64);

/// Error of look-ups against samples of the lobe (direction, weight), relative to the lobe's own light.
fn error(lobe: &[(DVec3, f64)], look_ups: &[LookUp]) -> f64 {
    let whole: f64 = lobe.iter().map(|(_, weight)| weight).sum();
    let (mut off, mut all) = (0.0, 0.0);
    for to_lamp in lamps() {
        let truth = lobe.iter().map(|(l, weight)| weight * lamp(l.dot(to_lamp))).sum::<f64>() / whole;
        let found: f64 =
            look_ups.iter().map(|(axis, rough, weight)| weight * prefiltered(*rough, axis.dot(to_lamp))).sum();
        off += (found - truth).powi(2);
        all += truth * truth;
    }
    (off / all).sqrt()
}

fn direction(cosine: f64, turn: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    DVec3::new(sine * turn.cos(), sine * turn.sin(), cosine)
}

/// Samples of a GGX lobe of those widths with F = 1, by its visible normals.
fn ggx_lobe(v: DVec3, (ax, ay): (f64, f64)) -> Vec<(DVec3, f64)> {
    const SIDE: usize = 48;
    let pole = DVec3::new(ax * v.x, ay * v.y, v.z).normalize();
    let sample = |index: usize| {
        let u = (DVec2::new((index % SIDE) as f64, (index / SIDE) as f64) + 0.5) / SIDE as f64;
        let z = u.y * (1.0 + pole.z) - pole.z;
        let cap = (DVec2::from_angle(std::f64::consts::TAU * u.x) * (1.0 - z * z).sqrt()).extend(z) + pole;
        let h = DVec3::new(ax * cap.x, ay * cap.y, cap.z).normalize();
        let l = 2.0 * v.dot(h) * h - v;
        (l, if l.z > 0.0 { ggx::masking_shadowing_times_cosine(v, l, ax, ay) } else { 0.0 })
    };
    (0..SIDE * SIDE).map(sample).collect()
}

/// Samples of a lobe of fuzz.
fn fuzz_lobe(lobe: &Lobe<'_>, v: DVec3) -> Vec<(DVec3, f64)> {
    const SIDE: usize = 64;
    let at = |index: usize| {
        let turn = ((index / SIDE) as f64 + 0.5) / SIDE as f64 * std::f64::consts::TAU;
        direction(((index % SIDE) as f64 + 0.5) / SIDE as f64, turn)
    };
    (0..SIDE * SIDE).map(at).map(|l| (l, lobe.times_cosine(v, l))).collect()
}

/// Where and how rough a lobe is read by its entry.
fn by_entry(v: DVec3, entry: LobeEntry) -> Vec<LookUp> {
    vec![(environment::lobe_axis(v, entry.mirror), entry.roughness, 1.0)]
}

/// Mean and largest of errors.
fn summary(errors: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let errors: Vec<f64> = errors.into_iter().collect();
    (errors.iter().sum::<f64>() / errors.len() as f64, errors.iter().copied().fold(0.0, f64::max))
}

const ROUGHNESS: [f64; 9] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.0];

#[test]
fn round_lobes() {
    let views =
        || ROUGHNESS.into_iter().flat_map(|rough| [0.1, 0.3, 0.6, 0.8, 0.99].map(|mu| (rough, direction(mu, 0.0))));
    let lobe = |roughness, v| ggx_lobe(v, (ggx::alpha_of_roughness(roughness), ggx::alpha_of_roughness(roughness)));
    let ours =
        summary(views().map(|(rough, v)| error(&lobe(rough, v), &by_entry(v, environment::ggx_entry(v.z, rough)))));
    let mirror = DVec3::new(-1.0, -1.0, 1.0);
    let plain = summary(views().map(|(rough, v)| error(&lobe(rough, v), &[(mirror * v, rough, 1.0)])));
    println!("round: ours {ours:.3?}, mirror direction and own roughness {plain:.3?}");
    assert!(ours.0 <= 0.14 && ours.1 <= 0.40, "{ours:?}");
    assert!(plain.0 > 2.0 * ours.0, "{plain:?}");
}

#[test]
fn anisotropic_lobes() {
    let widths = [(0.3, 0.03), (0.5, 0.1), (0.9, 0.2), (0.2, 0.1), (0.8, 0.01), (0.1, 0.02), (1.0, 0.36)];
    let views = || {
        let both = widths.into_iter().flat_map(|(ax, ay)| [(ax, ay), (ay, ax)]);
        let views = |alpha| [0.15, 0.4, 0.7, 0.98].map(|mu| (alpha, mu));
        both.flat_map(views)
            .flat_map(|(alpha, mu)| [0.0f64, 30.0, 60.0, 90.0].map(|turn| (alpha, direction(mu, turn.to_radians()))))
    };
    let ours = |count: u32| {
        let taps = |v: DVec3, alpha| {
            let roughness = environment_lobe::roughness(alpha, count);
            let entry = environment::ggx_entry(v.z, roughness);
            let taps = environment_lobe::taps(v, alpha, count, entry.mirror);
            taps.into_iter().map(|tap| (tap.direction, entry.roughness, tap.weight)).collect::<Vec<_>>()
        };
        summary(views().map(|(alpha, v)| error(&ggx_lobe(v, alpha), &taps(v, alpha))))
    };
    let mean_width = |(ax, ay): (f64, f64)| (ax * ay).sqrt().sqrt();
    let plain = summary(
        views().map(|(alpha, v)| error(&ggx_lobe(v, alpha), &[(DVec3::new(-v.x, -v.y, v.z), mean_width(alpha), 1.0)])),
    );
    let [one, five, nine, thirteen] = [1, 5, 9, 13].map(ours);
    println!(
        "anisotropic: one look-up of the mean width {plain:.3?}, taps 1 {one:.3?} 5 {five:.3?} 9 {nine:.3?} 13 {thirteen:.3?}"
    );
    assert!(nine.0 <= 0.18 && nine.1 <= 0.45, "{nine:?}");
    assert!(thirteen.0 < nine.0 && nine.0 < five.0 && five.0 < one.0 && 3.0 * nine.0 < plain.0);
}

#[test]
fn fuzz() {
    let table = SheenTable::shipped();
    for sheet in [Sheen::Volume, Sheen::Charlie, Sheen::Inverted] {
        let views = || {
            [0.3, 0.6, 1.0].into_iter().flat_map(|rough| [0.1, 0.3, 0.6, 0.99].map(|mu| (rough, direction(mu, 0.0))))
        };
        let lobe = |roughness| Lobe { table: &table, sheet, roughness };
        let of = |(rough, v): (f64, DVec3)| {
            error(&fuzz_lobe(&lobe(rough), v), &by_entry(v, environment::sheen_entry(&lobe(rough), v.z)))
        };
        let ours = summary(views().map(of));
        let plain = summary(
            views().map(|(rough, v)| error(&fuzz_lobe(&lobe(rough), v), &[(DVec3::new(-v.x, -v.y, v.z), rough, 1.0)])),
        );
        println!("{sheet:?}: ours {ours:.3?}, mirror direction and own roughness {plain:.3?}");
        assert!(ours.0 <= 0.5 && ours.0 < plain.0, "{ours:?} {plain:?}");
    }
}
