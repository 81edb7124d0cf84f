//! Models of fuzz, and what their lobes reflect, tabulated: the one thing about sheen that no formula gives.
//!
//! `tools/fit_sheen.rs` makes the table, [`SheenTable::shipped`] reads it, and a renderer uploads [`SheenTable::BYTES`]
//! as the texture that `sheen_table_uv` of `sheen.glsl` looks into.

use half::f16;

crate::choices! {
    /// How the fuzz of a cloth scatters light.
    pub enum SheenModel {
        Ltc = "ltc", "Light wanders between the fibres: soft, bright towards the outline, the closest to real fuzz.";
        Charlie = "charlie", "Fibres without order that scatter once: a finer rim, as other engines show it.";
        Inverted = "inverted", "Fibres that stand upright: a hard rim over an even veil.";
    }
}

impl SheenModel {
    /// Where the table has it.
    pub fn sheet(self) -> Sheen {
        match self {
            Self::Ltc => Sheen::Volume,
            Self::Charlie => Sheen::Charlie,
            Self::Inverted => Sheen::Inverted,
        }
    }
}

/// A sheet of the table: one model of fuzz. The numbers are those of `SHEEN_*` in `sheen.glsl`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Sheen {
    /// A slab of fibres that light walks through at random, as a linearly transformed cosine (Zeltner et al. 2022,
    /// "Practical Multiple-Scattering Sheen Using Linearly Transformed Cosines").
    Volume = 0,
    /// Charlie's distribution with its own shadowing (Estevez & Kulla 2017).
    Charlie = 1,
    /// The inverted Gaussian of velvet with the visibility of cloth (Ashikhmin et al. 2000; Neubelt & Pettineo 2013).
    Inverted = 2,
    /// Charlie's distribution with the visibility of cloth, cut at 1: the table of older engines.
    Classic = 3,
}

impl Sheen {
    /// All sheets, in their order.
    pub const ALL: [Self; 4] = [Self::Volume, Self::Charlie, Self::Inverted, Self::Classic];
}

/// One entry: the directional albedo under a white lobe, and how the lobe of [`Sheen::Volume`] lies.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SheenEntry {
    /// Share of the light that the lobe returns, in [0, 1].
    pub albedo: f64,
    /// Of the transform `(a x + b z, a y, z)`; > 0 in [`Sheen::Volume`], 0 elsewhere.
    pub a: f64,
    /// Of the same transform, x along the projection of the view.
    pub b: f64,
    /// Cosine-weighted average of the albedo over all views, the same for all cosines of a roughness.
    pub average: f64,
}

/// All sheets, each [`SheenTable::NODES`] x [`SheenTable::NODES`] entries: view cosines beside each other, evenly in
/// their square root from 0 to 1, and perceptual roughness from 0 to 1 below each other. Sheets follow downwards.
#[derive(Debug, Clone, PartialEq)]
pub struct SheenTable {
    entries: Vec<SheenEntry>,
}

impl SheenTable {
    /// Entries along the cosine and along the roughness; the outermost lie at 0 and 1.
    pub const NODES: usize = 32;
    /// Width and height of the texture.
    pub const SIZE: [u32; 2] = [Self::NODES as u32, (Self::NODES * Sheen::ALL.len()) as u32];
    /// Texels of that texture in rows, each four little-endian half floats: albedo, a, b, average.
    pub const BYTES: &[u8] = include_bytes!("sheen.f16");

    /// The cosine or roughness of a node; cosines are the square of their place.
    pub fn place(node: usize) -> f64 {
        node as f64 / (Self::NODES - 1) as f64
    }

    /// Computes every entry from (sheet, node of the cosine, node of the roughness), and rounds it as a texture does;
    /// averages are those of the interpolated albedo, and replace what `entry` gives.
    pub fn from_entries(entry: impl Fn(Sheen, usize, usize) -> SheenEntry) -> Self {
        let nodes = 0..Self::NODES;
        let rows = Sheen::ALL.into_iter().flat_map(|sheet| nodes.clone().map(move |row| (sheet, row)));
        let rows = rows.flat_map(|(sheet, row)| {
            let round = |entry: SheenEntry| SheenEntry {
                albedo: rounded(entry.albedo),
                a: rounded(entry.a),
                b: rounded(entry.b),
                average: 0.0,
            };
            let mut row: Vec<_> = nodes.clone().map(|column| round(entry(sheet, column, row))).collect();
            let average = rounded(average(&row));
            row.iter_mut().for_each(|entry| entry.average = average);
            row
        });
        Self { entries: rows.collect() }
    }

    /// The table that the shaders are given.
    pub fn shipped() -> Self {
        let half = |bytes: &[u8]| f16::from_le_bytes([bytes[0], bytes[1]]).to_f64();
        let entry = |texel: &[u8]| SheenEntry {
            albedo: half(texel),
            a: half(&texel[2..]),
            b: half(&texel[4..]),
            average: half(&texel[6..]),
        };
        Self { entries: Self::BYTES.chunks_exact(8).map(entry).collect() }
    }

    /// Rows of the texture, from the first: albedo, a, b, average.
    pub fn texels(&self) -> impl Iterator<Item = [f32; 4]> {
        self.entries.iter().map(|entry| [entry.albedo, entry.a, entry.b, entry.average].map(|value| value as f32))
    }

    /// The file that [`SheenTable::shipped`] reads: texels of four little-endian half floats.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.texels().flatten().flat_map(|value| f16::from_f32(value).to_le_bytes()).collect()
    }

    /// The entry between nodes, as the texture unit interpolates it: cosine and perceptual roughness in [0, 1].
    pub fn at(&self, sheet: Sheen, mu: f64, roughness: f64) -> SheenEntry {
        let place = |x: f64| {
            let x = x.clamp(0.0, 1.0) * (Self::NODES - 1) as f64;
            let node = (x as usize).min(Self::NODES - 2);
            (node, x - node as f64)
        };
        let ((column, right), (row, down)) = (place(mu.max(0.0).sqrt()), place(roughness));
        let start = (sheet as usize * Self::NODES + row) * Self::NODES + column;
        let [one, below] = [start, start + Self::NODES].map(|at| mixed(self.entries[at], self.entries[at + 1], right));
        mixed(one, below, down)
    }
}

fn rounded(value: f64) -> f64 {
    f16::from_f64(value).to_f64()
}

fn mixed(one: SheenEntry, other: SheenEntry, share: f64) -> SheenEntry {
    let mix = |value: fn(&SheenEntry) -> f64| value(&one) + (value(&other) - value(&one)) * share;
    SheenEntry { albedo: mix(|e| e.albedo), a: mix(|e| e.a), b: mix(|e| e.b), average: mix(|e| e.average) }
}

/// `2 int E mu dmu` of one roughness, E being linear in s = sqrt(mu) between nodes: `4 int E s^3 ds` in closed form.
fn average(row: &[SheenEntry]) -> f64 {
    let piece = |(node, pair): (usize, &[SheenEntry])| {
        let (from, to) = (SheenTable::place(node), SheenTable::place(node + 1));
        let slope = (pair[1].albedo - pair[0].albedo) / (to - from);
        let start = pair[0].albedo - slope * from;
        start * (to.powi(4) - from.powi(4)) + 0.8 * slope * (to.powi(5) - from.powi(5))
    };
    row.windows(2).enumerate().map(piece).sum()
}
