//! Flakes are told by their definition: every one of them with its own place and normal, and as many points at random.

use glam::{DVec2, DVec3, IVec2};
use std::f64::consts::PI;
use vair::material::{Flakes, Glint};
use vair::measure::twin::{ggx, glint};

/// Seeded numbers in [0, 1): SplitMix64 (Steele, Lea & Flood 2014, "Fast Splittable Pseudorandom Number Generators").
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn vec2(&mut self, half: f64) -> DVec2 {
        (2.0 * DVec2::new(self.unit(), self.unit()) - 1.0) * half
    }
}

/// Flakes of a coarse square: 8 x 8 normals, so that all of a tile can be listed.
fn coarse() -> Flakes {
    let flakes = Glint { coverage: 0.2, microfacet_roughness: 0.15, ..Glint::default() }.flakes();
    assert_eq!(flakes.fineness, 3);
    flakes
}

/// A pixel somewhere, that wide in edges of a rhombus and stretched that much.
fn pixel(flakes: &Flakes, random: &mut Random, width: f64, stretch: f64) -> glint::Footprint {
    let turn = DVec2::from_angle(random.unit() * PI);
    let place = random.vec2(1e4);
    glint::Footprint::new(flakes, place, turn * width * stretch.sqrt(), turn.perp() * width / stretch.sqrt())
}

#[test]
fn glint_prob_keeps_small_chances() {
    for (p, n) in [(0.5f64, 2), (0.999, 3), (1e-3, 1000), (0.01, 250), (0.3, 1), (1.0, 1)] {
        let none: f64 = (0..n).map(|_| 1.0 - p).product();
        assert!((glint::chance(p, f64::from(n)) - (1.0 - none)).abs() <= 1e-13, "{p} {n}");
    }
    // Where n p is small, its series, n p (1 - (n - 1) p / 2), has no need of the fourth term.
    for (p, n) in [(1e-12f64, 1e6), (1e-9, 10.0), (1e-8, 1.0), (1e-7, 100.0)] {
        let series = n * p * (1.0 - 0.5 * (n - 1.0) * p);
        assert!((glint::chance(p, n) / series - 1.0).abs() <= 1e-9, "{p} {n}");
    }
    assert_eq!((glint::chance(0.0, 1e7), glint::chance(0.5, 0.0), glint::chance(1.0, 5.0)), (0.0, 0.0, 1.0));
    // The defect that this is for: in single precision the formula as it is written loses all of a small chance.
    let naive = 1.0 - (1.0f32 - 1e-8).powf(1e6);
    assert_eq!(naive, 0.0, "of 0.00995");
}

#[test]
fn normals_fill_the_square_evenly() {
    let mut random = Random(1);
    for alpha in [1e-3, 0.09, 0.5, 1.0] {
        for _ in 0..200 {
            let at = random.vec2(0.99);
            let normal = glint::normal(at, alpha);
            assert!((glint::square(normal, alpha) - at).length() < 1e-9);
            // Solid angle that a little of the square stands for, by finite differences; none lies across a diagonal.
            let step = 1e-6;
            if (at.x.abs() - at.y.abs()).abs() < 2.0 * step || at.x.abs().min(at.y.abs()) < 2.0 * step {
                continue;
            }
            let along = |axis: DVec2| {
                (glint::normal(at + step * axis, alpha) - glint::normal(at - step * axis, alpha)) / (2.0 * step)
            };
            let solid_angle = along(DVec2::X).cross(along(DVec2::Y)).length();
            let share = ggx::ndf(normal, alpha, alpha) * normal.z * solid_angle;
            assert!((share * 4.0 - 1.0).abs() < 1e-5, "alpha {alpha} at {at}: {share} for 1/4");
        }
    }
    assert_eq!(glint::square(DVec3::Z, 0.1), DVec2::ZERO);
    assert_eq!(glint::square(DVec3::ZERO, 0.1), DVec2::ZERO, "opposed directions have no half vector");
}

#[test]
fn a_shuffle_leaves_none_out() {
    for fineness in 2..=8 {
        for key in [0, 1, 0xffff_ffff, 0x1234_5678, 0x9e37_79b9] {
            let mut seen = vec![false; 1 << (2 * fineness)];
            for number in 0..1u32 << (2 * fineness) {
                let shuffled = glint::shuffle(number, fineness, key);
                seen[shuffled as usize] = true;
                assert_eq!(glint::unshuffle(shuffled, fineness, key), number);
            }
            assert!(seen.iter().all(|seen| *seen), "fineness {fineness}, key {key}");
        }
    }
}

