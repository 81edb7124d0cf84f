//! Makes `src/material/sheen.f16`: `cargo run --release --example fit_sheen`, a few minutes.
//!
//! [`Sheen::Volume`]: light walks at random through a slab of fibre-like SGGX microflakes that stand on the cloth (Heitz
//! et al. 2015, "The SGGX Microflake Distribution"; Zeltner et al. 2022, section 3). The slab is one unit thick and holds
//! one unit of flakes, which lose nothing; what falls through is the cloth's. What comes back gives the albedo and the two
//! parameters of the lobe. The other sheets are integrals of their formulas.

use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::PI;
use vair::material::{Sheen, SheenEntry, SheenTable};
use vair::measure::twin::albedo::gauss_legendre;
use vair::measure::twin::{hash, sheen};

/// Walks a view and roughness. The albedo's standard error is at most 0.5 / sqrt(WALKS) = 0.0007; the texture's own
/// step is 0.0005.
const WALKS: u32 = 1 << 19;
/// Walks that must come back for a lobe to be fitted to them.
const FEWEST: usize = 1000;

fn main() -> std::io::Result<()> {
    let nodes = SheenTable::NODES;
    let of_node = |index: usize| {
        let sheet = Sheen::ALL[index / (nodes * nodes)];
        let (column, row) = (index % nodes, index / nodes % nodes);
        let (mu, roughness) = (SheenTable::place(column).powi(2), SheenTable::place(row));
        match sheet {
            Sheen::Volume => slab(mu, roughness, index as u32),
            _ => SheenEntry { albedo: albedo(sheet, mu, roughness).min(1.0), ..SheenEntry::default() },
        }
    };
    let entries: Vec<_> = (0..nodes * nodes * Sheen::ALL.len()).into_par_iter().map(of_node).collect();
    let at = |sheet: Sheen, column: usize, row: usize| entries[(sheet as usize * nodes + row) * nodes + column];
    let lifts = Sheen::ALL.map(|sheet| lift(sheet, |column, row| at(sheet, column, row).albedo));
    let table = SheenTable::from_entries(|sheet, column, row| {
        let mut entry = at(sheet, column, row);
        entry.albedo = (entry.albedo * lifts[sheet as usize]).min(1.0);
        if sheet == Sheen::Volume && entry.a == 0.0 {
            // Nothing came back whose lobe could be fitted; the next that has one keeps what lies between them smooth.
            let grazing = (0..column).rev().map(|column| at(sheet, column, row));
            let rougher = (row + 1..nodes).map(|row| at(sheet, column, row));
            let near = grazing.chain(rougher).find(|near| near.a > 0.0).unwrap_or_default();
            (entry.a, entry.b) = (near.a, near.b);
        }
        if column == nodes - 1 {
            // Seen from straight above there is no side to lean to.
            entry.b = 0.0;
        }
        entry
    });
    eprintln!("factors: {lifts:?}");
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/material/sheen.f16");
    std::fs::write(path, table.to_bytes())
}

/// What the interpolated albedo of a lobe may fall short by: half of what a material may return beyond what it gets.
const GAIN: f64 = 5e-4;

/// Factor on a sheet that keeps its interpolated albedo from falling below the truth: there the cloth below would get more
/// than the fuzz leaves. The transformed cosine integrates to whatever the table says, and the classic sheet is what it is.
fn lift(sheet: Sheen, node: impl Fn(usize, usize) -> f64 + Sync) -> f64 {
    if matches!(sheet, Sheen::Volume | Sheen::Classic) {
        return 1.0;
    }
    let cells = SheenTable::NODES - 1;
    let of_cell = |cell: usize| {
        let (column, row) = (cell % cells, cell / cells);
        let lack = |right: f64, down: f64| {
            let place = |node, share: f64| SheenTable::place(node) + share / cells as f64;
            let truth = albedo(sheet, place(column, right).powi(2), place(row, down));
            let mix = |row| node(column, row) * (1.0 - right) + node(column + 1, row) * right;
            let found = mix(row) * (1.0 - down) + mix(row + 1) * down;
            (truth - GAIN) / found
        };
        lack(0.5, 0.0).max(lack(0.0, 0.5)).max(lack(0.5, 0.5))
    };
    (0..cells * cells).into_par_iter().map(of_cell).reduce(|| 1.0, f64::max)
}

/// Seeded numbers in (0, 1).
struct Random {
    seed: u32,
    walk: u32,
    drawn: u32,
}

impl Random {
    fn pair(&mut self) -> [f64; 2] {
        self.drawn += 1;
        let [x, y, _] = hash::pcg3d([self.walk, self.drawn, self.seed]);
        [x, y].map(|bits| (f64::from(bits) + 0.5) / 2f64.powi(32))
    }
}

