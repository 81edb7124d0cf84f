//! What a lobe sees through the opening of a crevice stays beside quadrature.

use glam::DVec3;
use std::f64::consts::PI;
use vair::measure::twin::{ggx, occlusion};

/// Steps of the occlusion, ends left out.
const STEPS: usize = 20;

/// Share of the lobe's light within cones around the normal, by visible normals (Dupuy & Benyoub 2023, "Sampling Visible
/// GGX Normals with Spherical Caps").
fn truth(mu: f64, roughness: f64) -> [f64; STEPS - 1] {
    let alpha = ggx::alpha_of_roughness(roughness);
    let v = DVec3::new((1.0 - mu * mu).sqrt(), 0.0, mu);
    let pole = DVec3::new(alpha * v.x, 0.0, v.z).normalize();
    let (mut within, mut all) = ([0.0; STEPS - 1], 0.0);
    for index in 0..4096 {
        let (row, column) = ((index / 64) as f64 + 0.5, (index % 64) as f64 + 0.5);
        let z = row / 64.0 * (1.0 + pole.z) - pole.z;
        let (y, x) = (column / 64.0 * 2.0 * PI).sin_cos();
        let cap = (1.0 - z * z).sqrt() * DVec3::new(x, y, 0.0) + z * DVec3::Z + pole;
        let h = DVec3::new(alpha * cap.x, alpha * cap.y, cap.z).normalize();
        let l = 2.0 * v.dot(h) * h - v;
        if l.z <= 0.0 {
            continue;
        }
        // Over the density of visible normals; what is constant of it falls out.
        let weight = ggx::masking_shadowing_times_cosine(v, l, alpha, alpha);
        all += weight;
        for (step, share) in within.iter_mut().enumerate() {
            // A cone that lets through `occlusion` of an even sky's irradiance.
            let occlusion = (step + 1) as f64 / STEPS as f64;
            *share += if l.z * l.z > 1.0 - occlusion { weight } else { 0.0 };
        }
    }
    within.map(|share| share / all)
}

/// Mean and largest RMS error over the occlusion, over roughness and cosines.
fn errors(form: impl Fn(f64, f64, f64) -> f64) -> (f64, f64) {
    let roughness = [0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.85, 1.0];
    let all: Vec<f64> = roughness
        .into_iter()
        .flat_map(|roughness| [0.05, 0.1, 0.3, 0.6, 0.8, 0.95, 1.0].map(|mu| (roughness, mu)))
        .map(|(roughness, mu)| {
            let off = |(step, share): (usize, f64)| form(mu, roughness, (step + 1) as f64 / STEPS as f64) - share;
            let squared: f64 = truth(mu, roughness).into_iter().enumerate().map(|at| off(at).powi(2)).sum();
            (squared / (STEPS - 1) as f64).sqrt()
        })
        .collect();
    (all.iter().sum::<f64>() / all.len() as f64, all.iter().copied().fold(0.0, f64::max))
}

#[test]
fn a_lobe_sees_what_quadrature_sees() {
    let (mean, most) = errors(occlusion::of_lobe);
    assert!(mean <= 0.032 && most <= 0.09, "what the header of occlusion.glsl says: {mean} {most}");
    // Lagarde & de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", which it takes the place of.
    let theirs = |mu: f64, roughness: f64, open: f64| {
        ((mu + open).powf((-16.0 * roughness - 1.0).exp2()) - 1.0 + open).clamp(0.0, 1.0)
    };
    let (mean, most) = errors(theirs);
    assert!(mean > 0.2 && most > 0.5, "{mean} {most}");
}
