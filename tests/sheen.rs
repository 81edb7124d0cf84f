//! Promise: fuzz returns what it should and never more, whatever its model; its table is that of light that walks through
//! fibres; and the cloth below gets exactly what is left.
#![cfg(feature = "measure")]

use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use vair::material::{Sheen, SheenTable};
use vair::measure::furnace::{Property, checks};
use vair::measure::twin::albedo::gauss_legendre;
use vair::measure::twin::fuzz::Surface;
use vair::measure::twin::sheen::{self, Lobe, SMALLEST_CHARLIE_ALPHA};

/// What a material may choose.
const MODELS: [Sheen; 3] = [Sheen::Volume, Sheen::Charlie, Sheen::Inverted];

fn direction(cosine: f64, turn: f64) -> DVec3 {
    let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
    DVec3::new(sine * turn.cos(), sine * turn.sin(), cosine)
}

/// Integral over the upper hemisphere, by a product rule that crowds towards the horizon.
fn over_hemisphere(points: usize, value: impl Fn(DVec3) -> f64) -> f64 {
    let rule = gauss_legendre(points);
    let ring = |u: f64| -> f64 {
        let turn = |at: usize| 2.0 * PI * (at as f64 + 0.5) / points as f64;
        (0..points).map(|at| value(direction(u.powi(3), turn(at)))).sum::<f64>() / points as f64
    };
    rule.iter().map(|&(u, weight)| weight * 6.0 * PI * u * u * ring(u)).sum()
}

fn checked(material: &str, property: &str, random: usize) -> Property {
    let checks = checks();
    let check = checks.iter().find(|c| !c.classic && (c.material, c.property) == (material, property));
    check.unwrap_or_else(|| panic!("{material}: {property}")).judge(random)
}

#[test]
fn sheen_norm() {
    for alpha in [0.005, 0.02, 0.07, 0.3, 1.0] {
        let norm = over_hemisphere(192, |h| sheen::charlie_ndf(h, alpha) * h.z);
        assert!((norm - 1.0).abs() <= 1e-4, "alpha {alpha}: {norm}");
    }
    assert!(checked("sheen", "integral of Charlie's normals, off 1 by", 100).pass);
}

#[test]
fn velvet_norm() {
    for alpha in [1e-3, 0.02, 0.1, 0.5, 1.0] {
        let norm = over_hemisphere(256, |h| sheen::inverted_ndf(h, alpha) * h.z);
        assert!((norm - 1.0).abs() <= 1e-5, "alpha {alpha}: {norm}");
    }
    assert!(checked("sheen", "integral of inverted normals, off 1 by", 100).pass);
}

#[test]
fn sheen_zero_roughness() {
    let table = SheenTable::shipped();
    for sheet in Sheen::ALL {
        for roughness in [0.0, 1e-8, 1e-40] {
            let lobe = Lobe { table: &table, sheet, roughness };
            for cosine in [1e-7, 0.3, 1.0] {
                for l in [direction(1e-7, 0.0), direction(1e-7, PI), direction(0.5, 1.0), DVec3::Z] {
                    let value = lobe.times_cosine(direction(cosine, 0.0), l);
                    assert!(value.is_finite() && value >= 0.0, "{sheet:?} {roughness} {cosine} {l}: {value}");
                }
            }
        }
    }
}

/// Seeded numbers in (0, 1): SplitMix64 (Steele, Lea & Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (((z ^ (z >> 31)) >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    fn direction(&mut self) -> DVec3 {
        direction_of_sphere(2.0 * self.next() - 1.0, 2.0 * PI * self.next())
    }
}

fn direction_of_sphere(z: f64, turn: f64) -> DVec3 {
    let across = (1.0 - z * z).sqrt();
    DVec3::new(across * turn.cos(), across * turn.sin(), z)
}

