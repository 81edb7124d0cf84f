//! Twin of `film.glsl`: interference in a thin film, by 801 wavelengths and by the bands that the shader adds up.
//!
//! Born & Wolf 1999, "Principles of Optics", 7.6 (reflectance of a plate); Belcour & Barla 2017, "A Practical Extension
//! to Microfacet Theory for the Modeling of Varying Iridescence" (the spectrum summed at once). Air lies outside, the
//! base has a real index.

use super::domain::{COSINE, Domain, UNIT};
use super::{Rule, TestInputs, Twin};
use glam::{DMat3, DVec2, DVec3};
use std::f64::consts::TAU;
use std::sync::LazyLock;

/// Bands that the shader adds up.
pub const BANDS: usize = 4;
/// Smallest cosine that is evaluated.
pub const SMALLEST_COSINE: f64 = 1e-4;

/// Colour matching functions of the CIE 1931 observer at a wavelength in nanometres (Wyman, Sloan & Shirley 2013, "Simple
/// Analytic Approximations to the CIE XYZ Color Matching Functions", the multi-lobe fit).
pub fn cie_1931(wavelength_nm: f64) -> DVec3 {
    let lobe = |height: f64, centre_nm: f64, below: f64, above: f64| {
        let away = wavelength_nm - centre_nm;
        height * (-0.5 * (away * if away < 0.0 { below } else { above }).powi(2)).exp()
    };
    DVec3::new(
        lobe(0.362, 442.0, 0.0624, 0.0374) + lobe(1.056, 599.8, 0.0264, 0.0323) - lobe(0.065, 501.1, 0.0490, 0.0382),
        lobe(0.821, 568.8, 0.0213, 0.0247) + lobe(0.286, 530.9, 0.0613, 0.0322),
        lobe(1.217, 437.0, 0.0845, 0.0278) + lobe(0.681, 459.0, 0.0385, 0.0725),
    )
}

/// Linear sRGB from tristimuli under equal energy: Bradford's adaptation to D65 (Lam 1985), then IEC 61966-2-1. Equal
/// energy is white, (1, 1, 1) of (1, 1, 1): without the adaptation it would be (1.21, 0.95, 0.91), and tint every film.
pub fn rgb_from_equal_energy_xyz() -> DMat3 {
    let rows = |x: [f64; 3], y: [f64; 3], z: [f64; 3]| DMat3::from_cols(x.into(), y.into(), z.into()).transpose();
    let rgb_from_xyz = rows(
        [3.240_454_2, -1.537_138_5, -0.498_531_4],
        [-0.969_266_0, 1.876_010_8, 0.041_556_0],
        [0.055_643_4, -0.204_025_9, 1.057_225_2],
    );
    let cone_from_xyz = rows([0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]);
    let d65 = DVec3::new(0.950_47, 1.0, 1.088_83);
    let gain = (cone_from_xyz * d65) / (cone_from_xyz * DVec3::ONE);
    rgb_from_xyz * cone_from_xyz.inverse() * DMat3::from_diagonal(gain) * cone_from_xyz
}

/// Fresnel's amplitudes (s, p) at a face between two indices, at those cosines.
fn amplitudes((index, cosine): (f64, f64), (index_behind, cosine_behind): (f64, f64)) -> [f64; 2] {
    let amplitude = |a: f64, b: f64| (a - b) / (a + b);
    [amplitude(index * cosine, index_behind * cosine_behind), amplitude(index_behind * cosine, index * cosine_behind)]
}

/// What light meets: the amplitudes of both faces, for s and p, and the difference of path of neighbouring orders.
struct Plate {
    outer: [f64; 2],
    inner: [f64; 2],
    path_nm: f64,
}

impl Plate {
    /// None where the film reflects totally.
    fn new(cosine: f64, thickness_nm: f64, film_ior: f64, base_f0: f64) -> Option<Self> {
        let cosine = cosine.max(SMALLEST_COSINE);
        let refracted = |index: f64| (1.0 - (1.0 - cosine * cosine) / (index * index)).sqrt();
        // A perfect mirror's index is infinite; 1 - 1e-15 is one in all that follows.
        let base_ior = ior_of_f0(base_f0.min(1.0 - 1e-15));
        let in_film = refracted(film_ior);
        let inside = (film_ior, in_film);
        (in_film > 0.0).then(|| Self {
            outer: amplitudes((1.0, cosine), inside),
            inner: amplitudes(inside, (base_ior, refracted(base_ior))),
            path_nm: 2.0 * film_ior * thickness_nm * in_film,
        })
    }
}

/// Index, against air, of a base that reflects `f0` at normal incidence.
pub fn ior_of_f0(f0: f64) -> f64 {
    (1.0 + f0.sqrt()) / (1.0 - f0.sqrt())
}

