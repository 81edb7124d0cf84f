//! Judges `film.glsl`.

use super::super::domain::{COSINE, Domain, UNIT};
use super::super::twin::{Given, Rule, Twin};
use crate::material::reference::film::{self, BANDS, Fit};
use glam::DVec3;
use std::sync::LazyLock;

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
fn waves(given: &mut Given<'_>) -> [(f64, f64); BANDS] {
    let phases = [(); BANDS].map(|()| 2.0 * given.number().clamp(0.0, 1.0).sqrt().asin());
    phases.map(|phase| (phase, given.number()))
}

pub(super) const TWINS: &[Twin] = &[
    Twin::new("film_waves", &[PATH], |given| {
        let path_um = given.number();
        let waves = [0, 1, 2, 3].map(|band| FIT.wave(band, path_um));
        let phases = waves.iter().map(|(phase, _)| (0.5 * phase).sin().powi(2));
        phases.chain(waves.iter().map(|(_, decay)| *decay)).collect()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("film_orders", &[Domain::Sign, APART, UNIT, UNIT], |given| {
        let product = given.number() * (1.0 - given.number());
        waves(given).map(|wave| film::orders(product, wave)).to_vec()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("film_polarised", &[PART, PART, PART, PART, UNIT, UNIT], |given| {
        let amplitude = |a: f64, b: f64| (a - b) / (a + b);
        let outer = amplitude(given.number(), given.number());
        let (film, base) = (given.vec3(), given.vec3());
        let waves = waves(given);
        let channel = |at: usize| {
            let inner = amplitude(film[at], base[at]);
            let (passed, taken) = (1.0 - outer * outer, 1.0 - inner * inner);
            let sum = |sum, (weight, wave): (&f64, _)| sum + weight * film::orders(-outer * inner, wave);
            let orders = FIT.weights[at].iter().zip(waves).fold(0.0, sum);
            let closed = passed + outer * outer * taken;
            outer * outer + passed * (passed * inner * inner - 2.0 * taken * orders) / closed
        };
        vec![channel(0), channel(1), channel(2)]
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("film_reflectance", &[COSINE, THICKNESS, INDEX, UNIT], |given| {
        let (cosine, thickness_nm, film_ior) = (given.number(), given.number(), given.number());
        FIT.reflectance(cosine, thickness_nm, film_ior, given.vec3()).to_array().to_vec()
    })
    .rule(Rule::Conditioned(4)),
    Twin::new("film_f0", &[UNIT, COSINE], |given| {
        let (reflectance, cosine): (DVec3, _) = (given.vec3(), given.number());
        reflectance.to_array().map(|reflectance| film::f0_of_reflectance(reflectance, cosine)).to_vec()
    })
    .rule(Rule::Conditioned(4)),
];