/// Where light that falls into the fibres comes out at the top, if it does. Flakes by the definition of SGGX (Heitz et al.
/// 2015, equations 7 and 16), by rejection: a way of its own, not that of the table's maker.
fn walk(mu: f64, alpha: f64, random: &mut Random) -> Option<DVec3> {
    let mut along = -direction(mu, 0.0);
    let mut depth = 0.0;
    loop {
        let projected = (along.x.powi(2) + along.y.powi(2) + (alpha * along.z).powi(2)).sqrt();
        depth -= along.z * -random.next().ln() / projected;
        if depth < 0.0 {
            return Some(along);
        }
        if depth > 1.0 {
            return None;
        }
        let flake = loop {
            let m = random.direction();
            // The distribution over its largest value, times the projected area.
            let spread = m.x.powi(2) + m.y.powi(2) + (m.z / alpha).powi(2);
            if random.next() < -along.dot(m) / spread.powi(2) {
                break m;
            }
        };
        along -= 2.0 * along.dot(flake) * flake;
    }
}

#[test]
fn ltc_r() {
    let table = SheenTable::shipped();
    // Between nodes: bilinear look-ups beside walks whose standard error is at most 0.0016.
    const WALKS: usize = 100_000;
    let mut random = Random(20);
    for (mu, roughness) in [(0.07, 0.62), (0.3, 1.0), (0.8, 1.0), (0.33, 0.85), (0.55, 0.71), (0.13, 0.55)] {
        let back = (0..WALKS).filter(|_| walk(mu, roughness * roughness, &mut random).is_some()).count();
        let (walked, looked_up) = (back as f64 / WALKS as f64, table.at(Sheen::Volume, mu, roughness).albedo);
        assert!((walked - looked_up).abs() <= 0.02, "mu {mu} roughness {roughness}: {walked} walked, {looked_up}");
    }
    // An independent renderer's slab of the same flakes.
    for (mu, known) in [(0.3, 0.591), (0.8, 0.389)] {
        let found = table.at(Sheen::Volume, mu, 1.0).albedo;
        assert!((found - known).abs() <= 0.02, "mu {mu}: {found} for {known}");
    }
}

#[test]
fn the_table_is_smooth_and_within_its_bounds() {
    let table = SheenTable::shipped();
    let nodes = SheenTable::NODES;
    let node = |sheet, column, row| table.at(sheet, SheenTable::place(column).powi(2), SheenTable::place(row));
    for sheet in Sheen::ALL {
        for (column, row) in (0..nodes * nodes).map(|at| (at % nodes, at / nodes)) {
            let entry = node(sheet, column, row);
            let at = format!("{sheet:?} {column} {row}: {entry:?}");
            assert!((0.0..=1.0).contains(&entry.albedo) && (0.0..0.5).contains(&entry.average), "{at}");
            assert_eq!(entry.a > 1e-5, sheet == Sheen::Volume, "{at}");
            if sheet == Sheen::Volume && column > 0 {
                // The walks' errors, five times over.
                assert!(entry.albedo <= node(sheet, column - 1, row).albedo + 5.0 * 7e-4, "{at} rises to the normal");
            }
            if sheet == Sheen::Volume && column == nodes - 1 {
                assert_eq!(entry.b, 0.0, "{at}: seen from above there is no side to lean to");
            }
        }
    }
}

#[test]
fn the_table_reads_what_it_writes() {
    let table = SheenTable::shipped();
    let bytes = table.to_bytes();
    assert_eq!(bytes.len(), 8 * (SheenTable::SIZE[0] * SheenTable::SIZE[1]) as usize);
    let again = SheenTable::from_entries(|sheet, column, row| {
        table.at(sheet, SheenTable::place(column).powi(2), SheenTable::place(row))
    });
    let steps =
        again.texels().zip(table.texels()).flat_map(|(a, b)| std::array::from_fn::<_, 4, _>(|i| (a[i] - b[i]).abs()));
    // Averages are computed anew: they are those of the albedos.
    assert!(steps.fold(0.0, f32::max) <= 1e-6);
}

