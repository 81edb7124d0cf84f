//! What the device makes of environments, against quadrature in double precision.

use glam::{DVec3, Vec3, Vec4};
use half::f16;
use vair::asset::Environment;
use vair::gpu::{Gpu, GpuOptions};
use vair::material::{Sheen, SheenTable};
use vair::measure::twin::environment::{self as twin, LobeEntry};
use vair::measure::twin::sheen::Lobe;
use vair::render::{EnvironmentQuality, PreparedEnvironment, prepare_environment, prepare_lobes};

fn gpu() -> Gpu {
    Gpu::new(&GpuOptions { validate: true, ..GpuOptions::default() }).unwrap()
}

/// An environment of a formula, by the directions of its texels.
fn painted(size: [u32; 2], radiance: impl Fn(DVec3) -> f64) -> Environment {
    let texel = |index: u32| {
        let (x, y) = (f64::from(index % size[0]) + 0.5, f64::from(index / size[0]) + 0.5);
        let azimuth = (x / f64::from(size[0]) - 0.5) * std::f64::consts::TAU;
        let polar = y / f64::from(size[1]) * std::f64::consts::PI;
        let direction = DVec3::new(polar.sin() * azimuth.cos(), polar.cos(), polar.sin() * azimuth.sin());
        [radiance(direction) as f32; 3]
    };
    Environment { name: "painted".to_owned(), size, texels: (0..size[0] * size[1]).map(texel).collect() }
}

/// Direction and radiance of every texel of a level.
fn texels(prepared: &PreparedEnvironment, level: u32) -> Vec<(DVec3, Vec3)> {
    let side = prepared.face_px >> level;
    let half = |bytes: &[u8]| f16::from_le_bytes([bytes[0], bytes[1]]).to_f32();
    let texel = |(index, bytes): (usize, &[u8])| {
        let index = index as u32;
        let (face, x, y) = (index / (side * side), index % side, index / side % side);
        let place = glam::DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5) * 2.0 / f64::from(side) - 1.0;
        let radiance = Vec3::new(half(bytes), half(&bytes[2..]), half(&bytes[4..])) * prepared.scale;
        (twin::face_direction(face as usize, place), radiance)
    };
    prepared.levels[level as usize].chunks_exact(8).enumerate().map(texel).collect()
}

fn alpha_of(prepared: &PreparedEnvironment, level: u32) -> f64 {
    f64::from((1u32 << level) - 1) / f64::from((1u32 << prepared.last_level()) - 1)
}

#[test]
fn a_constant_environment_is_exact() {
    let gpu = gpu();
    for radiance in [Vec3::new(0.2, 1.0, 3.5), Vec3::ZERO, Vec3::new(1e8, 1e-30, 0.0)] {
        let environment = Environment::constant(radiance);
        let prepared = prepare_environment(&gpu, &environment, &EnvironmentQuality::default()).unwrap();
        assert_eq!(prepared.last_level(), 0);
        for (_, texel) in texels(&prepared, 0) {
            let off = (texel - radiance).abs();
            assert!(off.cmple(radiance * 4e-7).all(), "{texel} for {radiance}");
        }
        for (index, coefficient) in prepared.harmonics.iter().enumerate() {
            let expected = if index == 0 { radiance * (4.0 * std::f32::consts::PI).sqrt() } else { Vec3::ZERO };
            let off = (coefficient - expected).abs();
            println!("{index}: {}", off / radiance);
            assert!(off.cmple(radiance * 4e-6).all(), "{index}: {coefficient} for {expected}");
        }
    }
    assert_eq!(gpu.validation_messages(), [""; 0]);
}

