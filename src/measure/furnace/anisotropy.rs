//! Property checks of the anisotropic lobe that satin, gauze and layered metals share.

use super::ALBEDO_LIMIT;
use super::property_check::{Input, PropertyCheck};
use super::quadrature::{direction, over_hemisphere, over_reflections};
use crate::measure::twin::albedo::Fit;
use crate::measure::twin::anisotropy::Lobe;
use crate::measure::twin::ggx;
use crate::measure::twin::satin;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::LazyLock;

pub static FIT: LazyLock<Fit> = LazyLock::new(Fit::shipped);

/// A grey lobe, from the first three inputs of every check here.
fn lobe(x: &[f64]) -> Lobe {
    let f0 = DVec3::splat(x[0]);
    Lobe { f0, f90: satin::f90(f0), alpha: ggx::anisotropic_alpha(x[1], x[2]) }
}

/// Share of white light that a lobe sends to `v`, by quadrature, times what `factor` says of each light.
pub fn reflected(lobe: &Lobe, v: DVec3, factor: impl Fn(DVec3) -> f64) -> f64 {
    let scattered = over_reflections(v, lobe.alpha, |l| lobe.single_scattering_times_cosine(v, l).x * factor(l));
    lobe.compensation(&FIT, v).x * scattered
}

/// Everything that is promised of it.
pub fn checks() -> Vec<PropertyCheck> {
    let inputs = || {
        vec![
            Input::between("f0", (0.0, 1.0)),
            Input::between("roughness", (0.0, 1.0)),
            Input::between("anisotropy", (-1.0, 1.0)),
            Input::cosine("cosine_to_eye"),
            Input { corners: vec![0.0, 45.0, 83.0, 90.0], ..Input::turn("along_to_eye_deg") },
        ]
    };
    let check =
        |property, limit, inputs, value| PropertyCheck::ours("anisotropic lobe", property, limit, inputs, value);
    vec![
        check(
            "directional albedo over a white base",
            ALBEDO_LIMIT,
            inputs(),
            Box::new(|x| {
                let (lobe, v) = (lobe(x), direction(x[3], x[4].to_radians()));
                let average = (1.0 - lobe.average_albedo(&FIT).x).max(1e-4);
                let base = over_hemisphere(|l| l.z / PI * (1.0 - lobe.albedo(&FIT, l).x)) / average;
                reflected(&lobe, v, |_| 1.0) + (1.0 - lobe.albedo(&FIT, v).x) * base
            }),
        ),
        check(
            "single scattering, off reciprocal by",
            1e-6,
            [inputs(), vec![Input::cosine("cosine_to_light"), Input::turn("along_to_light_deg")]].concat(),
            Box::new(|x| {
                let (v, l) = (direction(x[3], x[4].to_radians()), direction(x[5], x[6].to_radians()));
                let brdf = |v, l: DVec3| lobe(x).single_scattering_times_cosine(v, l).x / l.z;
                let (there, back) = (brdf(v, l), brdf(l, v));
                (there - back).abs() / there.max(back).max(f64::MIN_POSITIVE)
            }),
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lobe_that_is_half_a_percent_too_strong_fails() {
        let mut check = checks().remove(0);
        assert!(check.judge(0).pass);
        let right = check.value;
        check.value = Box::new(move |x| {
            let v = direction(x[3], x[4].to_radians());
            right(x) + 0.005 * reflected(&lobe(x), v, |_| 1.0)
        });
        assert!(check.judge(0).fails());
    }
}