#[test]
fn ltc_integral() {
    for (a, b) in [(0.05, -0.2), (0.2, -0.2), (0.5, 0.1), (1.0, 0.0)] {
        for axis in [DVec2::X, DVec2::new(-0.6, 0.8)] {
            // In the transform's own slopes: w = M l, so that the narrowest lobe is as wide as any.
            let integral = over_hemisphere(192, |w| {
                let l = DVec3::new((w.x - b * w.z) / a, w.y / a, w.z);
                let turned = axis.extend(0.0) * l.x + axis.perp().extend(0.0) * l.y + DVec3::Z * l.z;
                sheen::ltc_times_cosine(a, b, axis, turned.normalize()) / (a * a * l.length().powi(3))
            });
            assert!((integral - 1.0).abs() <= 1e-3, "a {a} b {b}: {integral}");
        }
    }
    assert_eq!(sheen::ltc_times_cosine(0.0, 0.1, DVec2::X, DVec3::Z), 0.0, "no transform, no lobe");
}

/// A white base under white fuzz of both kinds.
fn white(table: &SheenTable, sheet: Sheen, roughness: f64) -> Surface<'_> {
    let lobe = |roughness| Lobe { table, sheet, roughness };
    let (pile, fibre) = (lobe(0.5 * roughness + 0.2), lobe(roughness));
    Surface { diffuse: DVec3::ONE, pile_color: DVec3::splat(0.04), fibre_color: DVec3::ONE, pile, fibre }
}

#[test]
fn cloth_furnace() {
    let table = SheenTable::shipped();
    for roughness in [0.3, 0.6, 1.0] {
        for mu in [0.05, 0.4, 1.0] {
            let (cloth, v) = (white(&table, Sheen::Volume, roughness), direction(mu, 0.0));
            let albedo = over_hemisphere(256, |l| cloth.brdf_times_cosine(v, l).x);
            assert!((albedo - 1.0).abs() <= 1e-3, "roughness {roughness} mu {mu}: {albedo}");
        }
    }
    for material in ["cotton", "velvet"] {
        for property in [
            "directional albedo",
            "white cloth under ltc, off 1 by",
            "white cloth under others, off 1 by",
            "radiance under white ambient light",
        ] {
            let property = checked(material, property, 300);
            println!("{property}");
            assert!(property.pass, "{property}");
        }
    }
}

#[test]
fn cloth_reciprocity() {
    for (material, property) in [
        ("cotton", "base, off reciprocal by"),
        ("velvet", "base, off reciprocal by"),
        ("sheen", "Charlie and inverted, off reciprocal by"),
    ] {
        let property = checked(material, property, 2000);
        assert!(property.pass, "{property}");
    }
    // Exempt, and on record.
    assert!(checked("sheen", "ltc over itself swapped", 2000).limit.is_none());
}

#[test]
fn lut_consistency() {
    // One number is the roughness of the lobe and of its entry: what the table says of it is what the lobe returns.
    let table = SheenTable::shipped();
    for sheet in MODELS {
        for factor in [0.2, 0.6, 1.0] {
            for map in [0.5, 1.0] {
                let lobe = Lobe { table: &table, sheet, roughness: factor * map };
                let v = direction(0.35, 0.0);
                let returned = over_hemisphere(192, |l| lobe.times_cosine(v, l));
                let entry = lobe.entry(0.35).albedo;
                assert!((returned - entry).abs() <= 0.03, "{sheet:?} {factor} x {map}: {returned}, table {entry}");
            }
        }
    }
}

#[test]
fn no_model_returns_more_than_it_gets() {
    for property in ["directional albedo", "albedo, off its table by"] {
        let property = checked("sheen", property, 1000);
        println!("{property}");
        assert!(property.pass, "{property}");
    }
    // The floor is where it has to be: narrower, Charlie would gain.
    let narrow = |alpha: f64| {
        let mu = 0.01;
        let v = direction(mu, 0.0);
        over_hemisphere(256, |l| {
            let shadowing = 1.0 / (1.0 + sheen::charlie_lambda(mu, alpha) + sheen::charlie_lambda(l.z, alpha));
            sheen::charlie_ndf((v + l).normalize(), alpha) * shadowing / (4.0 * mu)
        })
    };
    assert!(narrow(SMALLEST_CHARLIE_ALPHA) <= 1.0 && narrow(0.05) > 1.05);
}