/// All flakes of the tiles around, each with its own normal: what the constant-time search must find.
fn listed(flakes: &Flakes, footprint: &glint::Footprint, chart: u32, square: DVec2, lobe: f64) -> DVec3 {
    let side = 1 << flakes.fineness;
    let middle = IVec2::new(footprint.cell.x.div_euclid(side), footprint.cell.y.div_euclid(side));
    let mut sum = DVec3::ZERO;
    for tile in (0..9).map(|index| middle + IVec2::new(index % 3 - 1, index / 3 - 1)) {
        let seed = glint::seed(tile, chart * 16);
        for number in 0..(side * side) as u32 {
            let normal = IVec2::new(number as i32 % side, number as i32 / side).as_dvec2();
            let place = glint::shuffle(number, flakes.fineness, seed[1]) as i32;
            let (tint, weight) =
                glint::flake(flakes, footprint, tile * side + IVec2::new(place % side, place / side), 0, chart * 16);
            // Its normal, in cells of the square, and the way from there to the half vector around the square's rim.
            let wide = f64::from(side);
            let way = (0.5 * square + glint::shift(seed)) * wide - (normal + 0.5);
            let way = way - wide * (way / wide).round();
            sum += tint * weight * f64::from(side * side) * glint::lobe_profile(way.length_squared() / (lobe * lobe))
                / (PI * lobe * lobe);
        }
    }
    sum
}

#[test]
fn the_flakes_that_flash_are_those_that_are_there() {
    let flakes = coarse();
    let mut random = Random(2);
    let mut lit = 0;
    for index in 0..2000 {
        let footprint = pixel(&flakes, &mut random, [0.05, 0.5, 1.0][index % 3], [1.0, 4.0][index % 2]);
        let (square, lobe) = (random.vec2(1.0), f64::from(flakes.lobe));
        let tiles = glint::Tiles::new(footprint.cell, flakes.fineness, 0, 1);
        let found = glint::level(&flakes, &footprint, &tiles, square, lobe);
        let all = listed(&flakes, &footprint, 1, square, lobe);
        assert!((found - all).abs().max_element() <= 1e-9 * all.max_element().max(1.0), "{found} {all}");
        if glint::apart(&footprint) == 1.0 {
            let discs = glint::discs(&flakes, &footprint, 1);
            let by_place = glint::discs_flash(&flakes, &discs, square, lobe);
            assert!((by_place - all).abs().max_element() <= 1e-9 * all.max_element().max(1.0), "{by_place} {all}");
        }
        lit += u32::from(all.max_element() > 0.0);
    }
    assert!(lit > 20, "{lit} of 2000 pixels see a flash");
}

/// Pixels of one kind: values of the factor on the smooth lobe.
fn values(flakes: &Flakes, width: f64, stretch: f64, spread: f64, count: usize) -> Vec<f64> {
    let mut random = Random(3);
    let one = |_| {
        let footprint = pixel(flakes, &mut random, width, stretch);
        glint::flash(flakes, &footprint, 2, random.vec2(1.0), spread).y
    };
    (0..count).map(one).collect()
}

/// The same of flakes that lie and lean wholly at random: points of a Poisson process on cloth times square.
fn at_random(flakes: &Flakes, width: f64, stretch: f64, spread: f64, count: usize) -> Vec<f64> {
    let mut random = Random(4);
    let cells = f64::from(1u32 << flakes.fineness);
    let lobe = glint::lobe(flakes, spread);
    let one = |_| {
        let footprint = pixel(flakes, &mut random, width, stretch);
        // Only those within the lobe and the kernel's bounding square count; one rhombus holds one flake.
        let reach = footprint.reach;
        let mean = (2.0 * reach).powi(2) * (PI * lobe * lobe) / (cells * cells);
        let (mut left, mut number) = ((-mean).exp(), 0);
        let mut draw = random.unit();
        while draw > left && number < 10_000 {
            draw -= left;
            number += 1;
            left *= mean / f64::from(number);
        }
        let flake = |_| {
            let weight = footprint.weight(random.vec2(reach));
            let shade = f64::from(flakes.variation) * random.unit();
            let u = random.unit();
            (1.0 - shade) * weight * cells * cells * glint::lobe_profile(u) / (PI * lobe * lobe)
        };
        (0..number).map(flake).sum()
    };
    (0..count).map(one).collect()
}

fn mean_and_variance(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    (mean, values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (count - 1.0))
}

/// Largest difference between the shares of two lists that lie below a value (Kolmogorov & Smirnov).
fn kolmogorov_smirnov(a: &[f64], b: &[f64]) -> f64 {
    let sorted = |values: &[f64]| {
        let mut values = values.to_vec();
        values.sort_by(f64::total_cmp);
        values
    };
    let (a, b) = (sorted(a), sorted(b));
    let below = |list: &[f64], value: f64| list.partition_point(|other| *other <= value) as f64 / list.len() as f64;
    a.iter().chain(&b).map(|value| (below(&a, *value) - below(&b, *value)).abs()).fold(0.0, f64::max)
}

/// Sums of squared changes of the half vector's place in the square, from a flat cloth's to that of a sharp fold.
const SPREADS: [f64; 3] = [0.0, 0.1, 0.5];

