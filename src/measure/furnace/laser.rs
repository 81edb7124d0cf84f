//! Property checks of laser cloth: its colours are shares, its films gain nothing.

use super::fur::outside;
use super::property_check::{Input, PropertyCheck};
use super::quadrature::{direction, over_cosines, over_reflections};
use super::{ALBEDO_LIMIT, light};
use crate::material::{Laser, Standard};
use crate::measure::twin::albedo::Fit;
use crate::measure::twin::standard::Lobes;
use crate::measure::twin::{film, ggx, laser};
use glam::DVec3;
use std::sync::LazyLock;

static FIT: LazyLock<Fit> = LazyLock::new(Fit::shipped);
static FILM: LazyLock<film::Fit> = LazyLock::new(film::Fit::shipped);

/// Under a film: grey base colour, metallic, roughness, thickness, its index, the base's index, and the eye.
fn under_film(x: &[f64]) -> Lobes {
    let plain = ((x[5] - 1.0) / (x[5] + 1.0)).powi(2);
    let base_f0 = DVec3::splat(plain + (x[0] - plain) * x[1]);
    let reflectance = FILM.reflectance(x[6], x[3], x[4], base_f0);
    Lobes {
        f0: reflectance.to_array().map(|reflectance| film::f0_of_reflectance(reflectance, x[6])).into(),
        diffuse: DVec3::splat(x[0] * (1.0 - x[1])),
        roughness: x[2],
    }
}

/// Everything that `checks` promises.
pub fn checks() -> Vec<PropertyCheck> {
    let check = |property, limit, inputs, value| PropertyCheck {
        material: "laser",
        property,
        classic: false,
        limit,
        inputs,
        value,
    };
    let eye = || Input::cosine("cosine_to_eye");
    let shares = || vec![Input::of::<Laser>("saturation"), Input::of::<Laser>("brightness")];
    let change = || Input {
        grazing: true,
        corners: vec![1e-3, 0.1, 0.5, 1.0, 5.0],
        ..Input::between("turns_a_pixel", (1e-3, 5.0))
    };
    let film = || {
        vec![
            Input::of::<Standard>("base_color"),
            Input::of::<Standard>("metallic"),
            Input::of::<Standard>("roughness"),
            Input::of::<Laser>("film_thickness"),
            Input::of::<Laser>("film_ior"),
            Input::of::<Laser>("base_ior"),
            eye(),
        ]
    };
    let mut checks = vec![
        check(
            "colour of the wheel outside 0 to 1, by",
            Some(1e-12),
            [shares(), vec![Input::between("phase", (0.0, 1.0)), change()]].concat(),
            Box::new(|x| laser::wheel(x[2], x[3], x[0], x[1]).to_array().map(outside).into_iter().fold(0.0, f64::max)),
        ),
        check(
            "colour of a ramp outside 0 to 1, by",
            Some(1e-12),
            [shares(), ["red", "green", "blue", "offset"].map(|name| Input::between(name, (0.0, 1.0))).to_vec()]
                .concat(),
            Box::new(|x| {
                let color = laser::ramp(DVec3::new(x[2], x[3], x[4]), x[5], x[0], x[1]);
                color.to_array().map(outside).into_iter().fold(0.0, f64::max)
            }),
        ),
        check(
            "mean of the wheel, off the faded colour by",
            Some(1e-3),
            shares(),
            Box::new(|x| {
                let wheel = |step| laser::wheel(f64::from(step) / 600.0, 0.0, x[0], x[1]);
                let mean = (0..600).map(wheel).sum::<DVec3>() / 600.0;
                (mean - laser::wheel(0.0, 1e3, x[0], x[1])).abs().max_element()
            }),
        ),
        // Of whatever the film has made of them.
        check(
            "directional albedo",
            Some(ALBEDO_LIMIT),
            vec![
                Input::between("f0", (0.0, 1.0)),
                Input::of::<Standard>("base_color"),
                Input::of::<Standard>("roughness"),
                eye(),
            ],
            Box::new(|x| {
                let lobes = Lobes { f0: DVec3::splat(x[0]), diffuse: DVec3::splat(x[1]), roughness: x[2] };
                albedo(&lobes, x[3])
            }),
        ),
        check(
            "radiance under white ambient light, of a film",
            Some(ALBEDO_LIMIT),
            film(),
            Box::new(|x| under_film(x).ambient(&FIT, x[6]).max_element()),
        ),
        // The colour asks the eye's side only: this is how far the whole is from reciprocal, by design.
        check(
            "colour over itself swapped",
            None,
            vec![
                Input::of::<Laser>("hue_span"),
                Input::of::<Laser>("hue_offset"),
                eye(),
                Input::cosine("cosine_to_light"),
            ],
            Box::new(|x| {
                let color = |mu: f64| 0.04 + laser::wheel((1.0 - mu) * x[0] + x[1], 0.0, 1.0, 1.0).x;
                color(x[2]) / color(x[3])
            }),
        ),
    ];
    let lit = [film(), vec![Input::signed_cosine("cosine_to_light"), Input::turn("eye_to_light_deg")]].concat();
    checks.extend(light::checks("laser", false, &lit, |x, irradiance| {
        let (v, l) = (direction(x[6], 0.0), direction(x[7], x[8].to_radians()));
        let lobes = under_film(x);
        irradiance * (lobes.brdf_times_cosine(&FIT, v, l) + lobes.ambient(&FIT, x[6]))
    }));
    checks
}

/// Share of white light that comes back to an eye at the cosine `mu`.
fn albedo(lobes: &Lobes, mu: f64) -> f64 {
    let alpha = ggx::alpha_of_roughness(lobes.roughness);
    let v = direction(mu, 0.0);
    let reflected = over_reflections(v, (alpha, alpha), |l| lobes.single_scattering_times_cosine(v, l).x);
    let diffuse = over_cosines(|mu_l| lobes.diffuse_brdf(&FIT, mu, mu_l).x * mu_l);
    lobes.specular_compensation(&FIT, mu).x * reflected + diffuse
}