#[test]
fn a_gradient_is_blurred_as_quadrature_says() {
    let gpu = gpu();
    // Harmonics of bands 1 and 3: smooth, and nothing of it is symmetric about an axis of the cube.
    let sky = |d: DVec3| 1.0 + 0.6 * d.y + 0.5 * d.x * d.y * d.z + 0.2 * d.z;
    let environment = painted([256, 128], sky);
    let prepared = prepare_environment(&gpu, &environment, &EnvironmentQuality::default()).unwrap();
    assert_eq!((prepared.face_px, prepared.last_level()), (64, 4));
    for level in 0..=prepared.last_level() {
        let alpha = alpha_of(&prepared, level);
        let (mut squares, mut count, mut worst) = (0.0, 0.0, 0.0f64);
        for (direction, found) in texels(&prepared, level).iter().step_by(37) {
            let expected = if level == 0 {
                sky(*direction)
            } else {
                twin::prefiltered(*direction, alpha, |d| DVec3::splat(sky(d))).x
            };
            let off = (f64::from(found.x) - expected).abs();
            squares += off * off;
            count += 1.0;
            worst = worst.max(off);
        }
        println!("level {level}: {} mean square root, {worst} at most", (squares / count).sqrt());
        // Measured .0035: beside a corner of the cube a sample's four texels are those of three faces.
        assert!((squares / count).sqrt() < 0.006 && worst < 0.025, "level {level}: {squares} / {count}, {worst}");
    }
    let expected = |index: usize| {
        let (band, order) = twin::band_and_order(index);
        // Projected by the finest rule that costs nothing: the formula's own terms.
        const SIDE: usize = 200;
        (0..SIDE * SIDE)
            .map(|i| {
                let z = ((i % SIDE) as f64 + 0.5) / SIDE as f64 * 2.0 - 1.0;
                let (y, x) = (((i / SIDE) as f64 + 0.5) / SIDE as f64 * std::f64::consts::TAU).sin_cos();
                let direction = DVec3::new((1.0 - z * z).sqrt() * x, (1.0 - z * z).sqrt() * y, z);
                sky(direction) * twin::harmonic(band, order, direction) * 4.0 * std::f64::consts::PI
            })
            .sum::<f64>()
            / (SIDE * SIDE) as f64
    };
    for (index, found) in prepared.harmonics.iter().enumerate() {
        let off = (f64::from(found.x) - expected(index)).abs();
        assert!(off < 1e-3, "{index}: {} for {}", found.x, expected(index));
    }
    assert_eq!(gpu.validation_messages(), [""; 0]);
}

#[test]
fn a_hot_texel_keeps_its_energy_and_throws_no_sparks() {
    let gpu = gpu();
    for row in [0, 3, 60, 64] {
        let mut environment = painted([256, 128], |_| 0.0);
        environment.texels[row * 256 + 31] = [222_208.0; 3];
        let angle = |row: usize| (row as f64 / 128.0 * std::f64::consts::PI).cos();
        let true_energy = 222_208.0 * (angle(row) - angle(row + 1)) * std::f64::consts::TAU / 256.0;
        let prepared = prepare_environment(&gpu, &environment, &EnvironmentQuality::default()).unwrap();
        let mean = f64::from(prepared.harmonics[0].x) * (4.0 * std::f64::consts::PI).sqrt();
        println!("row {row}: {}", mean / true_energy);
        // Between rows the picture is linear, which gives a row at the pole 8 % more sphere than it has; the rest is the
        // grid of directions.
        assert!(
            (mean / true_energy - 1.0).abs() < if row == 0 { 0.2 } else { 0.05 },
            "row {row}: {mean} for {true_energy}"
        );
        let energy = mean;
        let polar = (row as f64 + 0.5) / 128.0 * std::f64::consts::PI;
        let azimuth = (31.5 / 256.0 - 0.5) * std::f64::consts::TAU;
        let sun = DVec3::new(polar.sin() * azimuth.cos(), polar.cos(), polar.sin() * azimuth.sin());
        for level in 2..=prepared.last_level() {
            let alpha = alpha_of(&prepared, level);
            let norm = norm(alpha);
            let peak = energy * twin::front_lobe(1.0, alpha) / norm;
            let (mut spark, mut dip) = (0.0f64, 0.0f64);
            for (direction, found) in texels(&prepared, level) {
                // The light of one point is the lobe itself about it.
                let expected = energy * twin::front_lobe(direction.dot(sun), alpha) / norm;
                spark = spark.max((f64::from(found.x) - expected) / peak);
                dip = dip.max((expected - f64::from(found.x)) / peak);
            }
            println!("row {row} level {level}: {spark} of the peak above the lobe, {dip} below");
            // The texels that samples look into spread the point, which lowers the lobe's top; nothing may stand out of it.
            assert!(spark < 0.5, "row {row} level {level}: {spark} of the peak");
            assert!(dip < 0.35, "row {row} level {level}: {dip} of the peak");
        }
    }
    assert_eq!(gpu.validation_messages(), [""; 0]);
}

/// Integral of the front-seen lobe over the sphere.
fn norm(alpha: f64) -> f64 {
    const COUNT: usize = 20_000;
    let ring = |i: usize| {
        // Evenly in the square root of 1 - cosine, which is fine near the axis.
        let x = (i as f64 + 0.5) / COUNT as f64;
        twin::front_lobe(1.0 - x * x, alpha) * 2.0 * x
    };
    (0..COUNT).map(ring).sum::<f64>() * std::f64::consts::TAU / COUNT as f64
}