#[test]
fn glint_mean_is_the_smooth_lobe_at_every_zoom() {
    let flakes = coarse();
    let mean = glint::mean_tint(&flakes);
    for (stretch, spread) in SPREADS.iter().flat_map(|spread| [(1.0, *spread), (8.0, *spread)]) {
        for zoom in 0..30 {
            let width = 0.05 * 1.5f64.powi(zoom);
            let (found, variance) = mean_and_variance(&values(&flakes, width, stretch, spread, 20_000));
            let error = (variance / 20_000.0).sqrt();
            let is_near = (found - mean).abs() <= 3.0 * error + 1e-9;
            assert!(is_near, "width {width}, spread {spread}: {found} for {mean} +- {error}");
        }
    }
    let (_, far) = mean_and_variance(&values(&flakes, 1e4, 1.0, 0.0, 1000));
    assert!(far < 1e-12, "thousands of flakes in a pixel are a smooth lobe: variance {far}");
}

#[test]
fn flakes_flash_as_flakes_at_random_do() {
    let flakes = coarse();
    let count = 40_000;
    for (stretch, spread) in SPREADS.iter().flat_map(|spread| [(1.0, *spread), (6.0, *spread)]) {
        for zoom in 0..12 {
            let width = 0.1 * 1.7f64.powi(zoom);
            // Hundreds of flashes in a pixel, whose every value is nearly the mean, are for the test of the mean.
            if width * width * (1.0 + 100.0 * spread) > 400.0 {
                break;
            }
            let ours = values(&flakes, width, stretch, spread, count);
            let truth = at_random(&flakes, width, stretch, spread, count);
            let ((_, a), (_, b)) = (mean_and_variance(&ours), mean_and_variance(&truth));
            let distance = kolmogorov_smirnov(&ours, &truth);
            let case = format!("stretch {stretch}, spread {spread}, width {width:.3}");
            println!("{case}: variance {a:.4} of {b:.4}, distance {distance:.4}");
            // A pixel with less than a hundred flashes among all samples errs by a tenth, and levels blend at 0.8 or more.
            assert!((0.65..1.4).contains(&(a / b)), "{case}: variance {a} for {b}");
            // Where flakes are single, all of the distribution is that of flakes at random: beyond 1.63 sqrt(2 / count) one
            // of a hundred pairs of equal lists is. Larger tiles keep mean and variance alone.
            let (_, near, _) = glint::levels(pixel(&flakes, &mut Random(5), width, stretch).reach, flakes.fineness);
            let limit = 1.63 * (2.0 / count as f64).sqrt();
            assert!(spread > 0.0 || near < 1.0 || distance <= limit, "{case}: {distance} of {limit}");
        }
    }
}

/// Root mean square change from frame to frame where a camera pans by an eighth of a pixel, over the mean.
fn flicker(value: impl Fn(&glint::Footprint) -> f64, flakes: &Flakes, width: f64) -> f64 {
    let mut random = Random(6);
    let (mut sum, pixels, frames) = (0.0, 500, 16);
    for _ in 0..pixels {
        let from = random.vec2(1e4);
        let frame = |index: i32| {
            let place = from + DVec2::X * (f64::from(index) * width / 8.0);
            value(&glint::Footprint::new(flakes, place, DVec2::X * width, DVec2::Y * width))
        };
        sum += (0..frames).map(|index| (frame(index + 1) - frame(index)).powi(2)).sum::<f64>();
    }
    (sum / f64::from(pixels * frames)).sqrt() / glint::mean_tint(flakes)
}

#[test]
fn flakes_beyond_number_do_not_flicker() {
    let flakes = coarse();
    let square = DVec2::new(0.2, -0.3);
    let lobe = f64::from(flakes.lobe);
    for width in [8.0, 32.0, 128.0] {
        let ours = flicker(|footprint| glint::flash(&flakes, footprint, 0, square, 0.0).y, &flakes, width);
        // Without levels: the flakes at the pixel's middle, as many as a tile's width lets the search see.
        let without = |footprint: &glint::Footprint| {
            let narrow = glint::Footprint::new(&flakes, footprint.cell.as_dvec2(), DVec2::X, DVec2::Y);
            let tiles = glint::Tiles::new(narrow.cell, flakes.fineness, 0, 0);
            glint::level(&flakes, &narrow, &tiles, square, lobe).y
        };
        let without = flicker(without, &flakes, width);
        println!("pixels of {width} rhombi: flicker {ours:.4}, without levels {without:.4}");
        assert!(ours <= without * 0.5 / (width / 8.0).sqrt(), "width {width}: {ours} {without}");
    }
}

#[cfg(feature = "measure")]
#[test]
fn glint_hash_gives_the_same_bits_on_the_device() {
    use vair::measure::twin::{Limit, twins};
    use vair::measure::verify::run_with;
    let gpu = vair::gpu::Gpu::new(&vair::gpu::GpuOptions::default()).unwrap_or_else(|error| panic!("{error}"));
    for name in ["hash_pcg3d", "glint_seed", "glint_shuffle", "glint_unshuffle", "glint_tiles"] {
        let twin = twins().find(|twin| twin.name == name).unwrap();
        assert_eq!(twin.limit, Limit::EXACT, "{name}");
        let report = run_with(&gpu, Some(name), 1 << 16).unwrap();
        assert!(report.pass() && report.functions[0].max_abs == 0.0, "{name}: {report:?}");
    }
}