/// Unpolarised reflectance without a film.
pub fn bare(cosine: f64, base_f0: f64) -> f64 {
    airy(cosine, 0.0, 1.0, base_f0, 500.0)
}

/// Unpolarised reflectance at one wavelength: Airy's sum of all that is reflected back and forth in the film.
pub fn airy(cosine: f64, thickness_nm: f64, film_ior: f64, base_f0: f64, wavelength_nm: f64) -> f64 {
    let Some(plate) = Plate::new(cosine, thickness_nm, film_ior, base_f0) else { return 1.0 };
    let phase = TAU * plate.path_nm / wavelength_nm;
    let reflectance = |(a, b): (&f64, &f64)| {
        let beat = 2.0 * a * b * phase.cos();
        (a * a + b * b + beat) / (1.0 + a * a * b * b + beat)
    };
    0.5 * plate.outer.iter().zip(&plate.inner).map(reflectance).sum::<f64>()
}

/// Linear sRGB of a spectrum of reflectances under equal energy, by 801 wavelengths from 380 to 780 nm; not clamped.
pub fn color_of(reflectance: impl Fn(f64) -> f64) -> DVec3 {
    let (mut sum, mut white) = (DVec3::ZERO, DVec3::ZERO);
    for wavelength_nm in (0..=800).map(|step| 380.0 + 0.5 * f64::from(step)) {
        let matched = cie_1931(wavelength_nm);
        sum += matched * reflectance(wavelength_nm);
        white += matched;
    }
    rgb_from_equal_energy_xyz() * (sum / white)
}

/// What [`Fit::reflectance`] approaches: Airy's sum at 801 wavelengths, in [0, 1].
pub fn spectral_reflectance(cosine: f64, thickness_nm: f64, film_ior: f64, base_f0: DVec3) -> DVec3 {
    let channel = |at: usize| {
        color_of(|wavelength| airy(cosine, thickness_nm, film_ior, base_f0[at], wavelength))[at].clamp(0.0, 1.0)
    };
    DVec3::new(channel(0), channel(1), channel(2))
}

/// The bands that stand in `film.glsl`.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Centres, 1 / um.
    pub wavenumber: [f64; BANDS],
    /// Standard deviations, 1 / um.
    pub width: [f64; BANDS],
    /// `[red, green, blue][band]`.
    pub weights: [[f64; BANDS]; 3],
}

impl Fit {
    /// What the shader evaluates.
    ///
    /// # Panics
    /// If `film.glsl` does not hold the numbers; a test calls this.
    pub fn shipped() -> Self {
        let text = include_str!("../../../shaders_glsl/lib/film.glsl");
        let row = |name: &str| {
            let after = text.split(&format!("vec4 {name} = vec4(")).nth(1).and_then(|rest| rest.split(')').next());
            let numbers: Vec<f64> =
                after.unwrap_or("").split(',').filter_map(|word| word.trim().parse().ok()).collect();
            <[f64; BANDS]>::try_from(numbers).unwrap_or_else(|_| panic!("{name} in film.glsl is not four numbers"))
        };
        Self {
            wavenumber: row("FILM_WAVENUMBER"),
            width: row("FILM_WIDTH"),
            weights: ["FILM_RED", "FILM_GREEN", "FILM_BLUE"].map(row),
        }
    }

    /// `(phase, decay)` of a band's first order at a difference of path; order m has m times the phase and decay^(m^2).
    pub fn wave(&self, band: usize, path_um: f64) -> (f64, f64) {
        let spread = TAU * path_um * self.width[band];
        (TAU * path_um * self.wavenumber[band], (-0.5 * spread * spread).exp())
    }

    /// The mean of cos(2 pi path / wavelength) that a channel sees.
    pub fn sensitivity(&self, channel: usize, path_um: f64) -> f64 {
        let band = |(at, weight): (usize, &f64)| {
            let (phase, decay) = self.wave(at, path_um);
            weight * decay * phase.cos()
        };
        self.weights[channel].iter().enumerate().map(band).sum()
    }

    /// Reflectance as the shader has it, in [0, 1].
    pub fn reflectance(&self, cosine: f64, thickness_nm: f64, film_ior: f64, base_f0: DVec3) -> DVec3 {
        let channel = |at: usize| {
            let Some(plate) = Plate::new(cosine, thickness_nm, film_ior, base_f0[at]) else { return 1.0 };
            let path_um = plate.path_nm * 1e-3;
            let polarised = |(a, b): (&f64, &f64)| {
                let (passed, taken) = (1.0 - a * a, 1.0 - b * b);
                let bands = self.weights[at].iter().enumerate();
                let orders = bands.map(|(band, weight)| weight * orders(-a * b, self.wave(band, path_um))).sum::<f64>();
                let closed = (passed + a * a * taken).max(1e-20);
                a * a + passed * (passed * b * b - 2.0 * taken * orders) / closed
            };
            (0.5 * plate.outer.iter().zip(&plate.inner).map(polarised).sum::<f64>()).clamp(0.0, 1.0)
        };
        DVec3::new(channel(0), channel(1), channel(2))
    }
}