/// What comes back from the slab to a view at the cosine `mu`, walked backwards: it is the same.
fn slab(mu: f64, roughness: f64, seed: u32) -> SheenEntry {
    let alpha = roughness * roughness;
    // Fibres without any width turn light around themselves only: what falls keeps falling, forever from the horizon.
    if alpha == 0.0 {
        return SheenEntry::default();
    }
    let mut slopes = Vec::new();
    for walk in 0..WALKS {
        if let Some(out) = escaped(mu, alpha, &mut Random { seed, walk, drawn: 0 }) {
            slopes.push([out.x / out.z, out.y / out.z]);
        }
    }
    let albedo = slopes.len() as f64 / f64::from(WALKS);
    let (a, b) = most_likely(&slopes, mu == 1.0);
    SheenEntry { albedo, a, b, average: 0.0 }
}

/// The direction in which a walk leaves the slab through its top.
fn escaped(mu: f64, alpha: f64, random: &mut Random) -> Option<DVec3> {
    // Depths grow downwards from 0 to 1. The eye lies towards +x, the walk starts away from it; along the horizon it meets
    // its first flake at the very top.
    let mut along = -DVec3::new((1.0 - mu * mu).max(0.0).sqrt(), 0.0, mu);
    let mut depth = 0.0;
    loop {
        // Flakes of a fibre that stands along z: S = diag(1, 1, alpha^2), projected area |M w| with M = diag(1, 1, alpha).
        let stretched = DVec3::new(along.x, along.y, alpha * along.z);
        let area = stretched.length();
        let [path, radius] = random.pair();
        let [turn, _] = random.pair();
        depth += along.z * path.ln() / area;
        if depth < 0.0 {
            return Some(along);
        }
        if depth >= 1.0 {
            return None;
        }
        // A visible point of the stretched sphere, even over the disc that is seen, gives the visible flake.
        let pole = -stretched / area;
        let x = pole.any_orthonormal_vector();
        let y = pole.cross(x);
        let (sine, cosine) = (2.0 * PI * turn).sin_cos();
        let disc = radius.sqrt();
        let point = disc * cosine * x + disc * sine * y + (1.0 - radius).sqrt() * pole;
        let flake = DVec3::new(point.x, point.y, alpha * point.z).normalize();
        along -= 2.0 * along.dot(flake) * flake;
    }
}

/// The lobe that most likely sent these slopes; none of them at all: zeros. In slopes the transformed cosine is Student's t
/// distribution of two variables and two degrees of freedom, with its middle at (-b / a, 0) and the scale 1 / (sqrt(2) a),
/// whose likeliest parameters reweighting finds (Kent, Tyler & Vardi 1994, "A Curious Likelihood Identity for the
/// Multivariate t-Distribution").
fn most_likely(slopes: &[[f64; 2]], is_centred: bool) -> (f64, f64) {
    if slopes.len() < FEWEST {
        return (0.0, 0.0);
    }
    let (mut a, mut middle) = (1.0f64, 0.0);
    for _ in 0..200 {
        let mut sums = [0.0; 3];
        for &[x, y] in slopes {
            let weight = 1.0 / (1.0 + a * a * ((x - middle).powi(2) + y * y));
            sums[0] += weight;
            sums[1] += weight * x;
            sums[2] += weight * (x * x + y * y);
        }
        let next = if is_centred { 0.0 } else { sums[1] / sums[0] };
        let next_a = (sums[0] / (sums[2] - next * next * sums[0])).sqrt();
        let change = (next_a - a).abs() / a + (next - middle).abs() * a;
        (a, middle) = (next_a, next);
        if change < 1e-5 {
            break;
        }
    }
    (a, -a * middle)
}

/// Share of white light that a lobe returns, by quadrature crowded towards the horizon.
fn albedo(sheet: Sheen, mu: f64, roughness: f64) -> f64 {
    let mu = mu.max(sheen::SMALLEST_COSINE);
    let v = DVec3::new((1.0 - mu * mu).sqrt(), 0.0, mu);
    let rule = gauss_legendre(192);
    let mut sum = 0.0;
    for &(u, weight_u) in &rule {
        let mu_l = u * u * u;
        let across = (1.0 - mu_l * mu_l).sqrt();
        for &(turn, weight_turn) in &rule {
            let (sine, cosine) = (PI * turn).sin_cos();
            let l = DVec3::new(across * cosine, across * sine, mu_l);
            let lobe = sheen::lobe_times_cosine(sheet, SheenEntry::default(), roughness, v, l);
            sum += weight_u * weight_turn * 6.0 * PI * u * u * lobe;
        }
    }
    sum
}
