//! Property checks of the cloths with fuzz: cotton and velvet.

use super::property_check::{Input, PropertyCheck};
use super::quadrature::{direction, over_cosines, over_hemisphere};
use super::sheen::{TABLE_ERROR, lobe, model_input};
use super::{ALBEDO_LIMIT, light};
use crate::material::{Cotton, Standard, Velvet};
use crate::measure::twin::fuzz::{COTTON_F0, Surface};
use glam::DVec3;

/// A surface from the inputs of a family.
type Made = fn(&[f64]) -> Surface<'static>;

fn cotton(x: &[f64]) -> Surface<'static> {
    Surface {
        diffuse: DVec3::splat(x[3]),
        pile_color: DVec3::splat(COTTON_F0),
        fibre_color: DVec3::splat(x[4]),
        pile: lobe(x[2], x[1]),
        fibre: lobe(x[2], x[5]),
    }
}

fn velvet(x: &[f64]) -> Surface<'static> {
    let f0 = COTTON_F0 + (x[3] - COTTON_F0) * x[6];
    let scatter = Velvet { scatter_scale: x[5] as f32, ..Velvet::default() };
    Surface {
        diffuse: DVec3::splat(x[3] * (1.0 - x[6])),
        pile_color: DVec3::splat(f0),
        fibre_color: DVec3::splat(x[4]),
        pile: lobe(x[2], x[1]),
        fibre: lobe(x[2], f64::from(scatter.scatter_roughness())),
    }
}

/// Everything that is checked of both.
pub fn checks() -> Vec<PropertyCheck> {
    let shared = || {
        vec![
            Input::cosine("cosine_to_eye"),
            Input::of::<Standard>("roughness"),
            model_input(),
            Input::of::<Standard>("base_color"),
        ]
    };
    let of_cotton = vec![Input::of::<Cotton>("sheen_color"), Input::of::<Cotton>("sheen_roughness")];
    let of_velvet = vec![
        Input::of::<Velvet>("scatter_color"),
        Input::of::<Velvet>("scatter_scale"),
        Input::of::<Standard>("metallic"),
    ];
    let families: [(_, Made, _); 2] = [("cotton", cotton, of_cotton), ("velvet", velvet, of_velvet)];
    families.into_iter().flat_map(|(material, made, own)| of_family(material, made, [shared(), own].concat())).collect()
}

fn of_family(material: &'static str, made: Made, inputs: Vec<Input>) -> Vec<PropertyCheck> {
    let count = inputs.len();
    let check = |property, limit, more: &[Input], value| {
        PropertyCheck::ours(material, property, limit, [&inputs, more].concat(), value)
    };
    let light = [Input::signed_cosine("cosine_to_light"), Input::turn("eye_to_light_deg")];
    let mut checks = vec![
        check("directional albedo", ALBEDO_LIMIT, &[], Box::new(move |x| albedo(&made(x), x[0]))),
        check("white cloth under ltc, off 1 by", 1e-3, &[], Box::new(move |x| of_white(made, x, 0.0))),
        check(
            "white cloth under others, off 1 by",
            TABLE_ERROR,
            &[],
            Box::new(move |x| of_white(made, x, x[2].max(1.0))),
        ),
        check(
            "radiance under white ambient light",
            ALBEDO_LIMIT,
            &[Input::between("occlusion", (0.0, 1.0))],
            Box::new(move |x| made(x).ambient(x[0], x[count]).max_element()),
        ),
        check(
            "base, off reciprocal by",
            1e-6,
            &[Input::cosine("cosine_to_light")],
            Box::new(move |x| {
                let (there, back) = (made(x).base_brdf(x[0], x[count]).x, made(x).base_brdf(x[count], x[0]).x);
                (there - back).abs() / there.max(back).max(f64::MIN_POSITIVE)
            }),
        ),
    ];
    let lit = [inputs.clone(), light.to_vec()].concat();
    checks.extend(light::checks(material, false, &lit, move |x, irradiance| {
        let (v, l) = (direction(x[0], 0.0), direction(x[count], x[count + 1].to_radians()));
        irradiance * (made(x).brdf_times_cosine(v, l) + made(x).ambient(x[0], 1.0))
    }));
    checks
}

/// How much of the light a white cloth under that model of fuzz loses or gains.
fn of_white(made: Made, x: &[f64], model: f64) -> f64 {
    let white = Surface { diffuse: DVec3::ONE, ..made(&[&x[..2], &[model], &x[3..]].concat()) };
    (albedo(&white, x[0]) - 1.0).abs()
}

/// Share of white light that comes back to an eye at the cosine `mu`.
fn albedo(surface: &Surface<'_>, mu: f64) -> f64 {
    let v = direction(mu, 0.0);
    let fuzz = over_hemisphere(|l| surface.fuzz_times_cosine(v, l).x);
    fuzz + over_cosines(|mu_l| surface.base_brdf(mu, mu_l).x * mu_l)
}
