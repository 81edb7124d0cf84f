//! Property checks of the strands of fur.

use super::property_check::{Input, PropertyCheck};
use super::quadrature::{direction, over_sphere, settled};
use super::{ALBEDO_LIMIT, light};
use crate::material::Fur;
use crate::measure::twin::fibre::{self, Fibre};
use crate::measure::twin::strand;
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;

/// A strand before the eye, from the first six inputs of most checks here.
fn fibre(x: &[f64]) -> Fibre {
    let (tangent, to_eye) = (direction(x[3].to_radians().cos(), 0.0), direction(x[4], x[5].to_radians()));
    Fibre::new(DVec3::Z, tangent, to_eye, x[0], x[1], fibre::variance(x[2]))
}

/// Share of white light from everywhere that white strands send back, by that scattering.
fn albedo(fibre: &Fibre, to_eye: DVec3, scattering: impl Fn(&Fibre, DVec3) -> f64) -> f64 {
    over_sphere(fibre.tangent, to_eye, |to_light| scattering(fibre, to_light))
}

/// Everything that is promised of fur.
pub fn checks() -> Vec<PropertyCheck> {
    // Lobes add up: what holds with and without them holds between.
    let strength = |name| Input { corners: vec![0.0, 1.0], ..Input::of::<Fur>(name) };
    let inputs = vec![
        strength("specular"),
        strength("transmission"),
        Input::of::<Fur>("roughness"),
        Input::between("strand_to_normal_deg", (0.0, 90.0)),
        Input::signed_cosine("cosine_to_eye"),
        Input::turn("strand_to_eye_deg"),
    ];
    let lit = [
        inputs.clone(),
        vec![
            Input::signed_cosine("cosine_to_light"),
            Input::turn("strand_to_light_deg"),
            Input::of::<Fur>("base_color"),
            Input::between("optical_depth", (0.0, 7.0)),
        ],
    ]
    .concat();
    let check = |property, limit, inputs, value| PropertyCheck {
        material: "fur",
        property,
        classic: false,
        limit,
        inputs,
        value,
    };
    let mut checks = vec![
        // No colour and no depth give more.
        check(
            "directional albedo of white strands",
            Some(ALBEDO_LIMIT),
            inputs.clone(),
            Box::new(|x| {
                albedo(&fibre(x), direction(x[4], x[5].to_radians()), |fibre, light| fibre.scattering(1.0, light, 0.0))
            }),
        ),
        check(
            "departure from white in a white environment",
            Some(1e-6),
            inputs,
            Box::new(|x| (fibre(x).environment(1.0, 1.0, 1.0, 1.0, 0.0) - 1.0).abs()),
        ),
        check(
            "integral of a longitudinal lobe",
            Some(ALBEDO_LIMIT),
            vec![
                Input::of::<Fur>("roughness"),
                Input::between("angle", (-FRAC_PI_2, FRAC_PI_2)),
                // From the transmitted lobe to the returned one.
                Input::between("widening", (0.25, 4.0)),
            ],
            Box::new(|x| {
                let ((sine, cosine), variance) = (x[1].sin_cos(), x[2] * fibre::variance(x[0]));
                settled(|rule| {
                    let at = |u: f64| fibre::along(sine, cosine, variance, 2.0 * u - 1.0, 2.0 * (u * (1.0 - u)).sqrt());
                    rule.iter().map(|&(u, weight)| 2.0 * weight * at(u)).sum()
                })
            }),
        ),
        // The body's horizon and the wrapped light ask the light's side only: not reciprocal, by design.
        check(
            "scattering over itself swapped",
            None,
            lit.clone(),
            Box::new(|x| {
                let (to_eye, to_light) =
                    (direction(x[4].abs(), x[5].to_radians()), direction(x[6].abs(), x[7].to_radians()));
                let tangent = direction(x[3].to_radians().cos(), 0.0);
                let [there, back] = [(to_eye, to_light), (to_light, to_eye)].map(|(to_eye, to_light)| {
                    let fibre = Fibre::new(DVec3::Z, tangent, to_eye, x[0], x[1], fibre::variance(x[2]));
                    fibre.scattering(x[8], to_light, x[9])
                });
                if back > 0.0 { there / back } else { 1.0 }
            }),
        ),
        check(
            "light through the fur",
            Some(1.0),
            vec![
                Input::between("height", (0.0, 1.0)),
                Input::of::<Fur>("occlusion"),
                Input::signed_cosine("cosine_to_light"),
                Input::of::<Fur>("base_color"),
            ],
            Box::new(|x| fibre::passed_on(x[3], strand::optical_depth(x[0], x[1], x[2]))),
        ),
        check(
            "opacity outside 0 to 1, by",
            Some(0.0),
            vec![
                Input::between("margin", (-1e3, 1.0)),
                Input::between("slope", (0.0, 4.0)),
                Input::between("threshold", (0.0, 1.0)),
                Input::of::<Fur>("thickness"),
                Input::between("length_in_cells", (0.0, 10.0)),
            ],
            Box::new(|x| {
                let radius = 0.5 * x[3];
                let (cap, width) = (strand::cross_section(x[2], radius), strand::width(x[2], radius));
                outside(strand::opacity(x[0], x[1], strand::slab_opacity(cap, width, x[4])))
            }),
        ),
    ];
    checks.extend(light::checks("fur", false, &lit, |x, irradiance| {
        irradiance * fibre(x).scattering(x[8], direction(x[6], x[7].to_radians()), x[9])
    }));
    checks
}

/// How far a share lies outside 0 to 1.
pub fn outside(share: f64) -> f64 {
    // Not `max(0)` alone, which NaN would pass.
    if (0.0..=1.0).contains(&share) { 0.0 } else { (share - 1.0).max(-share).abs() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_doubled_lobe_fails() {
        let mut check = checks().remove(0);
        assert!(check.judge(0).pass);
        check.value = Box::new(|x| {
            let to_eye = direction(x[4], x[5].to_radians());
            albedo(&fibre(x), to_eye, |fibre, light| 2.0 * fibre.scattering(1.0, light, 0.0))
        });
        assert!(check.judge(0).fails());
    }

    #[test]
    fn what_lies_outside_is_told() {
        assert_eq!([outside(0.0), outside(1.0), outside(2.0), outside(-1.5)], [0.0, 0.0, 1.0, 1.5]);
        assert!(outside(f64::NAN).is_nan());
    }
}
