//! Judges `layered.glsl`.

use super::super::domain::{ALPHA, COSINE, Domain, RADIANCE, ROUGHNESS, UNIT};
use super::super::twin::{Given, Twin};
use super::albedo::{FIT, FRESNEL_ROUNDING, WHITE_ROUNDING};
use super::anisotropy::{COMPENSATION, Seen};
use crate::material::reference::layered;
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// Index of refraction: 0, or from that of air to beyond any that there is.
const IOR: Domain = Domain::Uniform(1.0, 4.0, &[0.0, 1.0, 1.0 + f32::EPSILON, 1.5, 1e30]);
/// Diffuse albedo of one side.
const HALF: Domain = Domain::Uniform(0.0, 0.5, &[0.0, 1e-40, 0.5]);
/// Diffuse albedo coupled to a lobe and divided by pi; the divisor is 1 - E_average, which no lobe that leaves light has
/// below 0.1.
const COUPLED: Domain = Domain::Uniform(0.0, 3.0, &[0.0, 1e-40, 3.0]);

/// E = (F0 + (F90 - F0) Q) (E1 + F0 (1 - E1)).
fn albedo(f0: DVec3, f90: f64, terms: DVec2) -> DVec3 {
    f0.lerp(DVec3::splat(f90), terms.y) * f0.lerp(DVec3::ONE, terms.x)
}

/// The average of the product of the two factors of [`albedo`], term by term.
fn average(f0: DVec3, f90: f64, averages: DVec3) -> DVec3 {
    let (both, white, fresnel) = (averages.x, averages.y, averages.z);
    let rest = f90 - f0;
    f0 * f0 + f0 * (1.0 - f0) * white + rest * f0 * fresnel + rest * (1.0 - f0) * both
}

fn vec2(given: &mut Given<'_>) -> (f64, f64) {
    (given.number(), given.number())
}

pub(super) const TWINS: &[Twin] = &[
    Twin::new("layered_f0_of_ior", &[IOR], |given| vec![layered::f0_of_ior(given.number())])
        .rule(super::super::twin::Rule::Conditioned(1)),
    Twin::new("layered_widths", &[ROUGHNESS, UNIT], |given| {
        let (along, across) = layered::widths(given.number(), given.number());
        vec![along, across]
    })
    .limit(2e-5, 0.0),
    Twin::new("layered_left", &[UNIT, UNIT, UNIT], |given| {
        let (f0, f90, terms) = (given.vec3(), given.number(), given.vec2());
        (1.0 - albedo(f0, f90, terms)).to_array().to_vec()
    }),
    Twin::new("layered_average_left", &[UNIT, UNIT, UNIT], |given| {
        let (f0, f90, terms) = (given.vec3(), given.number(), given.vec3());
        (1.0 - average(f0, f90, terms)).to_array().to_vec()
    }),
    Twin::new("layered_base", &[UNIT, UNIT, ALPHA, UNIT, UNIT, HALF, HALF], |given| {
        let (f0, f90, (ax, ay), terms, averages) =
            (given.vec3(), given.number(), vec2(given), given.vec2(), given.vec3());
        let (reflected, transmitted) = (given.vec3(), given.vec3());
        let albedo = albedo(f0, f90, terms);
        let coupling = (1.0 - albedo) / (PI * (1.0 - average(f0, f90, averages)).max(DVec3::splat(1e-4)));
        let mut words = f0.to_array().to_vec();
        words.push(f90);
        words.extend((1.0 + f0 * (1.0 - terms.x) / terms.x.max(1e-3)).to_array());
        words.extend([ax, ay]);
        let rest = [albedo, reflected, transmitted, reflected * coupling, transmitted * coupling];
        words.extend(rest.iter().flat_map(|value| value.to_array()));
        words
    })
    // Where a lobe takes all the light, what it leaves is a difference.
    .rule(super::super::twin::Rule::Conditioned(2)),
    Twin::new(
        "layered_base_times_cosine",
        &[
            UNIT,
            UNIT,
            COMPENSATION,
            ALPHA,
            ALPHA,
            UNIT,
            HALF,
            HALF,
            COUPLED,
            COUPLED,
            Domain::Hemisphere,
            Domain::Direction,
            UNIT,
        ],
        |given| {
            let seen = Seen::new(given);
            let _albedos = [given.vec3(), given.vec3(), given.vec3()];
            let (reflected, transmitted) = (given.vec3(), given.vec3());
            let (v, l, terms) = (given.vec3(), given.vec3(), given.vec2());
            if v.z <= 0.0 {
                return vec![0.0; 3];
            }
            let left = 1.0 - albedo(seen.lobe.f0, seen.lobe.f90, terms);
            let scattered = if l.z < 0.0 { transmitted } else { reflected } * left * l.z.abs();
            (seen.times_cosine(v, l) + scattered).to_array().to_vec()
        },
    ),
    Twin::new(
        "layered_base_ambient",
        &[UNIT, UNIT, COMPENSATION, ALPHA, ALPHA, UNIT, HALF, HALF, COUPLED, COUPLED, RADIANCE, RADIANCE, RADIANCE],
        |given| {
            let _ = Seen::new(given);
            let (albedo, reflected, transmitted) = (given.vec3(), given.vec3(), given.vec3());
            let _coupled = [given.vec3(), given.vec3()];
            let (mirrored, before, behind) = (given.vec3(), given.vec3(), given.vec3());
            let scattered = reflected * before + transmitted * behind;
            (albedo * mirrored + (1.0 - albedo) * scattered).to_array().to_vec()
        },
    ),
    Twin::new("layered_coat_albedo", &[COSINE, ROUGHNESS], |given| {
        vec![FIT.compensated_albedo(layered::COAT_F0, given.number(), given.number())]
    })
    .limit(2e-5, WHITE_ROUNDING + FRESNEL_ROUNDING),
    Twin::new("layered_coat_compensation", &[COSINE, ROUGHNESS], |given| {
        let (white, _) = FIT.terms(given.number(), given.number());
        vec![1.0 + layered::COAT_F0 * (1.0 - white) / white.max(1e-3)]
    })
    .limit(2e-5, WHITE_ROUNDING),
    Twin::new("layered_coat_times_cosine", &[ROUGHNESS, Domain::Hemisphere, Domain::Direction], |given| {
        let (lobe, v, l) = (layered::coat(given.number()), given.vec3(), given.vec3());
        vec![lobe.single_scattering_times_cosine(v, l).x]
    }),
    Twin::new("layered_sheen_albedo", &[UNIT], |given| vec![layered::sheen_albedo(given.number())]),
    Twin::new("layered_under", &[UNIT, UNIT, UNIT], |given| vec![layered::under(given.number(), given.vec2())]),
    Twin::new("layered_through", &[UNIT, UNIT, UNIT, UNIT], |given| {
        layered::through(given.number(), given.number(), given.vec3(), given.vec3()).to_array().to_vec()
    }),
];