#[test]
fn the_table_of_lobes_is_what_quadrature_says() {
    let gpu = gpu();
    let quality = EnvironmentQuality::default();
    let bytes = prepare_lobes(&gpu, &quality).unwrap();
    let nodes = quality.table_px as usize;
    let half = |at: usize| f64::from(f16::from_le_bytes([bytes[at], bytes[at + 1]]).to_f32());
    let entry = |sheet: usize, column: usize, row: usize| {
        let at = ((sheet * nodes + row) * nodes + column) * 8;
        Vec4::from_array(std::array::from_fn(|i| half(at + 2 * i) as f32))
    };
    let table = SheenTable::shipped();
    for sheet in 0..twin::SHEETS {
        for row in [1, 6, 16, 25, 31].into_iter().skip(usize::from(sheet > 0)) {
            for column in [4, 12, 20, 28] {
                let (mu, roughness) = ((column as f64 / 31.0).powi(2), row as f64 / 31.0);
                let expected = match sheet {
                    0 => twin::ggx_entry(mu, roughness),
                    model => {
                        let sheet = Sheen::ALL[model - 1];
                        twin::sheen_entry(&Lobe { table: &table, sheet, roughness }, mu)
                    }
                };
                let found = entry(sheet, column, row);
                let LobeEntry { mirror, roughness: matched, albedo, fresnel } = expected;
                println!(
                    "{sheet} r {roughness:.3} mu {mu:.3}: {found:.4} {mirror:.4} {matched:.4} {albedo:.4} {fresnel:.4}"
                );
                let expected_texel = glam::DVec4::new(mirror, matched, albedo, fresnel).as_vec4();
                let off = (found - expected_texel).abs() / expected_texel.abs().max(Vec4::ONE);
                // Half floats, 2048 samples, and in single precision 1 - a length near 1 for the narrowest lobes.
                assert!(
                    off.max_element() < 0.02,
                    "sheet {sheet} roughness {roughness} mu {mu}: {found} for {expected:?}"
                );
            }
        }
    }
    // A mirror stays one, and seen from the front a lobe is itself.
    for column in 0..nodes {
        assert_eq!([entry(0, column, 0).x, entry(0, column, 0).y], [1.0, 0.0]);
    }
    for row in 2..nodes {
        let off = entry(0, nodes - 1, row).y - row as f32 / (nodes - 1) as f32;
        assert!(off.abs() < 0.012, "{row}: {off}");
    }
    assert!(bytes.chunks_exact(2).all(|two| f16::from_le_bytes([two[0], two[1]]).is_finite()));
    assert_eq!(gpu.validation_messages(), [""; 0]);
}

#[test]
fn what_is_kept_is_what_was_made() {
    let folder = tempfile::tempdir().unwrap();
    let options = GpuOptions { pipeline_cache_dir: Some(folder.path().to_owned()), ..GpuOptions::default() };
    let gpu = Gpu::new(&options).unwrap();
    let environment = painted([64, 32], |d| 1.0 + d.y);
    let quality = EnvironmentQuality { samples: 4, ..EnvironmentQuality::default() };
    let make = || prepare_environment(&gpu, &environment, &quality).unwrap();
    let made = make();
    let files = || -> Vec<_> {
        std::fs::read_dir(folder.path().join("environments")).unwrap().map(|file| file.unwrap().path()).collect()
    };
    let [file] = &files()[..] else { panic!("{:?}", files()) };
    let bytes = std::fs::read(file).unwrap();
    assert_eq!(make(), made);
    // One flipped bit, and half a file: made anew and put right.
    for damaged in [[&bytes[..99], &[bytes[99] ^ 1], &bytes[100..]].concat(), bytes[..bytes.len() / 2].to_vec(), vec![]]
    {
        std::fs::write(file, &damaged).unwrap();
        assert_eq!(make(), made);
        assert_eq!(std::fs::read(file).unwrap(), bytes);
    }
    // Other content, other settings: other files.
    prepare_environment(&gpu, &painted([64, 32], |d| 1.0 - d.y), &quality).unwrap();
    prepare_environment(&gpu, &environment, &EnvironmentQuality { samples: 5, ..quality }).unwrap();
    assert_eq!(files().len(), 3);
}