/// `sum of product^m decay^(m^2) cos(m phase)` over m >= 1, where from m = 2 on each term is `product decay^7 e^(i phase)`
/// times the one before.
pub fn orders(product: f64, (phase, decay): (f64, f64)) -> f64 {
    let turn = |amplitude: f64, phase: f64| amplitude * DVec2::from_angle(phase);
    let second = turn(product * product * decay.powi(4), 2.0 * phase);
    let left = DVec2::X - turn(product * decay.powi(7), phase);
    let tail = second.dot(left) / left.length_squared().max(1e-20);
    product * decay * phase.cos() + tail
}

/// F0 of the Schlick curve through a reflectance at a cosine, in [0, 1].
pub fn f0_of_reflectance(reflectance: f64, cosine: f64) -> f64 {
    let weight = (1.0 - cosine.clamp(0.0, 1.0)).powi(5);
    ((reflectance - weight) / (1.0 - weight).max(1e-5)).clamp(0.0, 1.0)
}

static FIT: LazyLock<Fit> = LazyLock::new(Fit::shipped);

/// Micrometres: no film, colours, and films too thick for any.
const PATH: Domain = Domain::Log(1e-3, 12.0, &[0.0, 1e-40, 1e-6, 0.5, 1e3]);
/// Nanometres.
const THICKNESS: Domain = Domain::Uniform(0.0, 1200.0, &[0.0, 1e-40, 1e-3, 550.0, 1e5]);
/// Against air; below 1, light is reflected totally from some angle on.
const INDEX: Domain = Domain::Uniform(0.7, 2.5, &[0.7, 1.0, 1.5, 2.5]);
/// A quantity that Fresnel's amplitudes are made of.
const PART: Domain = Domain::Log(1e-3, 10.0, &[1e-6, 1.0, 10.0]);
/// How far the product of two amplitudes stays below 1: next to nothing for grazing light on a bright metal.
const APART: Domain = Domain::Log(1e-5, 1.0, &[1e-5, 0.5, 1.0]);

/// Members of `FilmWaves`, as (phase, decay) of each band.
fn waves(inputs: &mut TestInputs<'_>) -> [(f64, f64); BANDS] {
    let phases = [(); BANDS].map(|()| 2.0 * inputs.number().clamp(0.0, 1.0).sqrt().asin());
    phases.map(|phase| (phase, inputs.number()))
}

/// What the shader's functions are held to.
pub(super) const TWINS: &[Twin] = &[
    Twin::new("film_waves", &[PATH], |inputs| {
        let path_um = inputs.number();
        let waves = [0, 1, 2, 3].map(|band| FIT.wave(band, path_um));
        let phases = waves.iter().map(|(phase, _)| (0.5 * phase).sin().powi(2));
        phases.chain(waves.iter().map(|(_, decay)| *decay)).collect()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("film_orders", &[Domain::Sign, APART, UNIT, UNIT], |inputs| {
        let product = inputs.number() * (1.0 - inputs.number());
        waves(inputs).map(|wave| orders(product, wave)).to_vec()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("film_polarised", &[PART, PART, PART, PART, UNIT, UNIT], |inputs| {
        let amplitude = |a: f64, b: f64| (a - b) / (a + b);
        let outer = amplitude(inputs.number(), inputs.number());
        let (film, base) = (inputs.vec3(), inputs.vec3());
        let waves = waves(inputs);
        let channel = |at: usize| {
            let inner = amplitude(film[at], base[at]);
            let (passed, taken) = (1.0 - outer * outer, 1.0 - inner * inner);
            let sum = |sum, (weight, wave): (&f64, _)| sum + weight * orders(-outer * inner, wave);
            let orders = FIT.weights[at].iter().zip(waves).fold(0.0, sum);
            let closed = passed + outer * outer * taken;
            outer * outer + passed * (passed * inner * inner - 2.0 * taken * orders) / closed
        };
        vec![channel(0), channel(1), channel(2)]
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("film_reflectance", &[COSINE, THICKNESS, INDEX, UNIT], |inputs| {
        let (cosine, thickness_nm, film_ior) = (inputs.number(), inputs.number(), inputs.number());
        FIT.reflectance(cosine, thickness_nm, film_ior, inputs.vec3()).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("film_f0", &[UNIT, COSINE], |inputs| {
        let (reflectance, cosine): (DVec3, _) = (inputs.vec3(), inputs.number());
        reflectance.to_array().map(|reflectance| f0_of_reflectance(reflectance, cosine)).to_vec()
    })
    .rule(Rule::Conditioned(4)),
];
