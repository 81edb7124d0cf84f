//! Property checks of satin.

use super::anisotropy::{FIT, reflected};
use super::property_check::{Input, PropertyCheck};
use super::quadrature::{direction, over_hemisphere};
use super::{ALBEDO_LIMIT, light};
use crate::material::{self, Standard};
use crate::measure::twin::satin::Satin;
use glam::DVec3;

/// Grey satin, from the first seven inputs of every check here.
fn satin(x: &[f64], two_way: bool) -> Satin {
    Satin {
        specular_strength: x[0],
        roughness: x[1],
        anisotropy: x[2],
        base_color: DVec3::splat(x[3]),
        metallic: x[4],
        specular_color: DVec3::ONE,
        secondary_color: DVec3::splat(x[5]),
        secondary_width: x[6],
        two_way,
        light_tint: 0.5,
    }
}

/// Everything that is promised of satin.
pub fn checks() -> Vec<PropertyCheck> {
    let at = |input: Input, corners: &[f64]| Input { corners: corners.to_vec(), ..input };
    let inputs = vec![
        at(Input::of::<material::Satin>("specular_strength"), &[0.0, 30.0]),
        Input::of::<Standard>("roughness"),
        Input::of::<material::Satin>("anisotropy"),
        at(Input::of::<Standard>("base_color"), &[1.0]),
        at(Input::of::<Standard>("metallic"), &[0.0, 1.0]),
        at(Input::of::<material::Satin>("secondary_color"), &[0.0, 1.0]),
        at(Input::of::<material::Satin>("secondary_width"), &[2.0]),
        at(Input::cosine("cosine_to_eye"), &[1e-3, 0.05, 0.3, 1.0]),
        at(Input::turn("along_to_eye_deg"), &[0.0, 90.0]),
    ];
    let lit =
        [inputs.clone(), vec![Input::signed_cosine("cosine_to_light"), Input::turn("along_to_light_deg")]].concat();
    let albedo = |property, two_way| PropertyCheck {
        material: "satin",
        property,
        classic: false,
        limit: Some(ALBEDO_LIMIT),
        inputs: inputs.clone(),
        value: Box::new(move |x| {
            let (satin, v) = (satin(x, two_way), direction(x[7], x[8].to_radians()));
            let highlight: f64 = satin.lobes().iter().map(|(share, lobe)| share * reflected(lobe, v, |_| 1.0)).sum();
            highlight + over_hemisphere(|l| satin.diffuse_brdf(&FIT, v, l).x * l.z)
        }),
    };
    let mut checks = vec![
        albedo("directional albedo", false),
        albedo("directional albedo, two ways", true),
        PropertyCheck {
            property: "radiance under white ambient light",
            value: Box::new(|x| satin(x, true).ambient(&FIT, direction(x[7], x[8].to_radians())).max_element()),
            ..albedo("", true)
        },
        PropertyCheck {
            property: "diffuse lobe, off reciprocal by",
            limit: Some(1e-6),
            inputs: lit.clone(),
            value: Box::new(|x| {
                let (v, l) = (direction(x[7], x[8].to_radians()), direction(x[9].abs(), x[10].to_radians()));
                let satin = satin(x, true);
                let (there, back) = (satin.diffuse_brdf(&FIT, v, l).x, satin.diffuse_brdf(&FIT, l, v).x);
                (there - back).abs() / there.max(back).max(f64::MIN_POSITIVE)
            }),
            ..albedo("", true)
        },
    ];
    checks.extend(light::checks("satin", false, &lit, |x, irradiance| {
        let (v, l) = (direction(x[7], x[8].to_radians()), direction(x[9], x[10].to_radians()));
        let satin = satin(x, true);
        irradiance * (satin.brdf_times_cosine(&FIT, v, l) + satin.ambient(&FIT, v))
    }));
    checks
}
